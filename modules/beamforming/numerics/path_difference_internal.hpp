// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

namespace insonify {

/// Returns by how much an element at `y` [m] on the array is farther from a source than the centre of the array is [m].
/// The source is at `range` [m] and direction cosine `u` along the array (E61). No digits cancel.
inline double path_difference(double range, double u, double y) {
  const double squared = y * y - 2 * range * y * u;
  return squared / (std::sqrt(std::max(0.0, range * range + squared)) + range);
}

}  // namespace insonify
