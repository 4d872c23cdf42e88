// SPDX-License-Identifier: BSD-3-Clause
#include "survey/waypoint_trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

/// The route: positions, and the direction of travel at each.
struct SampledPath {
  std::vector<Vector3d> position, ahead;
  void add(const Vector3d& at, const Vector3d& direction) {
    if (!position.empty() && (at - position.back()).norm() < 1e-9) return;
    position.push_back(at), ahead.push_back(direction);
  }
};

/// Adds the arc about corner `i` that takes at most half of both legs.
void add_turn(const Waypoints& w, std::size_t i, SampledPath& path) {
  const Vector3d in = w.points[i] - w.points[i - 1], out = w.points[i + 1] - w.points[i];
  const Vector3d a = in.normalized(), b = out.normalized();
  const double turn = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
  if (turn < 1e-6) return;
  if (turn > pi - 1e-3)
    fail(ErrorKind::argument, "waypoint_trajectory: points[", i,
         "]: the way goes straight back; give a point beside it for the turn");
  const double room = std::min(in.norm(), out.norm()) / 2;
  const double cut = std::min(room, w.turn_radius * std::tan(turn / 2)), radius = cut / std::tan(turn / 2);
  const Vector3d begin = w.points[i] - cut * a, inward = (b - a.dot(b) * a).normalized();
  const int steps = static_cast<int>(std::ceil(turn / radians(2)));
  for (int s = 0; s <= steps; ++s) {
    const double angle = turn * s / steps;
    path.add(begin + radius * (std::sin(angle) * a + (1 - std::cos(angle)) * inward),
             std::cos(angle) * a + std::sin(angle) * inward);
  }
}

void require_valid(const Waypoints& w) {
  if (w.points.size() < 2)
    fail(ErrorKind::argument, "waypoint_trajectory: ", w.points.size(), " points, must be at least two");
  for (std::size_t i = 0; i < w.points.size(); ++i) {
    if (!w.points[i].allFinite()) fail(ErrorKind::argument, "waypoint_trajectory: points[", i, "] must be finite");
    if (i > 0 && (w.points[i] - w.points[i - 1]).norm() < 1e-6)
      fail(ErrorKind::argument, "waypoint_trajectory: points[", i, "] is at the place of the one before it");
  }
  for (const auto& [value, name, unit] :
       {std::tuple(w.speed, "speed", "m/s"), std::tuple(w.turn_radius, "turn_radius", "m")})
    if (!(value > 0 && std::isfinite(value)))
      fail(ErrorKind::argument, "waypoint_trajectory: ", name, " = ", value, " ", unit, ", must be finite and > 0");
}

/// Returns the first direction that is not vertical.
Vector3d first_level(const SampledPath& path) {
  for (const Vector3d& ahead : path.ahead)
    if (std::hypot(ahead.x(), ahead.y()) > 1e-6) return ahead;
  return Vector3d::UnitX();
}

}  // namespace

Trajectory waypoint_trajectory(const Waypoints& w) {
  require_valid(w);
  SampledPath path;
  path.add(w.points.front(), (w.points[1] - w.points[0]).normalized());
  for (std::size_t i = 1; i + 1 < w.points.size(); ++i) add_turn(w, i, path);
  path.add(w.points.back(), (w.points.back() - w.points[w.points.size() - 2]).normalized());

  Trajectory t;
  double gone = 0;
  Vector3d level = first_level(path);
  for (std::size_t i = 0; i < path.position.size(); ++i) {
    if (i > 0) gone += (path.position[i] - path.position[i - 1]).norm();
    if (std::hypot(path.ahead[i].x(), path.ahead[i].y()) > 1e-6) level = path.ahead[i];
    t.time.push_back(w.start_time + gone / w.speed);
    t.pose.push_back(pose_from_yaw_pitch_roll(path.position[i], std::atan2(level.y(), level.x()), 0, 0));
  }
  return t;
}

}  // namespace insonify
