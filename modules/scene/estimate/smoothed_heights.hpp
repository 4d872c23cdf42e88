// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Heights of the points of a height field, those marked in `noisy` (one entry a point) moved onto the surface through
/// their neighbours on the plan: a cubic through as many of them, 16 to 400, as best foretell points there that are
/// left out. So waves stay that rise out of the noise, and no others. The same for any number of `threads` (0: all
/// cores).
std::vector<float> smoothed_heights(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> noisy,
                                    int threads = 0);

}  // namespace insonify
