// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Options of estimate_surfel_areas.
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

/// Options of estimate_surfel_shapes.
struct ShapeOptions {
  int neighbours =
      16;           ///< nearest points whose bisectors bound a cell seen from one place, twice as many else; at least 6
  int threads = 0;  ///< 0: all cores
  bool height_fields = true;  ///< sought; not in a view from one side, whose steps would be taken for slopes
  std::optional<Eigen::Vector3d> viewpoint{};  ///< from which all points were seen at once [m]; empty: none such
  bool keep_strays = false;                    ///< strays keep the areas of their cells
};

/// Normals and areas of points, and what was found on the way.
struct SurfelShapes {
  std::vector<Eigen::Vector3f> normal;  ///< unit vectors, on the side of the base normals
  std::vector<float> area;              ///< [m^2]
  std::size_t strays =
      0;  ///< cells more than 16 times as large as those around, cut down to their median; 0 with a viewpoint
  std::size_t height_field = 0;       ///< points of height fields that show their relief, not noise
  std::size_t heights = 0;            ///< points of height fields, noisy ones among them
  std::vector<std::uint8_t> noisy{};  ///< of each point, 1: of a height field, and shows noise; empty: with a viewpoint
};

/// Normals and areas of points that have none, fitting each other. `base_normals`, unit vectors, are those of planes
/// through wide neighbourhoods.
///
/// A height field, rough or smooth, is covered by the Voronoi cells of its plan; the normal is that of a cubic through
/// 16 neighbours, and the area that of the cell over the cosine between normal and vertical (E69). Where the points
/// leave a plane by noise, which a cubic does not explain, the normal is that of the planes around. Points elsewhere,
/// of walls, bodies and surfaces one above the other, have cells on the base planes and, on relief, normals of the
/// facets round them. So the sum of area x abs(nz) of a height field is its plan within 1 %; the area is right within 2
/// %, and its classes of slope within 5 %, to 70 degrees for waves of eight spacings and more; shorter ones lose area,
/// 4 % at four.
///
/// Points that were all seen from `viewpoint` keep the base normals; areas are those of their cells of solid angle
/// over the cosine between normal and line of sight, at least 0.1 (E73): steps in range are no relief. That holds for a
/// scanner; if the cells are more alike on the plan, the cloud is a raster of heights, and the viewpoint changes
/// nothing.
///
/// Lengths and degenerate input as for estimate_surfel_areas.
SurfelShapes estimate_surfel_shapes(std::span<const Eigen::Vector3f> points,
                                    std::span<const Eigen::Vector3f> base_normals, const ShapeOptions& options = {});

}  // namespace insonify
