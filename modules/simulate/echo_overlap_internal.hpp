// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Overlap of two echoes of one scatterer that differ in delay [s], Doppler shift [Hz], which displaces sweeps, and
/// direction cosine: 1 for none, that of Gaussian pulses of the bandwidth, times that of the array's patterns.
class EchoOverlap {
 public:
  explicit EchoOverlap(const ResolvedPing& ping) : array_(ping.head.array), pulse_(ping.head.pulse) {
    step_ = 2 * pi * ping.head.pulse.centre_frequency / ping.sent.medium.sound_speed * array_.spacing;
  }
  double of(double delay, double doppler, double u) const {
    const double pulses = pi * pulse_.bandwidth * (delay + doppler_delay(pulse_, doppler));
    const double tones = doppler / pulse_.bandwidth;
    return std::exp(-pulses * pulses / (4 * std::numbers::ln2) - std::numbers::ln2 * tones * tones) * patterns(u);
  }

 private:
  double patterns(double u) const {
    double sum = 0, all = 0;
    for (std::size_t m = 0; m < array_.elements(); ++m) {
      const double energy = array_.shading[m] * array_.shading[m];
      all += energy;
      sum += energy * std::cos(step_ * element_position(m, array_.elements()) * u);
    }
    return sum / all;
  }
  const LineArray& array_;
  const Pulse& pulse_;
  double step_;
};

}  // namespace insonify
