#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "acoustics/echoes.hpp"
#include "acoustics/pulse.hpp"
#include "sampling/range_gate.hpp"

namespace insonify {

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
/// the absorption lengthens a Gaussian on its way (E8).
struct PulseReach {
  double half, growth = 0;  // half length as sent [s]; growth of its square per second of delay

  PulseReach(const Pulse& pulse, const Absorption& absorption, double sound_speed, bool doppler, double tolerance) {
    if (pulse.shape == PulseShape::linear_fm) {
      half = sweep_reach(pulse, absorption, doppler, tolerance);
      return;
    }
    half = pulse_half_length(pulse, tolerance / 2);  // two lost samples per echo stay below the tolerance
    growth = absorption.a2 * sound_speed / echo_envelope(pulse, {}, 0).a;
  }

  /// Side lobes of a sweep fall off slowly: all that are cut together stay below the tolerance. An echo with Doppler
  /// shift, or with a loss that tilts its spectrum, is taken whole.
  static double sweep_reach(const Pulse& pulse, const Absorption& a, bool doppler, double tolerance) {
    if (a.a1 != 0 || a.a2 != 0 || doppler) return pulse.duration;
    return pulse_half_length(pulse, 0.5 * tolerance / std::sqrt(3 * pulse.bandwidth * pulse.duration));
  }

  double at(double delay) const { return growth == 0 ? half : half * std::sqrt(std::max(1.0, 1 + growth * delay)); }
};

/// Which echoes touch which tile of bins, in order of echoes: the same for any number of threads.
struct TileLists {
  std::vector<std::size_t> begin;  ///< tiles + 1 offsets into `echo`
  std::vector<std::uint32_t> echo;

  TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins) {
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
  std::size_t tiles() const { return begin.size() - 1; }
};

}  // namespace insonify
