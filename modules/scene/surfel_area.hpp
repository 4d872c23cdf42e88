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

struct SurfelShapes {
  std::vector<Eigen::Vector3f> normal;  ///< unit vectors, on the side of the base normals
  std::vector<float> area;              ///< [m^2]
  std::size_t strays = 0;  ///< cells more than 16 times as large as those around them, cut down to their median
};

/// Normals and areas of points that have none, fitting each other (E68). `base_normals`, unit vectors, are those of planes
/// through wide neighbourhoods. Where points leave these planes by relief, the normal is that of the facets between a point
/// and the neighbours round its cell, and the area that of the cell on the base plane over the cosine between them: so the
/// cells of a height field cover its plan, rough or smooth. Where they leave it by noise, base normal and cell stay.
/// The cell is sought among twice options.neighbours. Lengths and degenerate input as for estimate_surfel_areas.
SurfelShapes estimate_surfel_shapes(std::span<const Eigen::Vector3f> points,
                                    std::span<const Eigen::Vector3f> base_normals, const AreaOptions& options = {});

}  // namespace insonify
