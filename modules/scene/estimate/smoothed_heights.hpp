// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Returns the heights of the points of a height field [m]. Points marked in `noisy` (one entry per point) are moved
/// onto the surface through their neighbours on the plan. This surface is a cubic through 16 to 400 neighbours; the
/// number is the one that best predicts points left out there. Waves that rise above the noise remain; others do not.
/// The result does not depend on `threads` (0: all cores).
std::vector<float> smoothed_heights(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> noisy,
                                    int threads = 0);

}  // namespace insonify
