#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "acoustics/pulse.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/stamping_kernels_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t tile_bins = 64;

/// The time axis of the gate: sample n stands at start + n step, two-way seconds.
struct TimeAxis {
  double start, step;
  std::size_t bins;

  TimeAxis(const RangeGate& gate, double sound_speed)
      : start(2 * gate.centre(0) / sound_speed), step(2 * gate.bin_size / sound_speed), bins(gate.bins()) {}

  /// Samples [first, last) within `half` seconds of `delay`, cut to the axis; empty if outside.
  std::pair<std::size_t, std::size_t> around(double delay, double half) const {
    const double low = std::ceil((delay - half - start) / step), high = std::floor((delay + half - start) / step);
    const auto n = static_cast<double>(bins);
    if (high < 0 || low >= n) return {0, 0};
    return {static_cast<std::size_t>(std::max(low, 0.0)), static_cast<std::size_t>(std::min(high, n - 1)) + 1};
  }
};

/// Which echoes touch which tile of samples, in order of echoes: the same for any number of threads.
struct TileLists {
  std::vector<std::size_t> begin;  ///< tiles + 1 offsets into `echo`
  std::vector<std::uint32_t> echo;

  TileLists(const Echoes& echoes, const TimeAxis& axis, double half) {
    const std::size_t tiles = (axis.bins + tile_bins - 1) / tile_bins;
    begin.assign(tiles + 1, 0);
    const auto each_tile = [&](auto&& visit) {
      for (std::size_t i = 0; i < echoes.size(); ++i) {
        const auto [first, last] = axis.around(echoes.delay[i], half);
        for (std::size_t t = first / tile_bins; first < last && t <= (last - 1) / tile_bins; ++t) visit(t, i);
      }
    };
    each_tile([&](std::size_t t, std::size_t) { ++begin[t + 1]; });
    for (std::size_t t = 0; t < tiles; ++t) begin[t + 1] += begin[t];
    echo.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    each_tile([&](std::size_t t, std::size_t i) { echo[next[t]++] = static_cast<std::uint32_t>(i); });
  }
};

/// Shading times steering phase of every beam and element: beams x elements, in two planes.
struct Steering {
  Grid<double> re, im;

  Steering(const SonarHead& head, double wavelength) {
    const std::vector<double> u_beam = beam_cosines(head.fan);
    const std::size_t n = head.array.elements();
    re.resize(u_beam.size(), n);
    im.resize(u_beam.size(), n);
    for (std::size_t b = 0; b < u_beam.size(); ++b)
      for (std::size_t m = 0; m < n; ++m) {
        const double phase = -2 * pi * head.array.spacing / wavelength * element_place(m, n) * u_beam[b];
        const double w = head.array.shading[m] / static_cast<double>(n);
        re(b, m) = w * std::cos(phase);
        im(b, m) = w * std::sin(phase);
      }
  }
};

/// One tile's time series of every element, samples x elements, in two planes.
struct ElementTile {
  Grid<double> re, im;

  explicit ElementTile(std::size_t elements)
      : re(Grid<double>::Zero(tile_bins, elements)), im(Grid<double>::Zero(tile_bins, elements)) {}
};

}  // namespace

ComplexGrid synthesize_stamped(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_stamped");
  const TimeAxis axis(head.gate, medium.sound_speed);
  const double half = pulse_half_length(head.pulse, options.tolerance);
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const std::size_t elements = head.array.elements(), beams = head.fan.beams();
  const TileLists lists(echoes, axis, half);
  const Steering steering(head, wavelength);
  ComplexGrid pressure(beams, axis.bins);

  parallel_for(lists.begin.size() - 1, options.threads, [&](std::size_t tile) {
    const std::size_t tile_first = tile * tile_bins, tile_last = std::min(tile_first + tile_bins, axis.bins);

    // Stamp: each echo's pulse times each element's phase, into this tile's samples only.              (E13)
    ElementTile series(elements);
    std::vector<double> phase_re(elements), phase_im(elements);
    for (std::size_t k = lists.begin[tile]; k < lists.begin[tile + 1]; ++k) {
      const std::size_t i = lists.echo[k];
      const auto [first, last] = axis.around(echoes.delay[i], half);
      kernels::element_phases(2 * pi * head.array.spacing / wavelength * echoes.u[i], elements, phase_re.data(),
                              phase_im.data());
      const EchoEnvelope envelope =
          echo_envelope(head.pulse, medium.absorption, 0.5 * medium.sound_speed * echoes.delay[i]);
      for (std::size_t n = std::max(first, tile_first); n < std::min(last, tile_last); ++n) {
        const auto t = axis.start + static_cast<double>(n) * axis.step - echoes.delay[i];
        const std::complex<double> g = echoes.amplitude[i] * envelope.at(t);
        kernels::add_sample(g.real(), g.imag(), phase_re.data(), phase_im.data(), elements,
                            series.re.row(n - tile_first).data(), series.im.row(n - tile_first).data());
      }
    }

    // Beams: sums over elements; rows of samples now, so that the sums run along time.
    const Grid<double> re = series.re.transpose(), im = series.im.transpose();
    double beam_re[tile_bins], beam_im[tile_bins];
    for (std::size_t b = 0; b < beams; ++b) {
      kernels::sum_elements(steering.re.row(b).data(), steering.im.row(b).data(), elements, re.data(), im.data(),
                            tile_bins, tile_last - tile_first, beam_re, beam_im);
      for (std::size_t n = tile_first; n < tile_last; ++n)
        pressure(b, n) = {beam_re[n - tile_first], beam_im[n - tile_first]};
    }
  });
  return pressure;
}

}  // namespace insonify
