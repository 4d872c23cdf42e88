// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Triangles that cover a polygon in space.
struct PolygonCut {
  std::vector<std::array<int, 3>> ears;  ///< corners of the triangles; empty: the fan from the first corner
  double off_plane = 0;  ///< greatest distance of a corner from the polygon's plane, over the diagonal of its box
  bool crosses = false;  ///< true: edges cross, or tests were used up, and no triangles cover it
};

/// Cuts a polygon of at least three corners, which may have holes that pairs of coincident edges join to it, into two
/// triangles less than it has corners. They have the sense of the polygon; those between corners on one line have no
/// area. Convex polygons are fans, as are those without area or with a corner that is not finite. Takes comparisons of
/// corners from `tests_left`, some ten for each corner, more if its edges are much longer than its corners are apart.
PolygonCut cut_polygon(std::span<const Eigen::Vector3d> corners, std::size_t& tests_left);

}  // namespace insonify
