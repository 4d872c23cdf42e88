// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "acoustics/coherent_group_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The flat end of a cylinder in the sense of its axis, if it was captured: its plane and surfels.
std::optional<std::pair<FittedPlane, SurfelGroup>> end_of(const CoherentGroup& group, const RoundBody& body,
                                                          double reach) {
  constexpr double across_axis = 0.99, nearly_across = 0.8;
  const SurfelGroup cap = group.surfels.where([&](auto s) {
    return group.surfels.normal(s).dot(body.axis) > nearly_across &&
           body.away(group.surfels.point(s)).norm() < body.radius + reach;
  });
  auto plane = flat_group(cap, group.noise);
  if (plane && plane->first.normal.dot(body.axis) < across_axis) return std::nullopt;
  return plane;
}

/// Length of the side of a cylinder, and the middle along its axis. Round it, surfels end where the widest gap between
/// their angles is.
std::pair<double, double> extent_along(const RoundBody& body, const SurfelGroup& side) {
  const Vector3d right = body.axis.unitOrthogonal(), ahead = body.axis.cross(right);
  std::vector<Vector2d> positions;  // angle round the axis, distance along it
  for (const std::uint32_t s : side.members) {
    const Vector3d away = body.away(side.point(s));
    positions.emplace_back(std::atan2(away.dot(ahead), away.dot(right)), body.axis.dot(side.point(s) - body.centre));
  }
  std::sort(positions.begin(), positions.end(), [](auto& a, auto& b) { return a.x() < b.x(); });
  double widest = positions.front().x() + 2 * pi - positions.back().x(), first = positions.front().x();
  double low = positions.front().y(), high = low;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    if (const double gap = positions[k].x() - positions[k - 1].x(); gap > widest)
      widest = gap, first = positions[k].x();
    low = std::min(low, positions[k].y()), high = std::max(high, positions[k].y());
  }
  const double middle = 0.5 * (low + high), spacing = side.spacing();
  const double closed = side.area() / (2 * pi * body.radius);
  if (body.radius * widest < 4 * spacing && std::abs(closed - (high - low)) < 2 * spacing) return {closed, middle};
  for (Vector2d& position : positions)
    position.x() = body.radius * (position.x() < first ? position.x() + 2 * pi - first : position.x() - first);
  return {high - low + 2 * edge_beyond_centres(positions, side.area(), spacing), middle};
}

}  // namespace

std::optional<FittedCylinder> cylinder_of(const CoherentGroup& group) {
  const SurfelGroup& all = group.surfels;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(all.moments([&](auto s) { return all.normal(s); }));
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.eigenvectors().col(k);
    const auto body =
        round_body(all.where([&](auto s) { return std::abs(all.normal(s).dot(axis)) < 0.3; }), group.noise, axis);
    if (!body) continue;

    // Every surfel must lie on the side or on an end, whatever its own normal is.
    const double reach = std::max(group.noise.reach(), 3.5 * std::sqrt(body->mean_square));
    SurfelGroup side =
        all.where([&](auto s) { return std::abs(body->away(all.point(s)).norm() - body->radius) <= reach; });
    SurfelGroup rest{all.scene, without(all.members, side.members)};
    FittedCylinder found{*body, {}};
    std::vector<SmoothTarget> ends;
    for (const double sense : {-1.0, 1.0}) {
      RoundBody turned = *body;
      turned.axis *= sense;
      const auto end = end_of(group, turned, reach);
      if (!end) continue;
      const auto on_end = [&](auto s) {
        return std::abs(end->first.normal.dot(all.point(s) - end->first.position)) <= reach &&
               all.normal(s).dot(turned.axis) > 0.5;
      };
      rest.members = rest.where([&](auto s) { return !on_end(s); }).members;
      side.members = side.where([&](auto s) { return !on_end(s); }).members;
      ends.push_back(group.plate(end->first, end->second));
    }
    if (!group.is_nearly_all(all.area() - rest.area()) || side.members.size() < fewest_surfels) continue;

    SmoothTarget cylinder = group.target();
    const auto [length, middle] = extent_along(*body, side);
    cylinder.radius = body->radius, cylinder.axis = body->axis, cylinder.length = length;
    cylinder.surface.position = body->centre + middle * body->axis;
    found.targets = {cylinder};
    found.targets.insert(found.targets.end(), ends.begin(), ends.end());
    return found;
  }
  return std::nullopt;
}

}  // namespace insonify
