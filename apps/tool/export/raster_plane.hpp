// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "core/geodesy.hpp"
#include "formats/geotiff_file.hpp"
#include "formats/las_file.hpp"
#include "scene_io/projected_system.hpp"

namespace insonify::tool {

/// The text of --help on --crs.
inline constexpr const char* crs_help =
    "projected system of a geotiff, as EPSG:25832 (by GDAL and PROJ), or local: the plane of the world; default: the "
    "system of the world, or the UTM zone of its place";

/// The plane of the coordinates of a product: a UTM zone, any projected system, or that of the world.
class RasterPlane {
 public:
  /// crs    as --crs: EPSG:N, local, or "" for the projected system of the world, else UTM
  /// place  where the world is on the globe; only the local plane needs none
  /// Throws Error(argument) for another crs, or without a position, and as ProjectedSystem.
  RasterPlane(const std::string& crs, const std::optional<Georeference>& georeference);

  /// Returns true if `crs` means the plane of the world, which needs no place on the globe.
  static bool is_local(const std::string& crs) { return crs == "local"; }

  /// Easting, northing [m] and height of a position in the world.
  Eigen::Vector3d from_world(const Eigen::Vector3d& world) const;
  /// The inverse of from_world at z = 0 of the world, to a micrometre, found from a place of the world that is not far.
  Eigen::Vector2d world_of(const Eigen::Vector2d& position, const Eigen::Vector2d& not_far) const;
  /// Returns the system of a LAS file in this plane, which must not be that of the world.
  LasSystem las_system() const;
  /// Returns the grid with code and unit of the system.
  GeoGrid in_system(GeoGrid grid) const;

 private:
  std::optional<Georeference> reference_;
  std::variant<std::monostate, UtmZone, ProjectedSystem> system_;  ///< monostate: the world
};

}  // namespace insonify::tool
