// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/core.h>

#include "beamforming/synthesize.hpp"
#include "core/stop_watch.hpp"
#include "returns/compare.hpp"
#include "thesis/thesis.hpp"

namespace insonify::thesis {
namespace {

/// The thesis' order of computation as a plain loop in one thread: rays into columns, columns into beams (eq. 21 to 37,
/// corrected). It requires all rays of a column to have one azimuth, which never holds for a captured scene.
ComplexGrid plain_loop(const Echoes& echoes, const Case& which, const SonarHead& head) {
  const std::size_t bins = head.gate.bins();
  const double lambda = speed_of_sound / head.pulse.centre_frequency;
  ComplexGrid columns = ComplexGrid::Zero(which.beams, bins), beams = columns;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const EchoEnvelope pulse = echo_envelope(head.pulse, medium().absorption, 0.5 * speed_of_sound * echoes.delay[i]);
    for (std::size_t n = 0; n < bins; ++n)
      columns(i / which.rays, n) +=
          echoes.amplitude[i] * pulse.at(2 * head.gate.centre(n) / speed_of_sound - echoes.delay[i]);
  }
  for (std::size_t b = 0; b < which.beams; ++b)
    for (std::size_t column = 0; column < which.beams; ++column) {
      const double u = echoes.u[column * which.rays];
      const double weight = array_response(head.array, lambda, u, std::sin(head.fan.azimuth[b])).real();
      for (std::size_t n = 0; n < bins; ++n) beams(b, n) += weight * columns(column, n);
    }
  return beams;
}

struct Timing {
  std::string median;
  double seconds = 0;
  ComplexGrid pressure;
};

/// Times `runs` runs after a warm-up; no run starts after ten seconds.
Timing time_runs(int runs, const std::function<ComplexGrid()>& run) {
  Timing timing{{}, 0, run()};
  std::vector<double> seconds;
  double spent = 0;
  for (int i = 0; i < runs && spent < 10; ++i) {
    StopWatch watch;
    timing.pressure = run();
    seconds.push_back(watch.lap());
    spent += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  timing.seconds = seconds[seconds.size() / 2];
  timing.median = fmt::format("{:.3g} ms", 1e3 * timing.seconds);
  return timing;
}

double thesis_seconds(std::size_t beams) { return beams == 51 ? 0.31 : beams == 101 ? 0.77 : 1.84; }

}  // namespace

void print_run_times(const std::vector<std::size_t>& beam_counts, int runs) {
  fmt::print(
      "\n| beams x rays | thesis, MATLAB | spectrum | direct | plain loop | gridded | its error | thesis / gridded |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t beams : beam_counts) {
    const Case which{beams};
    const Echoes echoes = echoes_of_object(make_object(which));
    const SonarHead head = make_sonar(beams, 18, default_bin_size(table_2_pulse(), speed_of_sound));
    const Timing spectrum = time_runs(runs, [&] { return synthesize_spectrum(echoes, head, medium()); });
    const Timing direct = time_runs(runs, [&] { return synthesize_direct(echoes, head, medium()); });
    const Timing plain = time_runs(runs, [&] { return plain_loop(echoes, which, head); });
    const Timing gridded = time_runs(runs, [&] { return synthesize_gridded(echoes, head, medium()); });
    fmt::print("| {} x {} | {:.0f} ms | {} | {} | {} | {} | {:.1g} | {:.0f} |\n", beams, which.rays,
               1e3 * thesis_seconds(beams), spectrum.median, direct.median, plain.median, gridded.median,
               compare_images(gridded.pressure, direct.pressure).relative_l2, thesis_seconds(beams) / gridded.seconds);
  }
}

}  // namespace insonify::thesis
