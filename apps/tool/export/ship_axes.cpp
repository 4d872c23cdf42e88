// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "tool/export/product_run.hpp"

namespace insonify::tool {

ShipAxes::ShipAxes(const Eigen::Vector3d& x, const Eigen::Vector3d& port) {
  ahead = {x.x(), x.y(), 0};
  if (ahead.norm() < 1e-6) ahead = port.cross(Eigen::Vector3d::UnitZ());
  ahead = ahead.norm() > 1e-6 ? ahead.normalized() : Eigen::Vector3d::UnitX();
  starboard = ahead.cross(Eigen::Vector3d::UnitZ());
}

ShipAxes axes_of_ship(const Eigen::Matrix3d& axes) {
  ShipAxes ship(axes.col(0), axes.col(1));
  ship.pitch = std::asin(std::clamp(axes(2, 0), -1.0, 1.0));
  ship.roll = std::atan2(axes(2, 1), axes(2, 2));
  return ship;
}

ShipAxes ship_axes(const RunPings& run, const Ping& ping) {
  if (const std::optional<Pose> ship = vehicle_pose(run, ping)) return axes_of_ship(ship->linear());
  const Eigen::Vector3d port = ping.world_from_head.linear().col(1);
  ShipAxes ship(port.cross(Eigen::Vector3d::UnitZ()), port);
  ship.roll = std::asin(std::clamp(port.z(), -1.0, 1.0));
  return ship;
}

Eigen::Vector3d axis_of_beam(const Ping& ping, std::size_t beam) {
  return ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[beam], ping.fan.elevation[beam]});
}

std::vector<SwathEntry> entries_from_port(const Ping& ping, const ShipAxes& ship, const BottomSoundings& found) {
  std::vector<std::pair<double, SwathEntry>> placed;
  std::size_t next = 0;
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const double across = axis_of_beam(ping, b).dot(ship.starboard);
    if (next == found.size() || found.beam[next] != b) placed.push_back({across, {b, {}}});
    for (; next < found.size() && found.beam[next] == b; ++next) placed.push_back({across, {b, next}});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SwathEntry> entries;
  for (const auto& [across, entry] : placed) entries.push_back(entry);
  return entries;
}

Eigen::Vector3d level_velocity(const std::optional<Trajectory>& way, double time) {
  if (!way) return Eigen::Vector3d::Zero();
  const Motion motion = motion_at(*way, std::clamp(time, way->time.front(), way->time.back()));
  return {motion.velocity.x(), motion.velocity.y(), 0};
}

}  // namespace insonify::tool
