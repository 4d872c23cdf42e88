// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

namespace insonify {

/// Returns the distance from a source to the element at `y` [m], less the distance from the source to the centre of the
/// array [m]. The source is at `range` [m] and direction cosine `u` along the array (E61). The formula avoids
/// cancellation.
inline double path_difference(double range, double u, double y) {
  const double squared = y * y - 2 * range * y * u;
  return squared / (std::sqrt(std::max(0.0, range * range + squared)) + range);
}

}  // namespace insonify
