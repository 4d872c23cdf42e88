// SPDX-License-Identifier: BSD-3-Clause
#include "returns/echo_place.hpp"

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

double distance_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed) {
  require(sound_speed > 0, "distance_of_echo", "sound_speed", sound_speed, "m/s", "> 0");
  const Eigen::Vector3d& v = ping.motion.velocity;
  const double c = sound_speed, closing = v.dot(ping.world_from_head.linear() * direction);
  return range / c * (c * c - v.squaredNorm()) / (c - closing);
}

}  // namespace insonify
