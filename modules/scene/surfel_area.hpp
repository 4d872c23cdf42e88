#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

struct AreaOptions {
  int neighbours = 16;  ///< nearest points whose bisectors bound a cell; at least 6
  int threads = 0;      ///< 0: all cores
};

/// Returns the surface area of each point [m^2]: the area of its Voronoi cell among the nearest points, in its tangent
/// plane (E15). At a border, where the neighbours leave an angular gap above 120 degrees, the cell extends half a local
/// spacing beyond the point. The areas of a flat plate sampled at cell centres add up to its area within 2 %.
/// Coincident points share one cell; fewer than four points give area 0. Throws Error unless there is one unit normal
/// per point and neighbours >= 6.
std::vector<float> estimate_surfel_areas(std::span<const Eigen::Vector3f> points,
                                         std::span<const Eigen::Vector3f> normals, const AreaOptions& options = {});

}  // namespace insonify
