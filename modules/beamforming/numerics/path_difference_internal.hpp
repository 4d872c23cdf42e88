// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace insonify {

/// Returns how much longer a path is than `range`, from the difference of their squares, without cancellation.
inline double path_difference(double range, double squared) {
  return squared / (std::sqrt(std::max(0.0, range * range + squared)) + range);
}

/// Returns the distance from a source to the element at `y` [m], less the distance from the source to the centre of the
/// array [m]. The source is at `range` [m] and direction cosine `u` along the array (E61).
inline double path_difference(double range, double u, double y) {
  return path_difference(range, y * y - 2 * range * y * u);
}

/// Returns the same for an element at the position `p` [m] and a source in the direction `from`; the same bits for one
/// at (0, y, 0).
inline double path_difference(double range, const Eigen::Vector3d& from, const Eigen::Vector3d& p) {
  const double along = 2 * range * p.y() * from.y() + 2 * range * p.x() * from.x() + 2 * range * p.z() * from.z();
  return path_difference(range, p.squaredNorm() - along);
}

}  // namespace insonify
