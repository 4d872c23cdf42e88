// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "beamforming/numerics/beam_spectrum.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"
#include "tool/image/image.hpp"
#include "view/colour_maps_internal.hpp"

namespace insonify::tool {
namespace {

/// Spectrum of the chosen beams, and the spectrum of the pulse scaled to the same power.
std::vector<SpectrumLine> spectrum_lines(const PictureRequest& job) {
  const ImageRun& run = job.run;
  const Ping& ping = run.cube.pings[job.ping];
  const ChosenBeam chosen = choose_beam(job.options, ping.fan);
  std::vector<std::size_t> beams{chosen.beam};
  if (chosen.choice == BeamChoice::mean) {
    beams.resize(ping.fan.beams());
    std::iota(beams.begin(), beams.end(), 0);
  }
  const double step_time = 2 * ping.gate.bin_size / ping.sound_speed;
  const BeamSpectrum received = beam_spectrum(ping.pressure, beams, step_time, {run.cube.centre_frequency, 0});
  const double power = std::accumulate(received.density.begin(), received.density.end(), 0.0) *
                       (received.frequency[1] - received.frequency[0]);
  Pulse pulse;
  if (run.head) pulse = run.head->pulse;
  pulse.centre_frequency = run.cube.centre_frequency;
  pulse.bandwidth = run.cube.bandwidth;
  const std::string name =
      fmt::format("pulse, {} of {:g} kHz", kind_of(pulse).traits().picture, pulse.bandwidth / 1000);
  return {{received.frequency, received.density, beam_text(chosen, ping.fan)},
          {received.frequency, pulse_density(pulse, step_time, received.frequency, power), name}};
}

void draw_spectrum(const PictureRequest& job) { show_spectrum(spectrum_lines(job), job.picture, job.path); }

double max_db_of_spectrum(const PictureRequest& job) {
  double highest = 0;
  for (const SpectrumLine& line : spectrum_lines(job))
    highest = std::max(highest, *std::max_element(line.density.begin(), line.density.end()));
  return next_five(db_from_power(highest / (micropascal * micropascal)));
}

}  // namespace

ViewSpec spectrum_view() {
  return {.name = "spectrum",
          .shows = "power against frequency",
          .options = {animate_option},
          .draw = draw_spectrum,
          .max_db = max_db_of_spectrum,
          .beam_word = "all",
          .beam_choice = BeamChoice::mean,
          .default_choice = BeamChoice::mean,
          .of_phases = true};
}

}  // namespace insonify::tool
