#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// The surface between points of a height field seen from above, anywhere on their plan: its Delaunay triangles, counter-
/// clockwise from above, as far as the circle through their corners has at most twice the spacing there as its radius, so that
/// none spans a hole of the scan. Points that are on a grid to rounding are cut either way. Points above each other give
/// triangles that stand on end. O(n log n); the same for any number of `threads` (0: all cores).
std::vector<std::array<std::uint32_t, 3>> height_triangles(std::span<const Eigen::Vector3f> points, int threads = 0);

/// Heights of the points of a height field, those marked in `noisy` (one entry a point) moved onto the surface through their
/// neighbours on the plan: a cubic through as many of them, 16 to 192, as bring the slope of the surface within 0.05.
std::vector<float> smoothed_heights(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> noisy,
                                    int threads = 0);

}  // namespace insonify
