// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/mirror.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "acoustics/boundary_count.hpp"
#include "core/require.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

/// Beyond these bounds doubles do not resolve the phases along an edge.
constexpr double furthest_position = 1e9, largest_extent = 1e7;  // [m]

/// Throws Error unless a position is finite and within reach.
void require_position(const Vector3d& position, const char* who, const char* name) {
  require(position.allFinite() && position.norm() <= furthest_position, who, name, position.norm(), "m",
          "finite, within 1e9 m of the origin");
}

/// Twice the area of a polygon, along its normal.
Vector3d area_of(const std::vector<Vector3d>& corners) {
  Vector3d area = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    area += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return area;
}

bool convex_and_flat(const Mirror& m) {
  const std::size_t n = m.corners.size();
  double size = 0;
  for (const Vector3d& corner : m.corners) size = std::max(size, (corner - m.position).norm());
  for (std::size_t k = 0; k < n; ++k) {
    const Vector3d side = m.corners[(k + 1) % n] - m.corners[k], next = m.corners[(k + 2) % n] - m.corners[(k + 1) % n];
    if (m.normal.dot(side.cross(next)) < -1e-9 * size * size) return false;
    if (!(std::abs(m.normal.dot(m.corners[k] - m.position)) <= 1e-3 * size)) return false;
  }
  return true;
}

}  // namespace

Mirror with_corners(Mirror mirror, std::vector<Vector3d> corners) {
  mirror.position = Vector3d::Zero();
  for (const Vector3d& corner : corners) mirror.position += corner / static_cast<double>(corners.size());
  mirror.normal = area_of(corners).normalized();
  mirror.corners = std::move(corners);
  return mirror;
}

Mirror with_size(Mirror mirror, double width, double height) {
  const Vector3d normal = mirror.normal.normalized();
  Vector3d level = Vector3d::UnitZ().cross(normal);
  level = level.norm() < 1e-6 ? Vector3d::UnitX() : level.normalized();
  const Vector3d along = 0.5 * width * level, across = 0.5 * height * normal.cross(level);
  const Vector3d& p = mirror.position;
  return with_corners(mirror, {p - along - across, p + along - across, p + along + across, p - along + across});
}

std::vector<Mirror> mirrors_of(const Tank& tank) {
  const Vector3d &low = tank.corner, high = tank.corner + tank.size;
  const auto plane = [&](const char* name, const Vector3d& position, const Vector3d& normal) {
    return Mirror{name, position, normal, {}, tank.reflection, {}, tank.rms_height};
  };
  std::vector<Mirror> planes = {
      plane("tank.floor", low, Vector3d::UnitZ()), plane("tank.least_x", low, Vector3d::UnitX()),
      plane("tank.most_x", high, -Vector3d::UnitX()), plane("tank.least_y", low, Vector3d::UnitY()),
      plane("tank.most_y", high, -Vector3d::UnitY())};
  planes.push_back({"tank.surface", high, -Vector3d::UnitZ(), {}, -1});
  return planes;
}

void require_valid(const Mirror& m, const char* who) {
  const std::string at = std::string(who) + ": mirror '" + m.name + "'";
  const char* me = at.c_str();
  require(std::abs(m.reflection) <= 1, me, "reflection", m.reflection, "", "within -1 and 1");
  require(m.rms_height >= 0 && std::isfinite(m.rms_height), me, "rms_height", m.rms_height, "m", "finite and >= 0");
  require_position(m.position, me, "distance of place from the origin");
  require(m.normal.allFinite(), me, "length of normal", m.normal.norm(), "", "finite");
  require(m.normal.norm() > 0, me, "length of normal", m.normal.norm(), "",
          m.corners.empty() ? "> 0" : "> 0: three corners on one line, or equal ones, span no plane");
  if (m.solid) {
    require(m.solid->density > 0 && m.solid->density < 1e5, me, "density", m.solid->density, "kg/m^3", "> 0");
    require(m.solid->pressure_speed > 0 && m.solid->pressure_speed < 1e5, me, "pressure_speed", m.solid->pressure_speed,
            "m/s", "> 0");
    require(m.solid->shear_speed >= 0 && m.solid->shear_speed < m.solid->pressure_speed, me, "shear_speed",
            m.solid->shear_speed, "m/s", ">= 0 and below pressure_speed");
  }
  if (m.corners.empty()) return;
  const auto corners = static_cast<double>(m.corners.size());
  require(corners >= 3 && corners <= most_corners, me, "number of corners", corners, "", "within 3 and 64");
  double extent = 0;
  for (const Vector3d& corner : m.corners) extent = std::max(extent, (corner - m.position).norm());
  require(extent <= largest_extent, me, "distance of a corner from the middle", extent, "m", "at most 1e7 m");
  require(convex_and_flat(m), me, "corners", corners, "", "those of a flat convex polygon, in order");
}

void require_valid(const Tank& tank, const char* who) {
  require(tank.size.allFinite() && tank.size.minCoeff() > 0, who, "least of tank.size", tank.size.minCoeff(), "m",
          "finite and > 0");
  require(tank.size.maxCoeff() <= largest_extent, who, "largest of tank.size", tank.size.maxCoeff(), "m",
          "at most 1e7 m");
  require_position(tank.corner, who, "distance of tank.corner from the origin");
  require(std::abs(tank.reflection) <= 1, who, "tank.reflection", tank.reflection, "", "within -1 and 1");
  require(tank.rms_height >= 0 && std::isfinite(tank.rms_height), who, "tank.rms_height", tank.rms_height, "m",
          "finite and >= 0");
}

}  // namespace insonify
