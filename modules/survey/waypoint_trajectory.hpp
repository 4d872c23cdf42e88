// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/motion.hpp"

namespace insonify {

/// A route through points at constant speed.
struct Waypoints {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  double speed = 0;                     ///< [m/s]
  double turn_radius = 2;               ///< radius of the turns between legs [m]; less where a leg is too short for it
  double start_time = 0;                ///< [s]
};

/// Returns the trajectory of a vehicle along the waypoints. It has straight legs, and at every corner an arc that
/// touches both legs and takes at most half of each. Yaw follows the route; pitch and roll are 0. A vertical leg keeps
/// the yaw of the leg before it; at the begin it has that of the next leg that is not vertical, or 0. Arcs have an
/// entry every two degrees, so the trajectory deviates from them by less than 2e-4 of their radius. Throws
/// Error(argument) for fewer than two points, points that are not finite or coincide with their neighbour, a leg that
/// goes straight back, and a speed or radius that is not finite and > 0.
Trajectory waypoint_trajectory(const Waypoints& waypoints);

}  // namespace insonify
