#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "acoustics/pulse.hpp"
#include "beamforming/element_tile_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/stamping_kernels_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

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

/// How far an echo's pulse reaches to either side of its delay before it falls below the tolerance [s]. Curvature of
/// the absorption lengthens the pulse on its way (E8).
struct PulseReach {
  double half, growth;  // half length as sent [s]; growth of its square per second of delay

  PulseReach(const Pulse& pulse, const Medium& medium, double tolerance)
      : half(pulse_half_length(pulse, tolerance / 2)),  // two lost samples per echo stay below the tolerance
        growth(medium.absorption.a2 * medium.sound_speed / echo_envelope(pulse, {}, 0).a) {}

  double at(double delay) const { return half * std::sqrt(std::max(1.0, 1 + growth * delay)); }
};

/// Which echoes touch which tile of samples, in order of echoes: the same for any number of threads.
struct TileLists {
  std::vector<std::size_t> begin;  ///< tiles + 1 offsets into `echo`
  std::vector<std::uint32_t> echo;

  TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach) {
    const std::size_t tiles = (axis.bins + tile_bins - 1) / tile_bins;
    begin.assign(tiles + 1, 0);
    const auto each_tile = [&](auto&& visit) {
      for (std::size_t i = 0; i < echoes.size(); ++i) {
        const auto [first, last] = axis.around(echoes.delay[i], reach.at(echoes.delay[i]));
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

/// Adds the pulses of echoes to the element series of one tile.
class Stamper {
 public:
  Stamper(const Echoes& echoes, const SonarHead& head, const Medium& medium, const TimeAxis& axis,
          const PulseReach& reach)
      : echoes_(echoes), head_(head), medium_(medium), axis_(axis), reach_(reach) {
    phase_step_ = 2 * pi * head.array.spacing * head.pulse.centre_frequency / medium.sound_speed;
  }

  /// Echo i on the samples [tile_first, tile_last): its pulse times each element's phase.
  void stamp(std::size_t i, std::size_t tile_first, std::size_t tile_last, ElementTile& series) {
    const std::size_t elements = head_.array.elements();
    phase_re_.resize(elements);
    phase_im_.resize(elements);
    kernels::element_phases(phase_step_ * echoes_.u[i], elements, phase_re_.data(), phase_im_.data());
    const double delay = echoes_.delay[i];
    const EchoEnvelope envelope = echo_envelope(head_.pulse, medium_.absorption, 0.5 * medium_.sound_speed * delay);
    const auto [first, last] = axis_.around(delay, reach_.at(delay));
    for (std::size_t n = std::max(first, tile_first); n < std::min(last, tile_last); ++n) {
      const double t = axis_.start + static_cast<double>(n) * axis_.step - delay;
      const std::complex<double> g = echoes_.amplitude[i] * envelope.at(t);  // (E13)
      kernels::add_sample(g.real(), g.imag(), phase_re_.data(), phase_im_.data(), elements,
                          series.re.row(n - tile_first).data(), series.im.row(n - tile_first).data());
    }
  }

 private:
  const Echoes& echoes_;
  const SonarHead& head_;
  const Medium& medium_;
  const TimeAxis& axis_;
  const PulseReach& reach_;
  double phase_step_;
  std::vector<double> phase_re_, phase_im_;
};

}  // namespace

ComplexGrid synthesize_stamped(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_stamped");
  const TimeAxis axis(head.gate, medium.sound_speed);
  const PulseReach reach(head.pulse, medium, options.tolerance);
  const TileLists lists(echoes, axis, reach);
  const BeamSums beams(head, medium.sound_speed / head.pulse.centre_frequency);
  ComplexGrid pressure(head.fan.beams(), axis.bins);

  // Each tile of samples belongs to one thread, which stamps its echoes in their order and forms its beams.
  parallel_for(lists.begin.size() - 1, options.threads, [&](std::size_t tile) {
    const std::size_t first = tile * tile_bins, last = std::min(first + tile_bins, axis.bins);
    ElementTile series(head.array.elements());
    Stamper stamper(echoes, head, medium, axis, reach);
    for (std::size_t k = lists.begin[tile]; k < lists.begin[tile + 1]; ++k)
      stamper.stamp(lists.echo[k], first, last, series);
    beams.form_beams(series, first, last, pressure);
  });
  return pressure;
}

}  // namespace insonify
