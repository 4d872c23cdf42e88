// SPDX-License-Identifier: BSD-3-Clause
#include "returns/echo_place.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "core/require.hpp"

namespace insonify {

Eigen::Vector3d way_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed) {
  require(sound_speed > 0, "way_of_echo", "sound_speed", sound_speed, "m/s", "> 0");
  const Eigen::Vector3d from = ping.world_from_head.linear() * direction, &v = ping.motion.velocity;
  if (ping.motion.none()) return range * from;
  const double c = sound_speed, duration = 2 * range / c, turn = ping.motion.turn_rate.norm();
  const Eigen::AngleAxisd turned(turn * duration, ping.motion.turn_rate.stableNormalized());
  const Eigen::Vector3d back = turned * from;
  // Vector to the head at reception, and from there back to the scatterer. (E44)
  return v * duration + (c * c - v.squaredNorm()) * duration / (2 * (c + v.dot(back))) * back;
}

Eigen::Vector3d way_of_beam(const Ping& ping, std::size_t beam, double range, double sound_speed) {
  const Eigen::Vector3d axis = unit_vector({ping.fan.azimuth[beam], ping.fan.elevation[beam]});
  Eigen::Vector3d way = way_of_echo(ping, axis, range, sound_speed);
  if (ping.motion.none() || ping.fan.row_width > 0) return way;
  constexpr int most_steps = 20;
  constexpr double exact = 1e-14;       // [rad]
  constexpr double least_ahead = 1e-6;  // direction cosine ahead of a beam; one along the array has no elevation
  const double across = std::hypot(axis.x(), axis.z());
  double turn = std::atan2(axis.z(), axis.x());
  for (int k = 0; k < most_steps; ++k) {
    const double ahead = across * std::cos(turn);
    if (std::abs(ahead) < least_ahead) break;
    const Eigen::Vector3d sent = ping.world_from_head.linear().transpose() * way;
    const double missed = (axis.z() - sent.z() / sent.norm()) / ahead;
    if (std::abs(missed) < exact) break;
    turn += missed;  // (E219)
    way = way_of_echo(ping, {across * std::cos(turn), axis.y(), across * std::sin(turn)}, range, sound_speed);
  }
  return way;
}

double distance_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed) {
  require(sound_speed > 0, "distance_of_echo", "sound_speed", sound_speed, "m/s", "> 0");
  const Eigen::Vector3d& v = ping.motion.velocity;
  const double c = sound_speed, closing = v.dot(ping.world_from_head.linear() * direction);
  return range / c * (c * c - v.squaredNorm()) / (c - closing);
}

}  // namespace insonify
