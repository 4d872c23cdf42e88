// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/surfel_area.hpp"

#include "core/parallel.hpp"
#include "scene/estimate/distinct_points_internal.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"

// Estimates the surface area of each point of a cloud as the area of its Voronoi cell in the tangent plane (E15):
//   1. merge coincident points, build a KD-tree of the distinct ones, find the k nearest of each (k = 16);
//   2. project those on the same sheet (at most 45 degrees off the tangent plane) onto the tangent plane; if they are
//      collinear, as on one scan line, repeat with 4 k neighbours;
//   3. at borders, where the neighbours leave an angular gap above 120 degrees, mirror the opposite neighbours into it;
//      isolated points get the squared spacing of their neighbour instead;
//   4. clip a square by the perpendicular bisectors to all neighbours (half-plane clipping of a convex polygon);
//   5. limit outliers to (16 median spacings)^2 and divide each cell among its coincident points.
// Cost: O(n log n) for the tree and its queries, O(k^2) per point for clipping; parallel over points.
namespace insonify {

using namespace cells;

std::vector<float> estimate_surfel_areas(std::span<const Vector3f> points, std::span<const Vector3f> normals,
                                         const AreaOptions& options) {
  require_valid(points, normals, options, "estimate_surfel_areas");
  if (points.size() < 4) return std::vector<float>(points.size(), 0.0f);
  Estimate e = distinct_points(points);
  const AreaEstimator estimator(e.position, options.neighbours, same_sheet);
  parallel_blocks(e.area.size(), 4096, options.threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t d = e.visit[k];
      e.area[d] = estimator.area(d, normals[e.distinct.first[d]], work);
    }
  });
  limit_cells(e.area);
  return shared_areas(e, points.size());
}

}  // namespace insonify
