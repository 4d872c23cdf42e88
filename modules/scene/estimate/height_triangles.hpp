// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Returns the surface between points of a height field as triangles: the Delaunay triangles of the points' plan,
/// counter-clockwise seen from above. The points may lie anywhere on the plan. Triangles whose circumscribed circle has
/// a radius above twice the local spacing are left out, so that no triangle spans a hole of the scan. Grid points (to
/// rounding) have no unique diagonal; either may be taken. Points above each other give vertical triangles. O(n log n);
/// the result does not depend on `threads` (0: all cores).
std::vector<std::array<std::uint32_t, 3>> height_triangles(std::span<const Eigen::Vector3f> points, int threads = 0);

}  // namespace insonify
