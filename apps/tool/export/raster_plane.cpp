// SPDX-License-Identifier: BSD-3-Clause
#include "tool/export/raster_plane.hpp"

#include <cmath>

#include <Eigen/LU>

#include "core/error.hpp"

namespace insonify::tool {
namespace {

/// The number of EPSG:N.
int epsg_of_crs(const std::string& crs) {
  const int code = crs.find(' ') == std::string::npos ? epsg_of_system(crs) : 0;
  if (code == 0)
    fail(ErrorKind::argument, "--crs '", crs, "', must be EPSG:N of a projected system, e.g. EPSG:25832, or local");
  return code;
}

}  // namespace

RasterPlane::RasterPlane(const std::string& crs, const std::optional<Georeference>& georeference)
    : reference_(georeference) {
  if (is_local(crs)) return;
  const int code = crs.empty() ? 0 : epsg_of_crs(crs);
  if (!georeference)
    fail(ErrorKind::argument,
         "a raster needs a place on the globe; give --anchor LAT,LON[,HEADING] of the origin and x "
         "axis of its world, --utm ZONE or --system EPSG:N of a world in projected coordinates, or --crs local");
  const int own = georeference->zone ? 0 : georeference->system.epsg;
  if (code > 0 || own > 0)
    system_ = ProjectedSystem(code > 0 ? code : own, "--crs");
  else
    system_ = georeference->zone.value_or(utm_zone_of(geo_from_world(*georeference, Eigen::Vector3d::Zero())));
}

Eigen::Vector3d RasterPlane::from_world(const Eigen::Vector3d& world) const {
  if (const auto* system = std::get_if<ProjectedSystem>(&system_)) {
    if (!reference_->zone && reference_->system.epsg == system->epsg()) return world;
    const Eigen::Vector2d at = system->position_of(geo_from_world(*reference_, world));
    return {at.x(), at.y(), world.z()};
  }
  const auto* zone = std::get_if<UtmZone>(&system_);
  if (!zone || reference_->zone) return world;
  const UtmPosition utm = utm_position_of(geo_from_world(*reference_, world), *zone);
  return {utm.easting, utm.northing, world.z()};
}

Eigen::Vector2d RasterPlane::world_of(const Eigen::Vector2d& wanted, const Eigen::Vector2d& not_far) const {
  if (std::holds_alternative<std::monostate>(system_)) return wanted;
  const auto level = [&](const Eigen::Vector2d& world) {
    return Eigen::Vector2d(from_world({world.x(), world.y(), 0}).head<2>());
  };
  constexpr double step = 100, good_enough = 1e-6;  // [m]
  Eigen::Vector2d world = not_far;
  for (int pass = 0; pass < 20; ++pass) {
    const Eigen::Vector2d here = level(world), off = wanted - here;
    if (off.norm() < good_enough) break;
    Eigen::Matrix2d slopes;
    slopes << level(world + Eigen::Vector2d(step, 0)) - here, level(world + Eigen::Vector2d(0, step)) - here;
    world += step * slopes.inverse() * off;
  }
  return world;
}

LasSystem RasterPlane::las_system() const {
  if (const auto* system = std::get_if<ProjectedSystem>(&system_))
    return {system->epsg(), system->wkt(), system->unit()};
  return std::get<UtmZone>(system_);
}

GeoGrid RasterPlane::in_system(GeoGrid grid) const {
  if (const auto* system = std::get_if<ProjectedSystem>(&system_))
    grid.epsg = system->epsg(), grid.unit = system->unit();
  else if (const auto* zone = std::get_if<UtmZone>(&system_))
    grid.epsg = epsg_code(*zone);
  return grid;
}

}  // namespace insonify::tool
