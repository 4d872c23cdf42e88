// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// The surface between points of a height field seen from above, anywhere on their plan: its Delaunay triangles,
/// counter- clockwise from above, as far as the circle through their corners has at most twice the spacing there as its
/// radius, so that none spans a hole of the scan. Points that are on a grid to rounding are cut either way. Points
/// above each other give triangles that stand on end. O(n log n); the same for any number of `threads` (0: all cores).
std::vector<std::array<std::uint32_t, 3>> height_triangles(std::span<const Eigen::Vector3f> points, int threads = 0);

}  // namespace insonify
