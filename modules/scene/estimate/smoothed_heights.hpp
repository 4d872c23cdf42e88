// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Returns the heights of the points of a height field without their noise [m] (E160). `noise` is the standard
/// deviation of each height [m]; 0 leaves the point where it is. A point moves onto a cubic through 16 to 400
/// neighbours on the plan, by at most 2.9 standard deviations. Steps and objects stay: neighbours off the cubic do not
/// count, a point more than five standard deviations off it does not move, nor does one among neighbours that stray by
/// more than their noise. Waves that rise above the noise remain; others do not. Throws Error unless there is one noise
/// per point. The result does not depend on `threads` (0: all cores).
std::vector<float> smoothed_heights(std::span<const Eigen::Vector3f> points, std::span<const float> noise,
                                    int threads = 0);

}  // namespace insonify
