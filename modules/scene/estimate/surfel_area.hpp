// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
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
      16;  ///< nearest points that bound a cell in a view from one position (otherwise twice as many); at least 6
  int threads = 0;  ///< 0: all cores
  /// Place from which points were seen [m]; empty: unknown. They count as one view if their cells among the directions
  /// from there are at least `evenness_of_view` times as even as on the plan. Otherwise the viewpoint changes nothing.
  std::optional<Eigen::Vector3d> viewpoint{};
  double evenness_of_view = 1;
  bool keep_strays = false;  ///< true: points far from all others keep the areas of their cells
  bool noise = false;        ///< true: SurfelShapes::noise is estimated with the shapes, which shares their search
  /// Returns base normals of the points with these indices; used in place of `base_normals`. Points of height fields need
  /// none and look up. Not with a viewpoint.
  std::function<std::vector<Eigen::Vector3f>(const std::vector<std::uint32_t>&)> base{};
};

/// Normals and areas of points, with counts of strays and of points in height fields.
struct SurfelShapes {
  std::vector<Eigen::Vector3f> normal;  ///< unit vectors, on the side of the base normals
  std::vector<float> area;              ///< [m^2]
  std::size_t strays =
      0;  ///< cells more than 16 times as large as those around, cut down to their median; 0 with a viewpoint
  std::size_t height_field = 0;  ///< points of height fields that show their relief, not noise
  std::size_t heights = 0;       ///< points of height fields, noisy ones among them
  /// Standard deviation of the height of each point [m] (E160): the same for all points of height fields that show
  /// noise instead of relief, 0 for others. Empty: with a viewpoint.
  std::vector<float> height_noise{};
  std::vector<float> noise{};  ///< result of estimate_surfel_noise; empty unless asked for
};

/// Returns normals and areas for points without either, consistent with each other. `base_normals` are the unit normals
/// of planes through wide neighbourhoods; empty with `options.base`.
///
/// Height fields, rough or smooth: the cells are the Voronoi cells of the plan. The normal is that of a cubic through
/// 16 neighbours; the area is that of the cell over the cosine between normal and vertical (E69). Where noise moves the
/// points off a plane and a cubic does not explain it, the normal is that of the surrounding planes.
///
/// Other points (walls, bodies, surfaces above each other): the cells lie in the base planes. On relief the normals are
/// those of the facets around the points.
///
/// For a height field the sum of area x abs(nz) equals the area of its plan within 1 %. The area is right within 2 %,
/// and its classes of slope within 5 %, up to 70 degrees for waves of eight spacings and more. Shorter waves lose area:
/// 4 % at four spacings.
///
/// Points that were all seen from `viewpoint` keep the base normals, because steps in range are not relief. Their area
/// is that of their cell of solid angle, divided by the cosine between normal and line of sight, at least 0.1 (E73).
/// This holds for a scanner. Elsewhere cells are less even than `evenness_of_view` asks for, and the viewpoint changes
/// nothing. At most 20 000 of them are compared.
///
/// Array lengths and degenerate input are treated as in estimate_surfel_areas.
SurfelShapes estimate_surfel_shapes(std::span<const Eigen::Vector3f> points,
                                    std::span<const Eigen::Vector3f> base_normals, const ShapeOptions& options = {});

}  // namespace insonify
