// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Soundings of a GSF file computed again from its travel times, angles and sound-speed profile.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "formats/gsf_decoder.hpp"

namespace insonify {

/// Where a ray ends after `time` [s] from `depth` at an angle from straight down: level distance and depth [m]. Small
/// steps through a profile that is linear between its entries.
inline std::pair<double, double> ray_end(const std::vector<std::pair<double, double>>& profile, double depth,
                                         double angle, double time) {
  const auto speed = [&](double at) {
    std::size_t i = 1;
    while (i + 1 < profile.size() && profile[i].first < at) ++i;
    const auto [above, fast] = profile[i - 1];
    const auto [below, slow] = profile[i];
    return fast + (slow - fast) * (at - above) / (below - above);
  };
  const double snell = std::sin(angle) / speed(depth);
  constexpr int steps = 2000;
  double level = 0;
  for (int i = 0; i < steps; ++i) {
    const double dt = time / steps, sine = snell * speed(depth);
    const double middle = depth + 0.5 * dt * speed(depth) * std::sqrt(1 - sine * sine), c = speed(middle);
    level += dt * c * snell * c;
    depth += dt * c * std::sqrt(1 - snell * c * snell * c);
  }
  return {level, depth};
}

/// The largest difference of depth, across and along [m] from those of the travel times, in MB-System's convention.
inline double largest_difference(const decode::GsfContent& read) {
  double most = 0;
  for (const decode::GsfSwath& s : read.swaths)
    for (std::size_t b = 0; b < s.flags.size(); ++b) {
      if (s.flags[b] != 0) continue;
      const auto [level, depth] =
          ray_end(s.profile, s.depth_corrector + s.heave, radians(s.arrays.at(5)[b]), s.arrays.at(4)[b] / 2);
      const double azimuth = radians(s.arrays.at(18)[b]);
      most = std::max({most, std::abs(depth + s.tide - s.arrays.at(1)[b]),
                       std::abs(level * std::cos(azimuth) - s.arrays.at(2)[b]),
                       std::abs(level * std::sin(azimuth) - s.arrays.at(3)[b])});
    }
  return most;
}

}  // namespace insonify
