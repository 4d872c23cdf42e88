#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

struct AreaOptions {
  int neighbours = 16;  ///< nearest points whose bisectors bound a cell; at least 6
  int threads = 0;      ///< 0: all cores
};

/// Surface area of each point [m^2]: the area of its Voronoi cell among the nearest points, projected on its
/// tangent plane (E15). At a border, where the neighbours leave a gap wider than 120 degrees, the cell ends half a
/// local spacing beyond the point. The areas of a flat plate sampled at cell centres add up to its area within 2 %.
/// Points and unit normals have one length; fewer than four points give area 0. Coincident points share one cell.
std::vector<float> estimate_surfel_areas(std::span<const Eigen::Vector3f> points,
                                         std::span<const Eigen::Vector3f> normals, const AreaOptions& options = {});

}  // namespace insonify
