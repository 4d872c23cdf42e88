// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "acoustics/coherent_part_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The flat end of a cylinder in the sense of its axis, if it was captured: its plane and surfels.
std::optional<std::pair<FittedPlane, SurfelPart>> end_of(const CoherentPart& part, const RoundBody& body,
                                                         double reach) {
  constexpr double across_axis = 0.99, nearly_across = 0.8;
  const SurfelPart cap = part.surfels.where([&](auto s) {
    return part.surfels.normal(s).dot(body.axis) > nearly_across &&
           body.away(part.surfels.point(s)).norm() < body.radius + reach;
  });
  auto plane = flat_part(cap, part.noise);
  if (plane && plane->first.normal.dot(body.axis) < across_axis) return std::nullopt;
  return plane;
}

/// Length of the side of a cylinder, and the middle along its axis. Round it, surfels end where the widest gap between
/// their angles is.
std::pair<double, double> extent_along(const RoundBody& body, const SurfelPart& side) {
  const Vector3d right = body.axis.unitOrthogonal(), ahead = body.axis.cross(right);
  std::vector<Vector2d> places;  // angle round the axis, distance along it
  for (const std::uint32_t s : side.members) {
    const Vector3d away = body.away(side.point(s));
    places.emplace_back(std::atan2(away.dot(ahead), away.dot(right)), body.axis.dot(side.point(s) - body.centre));
  }
  std::sort(places.begin(), places.end(), [](auto& a, auto& b) { return a.x() < b.x(); });
  double widest = places.front().x() + 2 * pi - places.back().x(), first = places.front().x();
  double low = places.front().y(), high = low;
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (const double gap = places[k].x() - places[k - 1].x(); gap > widest) widest = gap, first = places[k].x();
    low = std::min(low, places[k].y()), high = std::max(high, places[k].y());
  }
  const double middle = 0.5 * (low + high), spacing = side.spacing();
  const double closed = side.area() / (2 * pi * body.radius);
  if (body.radius * widest < 4 * spacing && std::abs(closed - (high - low)) < 2 * spacing) return {closed, middle};
  for (Vector2d& place : places)
    place.x() = body.radius * (place.x() < first ? place.x() + 2 * pi - first : place.x() - first);
  return {high - low + 2 * edge_beyond_centres(places, side.area(), spacing), middle};
}

}  // namespace

std::optional<FittedCylinder> cylinder_of(const CoherentPart& part) {
  const SurfelPart& all = part.surfels;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(all.moments([&](auto s) { return all.normal(s); }));
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.eigenvectors().col(k);
    const auto body =
        round_body(all.where([&](auto s) { return std::abs(all.normal(s).dot(axis)) < 0.3; }), part.noise, axis);
    if (!body) continue;

    // Every surfel must lie on the side or on an end, whatever its own normal is.
    const double reach = std::max(part.noise.reach(), 3.5 * std::sqrt(body->mean_square));
    SurfelPart side =
        all.where([&](auto s) { return std::abs(body->away(all.point(s)).norm() - body->radius) <= reach; });
    SurfelPart rest{all.scene, without(all.members, side.members)};
    FittedCylinder found{*body, {}};
    std::vector<SmoothTarget> ends;
    for (const double sense : {-1.0, 1.0}) {
      RoundBody turned = *body;
      turned.axis *= sense;
      const auto end = end_of(part, turned, reach);
      if (!end) continue;
      const auto on_end = [&](auto s) {
        return std::abs(end->first.normal.dot(all.point(s) - end->first.place)) <= reach &&
               all.normal(s).dot(turned.axis) > 0.5;
      };
      rest.members = rest.where([&](auto s) { return !on_end(s); }).members;
      side.members = side.where([&](auto s) { return !on_end(s); }).members;
      ends.push_back(part.plate(end->first, end->second));
    }
    if (!part.is_nearly_all(all.area() - rest.area()) || side.members.size() < fewest_surfels) continue;

    SmoothTarget cylinder = part.target();
    const auto [length, middle] = extent_along(*body, side);
    cylinder.radius = body->radius, cylinder.axis = body->axis, cylinder.length = length;
    cylinder.surface.place = body->centre + middle * body->axis;
    found.targets = {cylinder};
    found.targets.insert(found.targets.end(), ends.begin(), ends.end());
    return found;
  }
  return std::nullopt;
}

}  // namespace insonify
