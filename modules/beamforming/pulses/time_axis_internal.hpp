// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/vector_functions.hpp"
#include "sonar/pulse_kind.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// The time axis of the gate: sample n is at start + n step [s], two-way time.
struct TimeAxis {
  double start, step;
  std::size_t bins;

  TimeAxis(const RangeGate& gate, double sound_speed)
      : start(2 * gate.centre(0) / sound_speed), step(2 * gate.bin_size / sound_speed), bins(gate.bins()) {}

  /// Returns the time of bin `bin` [s].
  double time_of(double bin) const { return start + bin * step; }

  /// Returns the samples [first, last) within `half` seconds of `delay`, clipped to the axis; empty if outside.
  std::pair<std::size_t, std::size_t> around(double delay, double half) const {
    const double low = vec::ceil((delay - half - start) / step), high = vec::floor((delay + half - start) / step);
    const auto n = static_cast<double>(bins);
    if (high < 0 || low >= n) return {0, 0};
    return {static_cast<std::size_t>(std::max(low, 0.0)), static_cast<std::size_t>(std::min(high, n - 1)) + 1};
  }
};

/// Returns the fraction of its peak at which a pulse is cut for an image with relative error `tolerance`. The error due
/// to cutting stays below a tenth of the tolerance.
inline double pulse_cut(double tolerance) { return tolerance / 4; }

/// Half length of an echo's pulse [s]: the distance from its delay at which it falls below the tolerance. The curvature
/// of the absorption over frequency lengthens a Gaussian with range (E8).
struct PulseReach {
  double half, growth = 0;  // half length as transmitted [s]; growth of its square per second of delay

  PulseReach(const Pulse& pulse, const Absorption& absorption, double sound_speed, bool doppler, double tolerance) {
    if (const MatchedPulse* const matched = kind_of(pulse).matched()) {
      half = matched_reach(*matched, pulse, absorption, doppler, tolerance);
      return;
    }
    half = pulse_half_length(pulse, tolerance / 2);  // the two cut ends of an echo stay below the tolerance
    growth = absorption.a2 * sound_speed / echo_envelope(pulse, {}, 0).a;
  }

  /// Returns the half length behind a matched filter. Side lobes decay slowly, so the cut is such that all omitted ones
  /// together stay below the tolerance. Echoes with a Doppler shift or with frequency-dependent absorption are not cut.
  static double matched_reach(const MatchedPulse& kind, const Pulse& pulse, const Absorption& a, bool doppler,
                              double tolerance) {
    const double end = kind.end(pulse);
    if (a.a1 != 0 || a.a2 != 0 || doppler) return end;
    return pulse_half_length(pulse, 0.5 * tolerance / std::sqrt(3 * pulse.bandwidth * end));
  }

  double at(double delay) const { return growth == 0 ? half : half * std::sqrt(std::max(1.0, 1 + growth * delay)); }
};

}  // namespace insonify
