// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include <Eigen/Core>

#include "tool/run/run_pings.hpp"

/// Which way a ship points, for products that have its attitude.
namespace insonify::tool {

/// Level axes of a ship, and its attitude.
struct ShipAxes {
  Eigen::Vector3d ahead, starboard;
  double pitch = 0, roll = 0;  ///< bow up, starboard down [rad]

  /// Takes the axes from `x`, a direction ahead, level or not, or from the `port` axis if `x` is upright.
  ShipAxes(const Eigen::Vector3d& x, const Eigen::Vector3d& port);
};

/// Axes of the ship with its axes x ahead, y to port and z up as columns: pitch is of x, roll about it.
ShipAxes axes_of_ship(const Eigen::Matrix3d& axes);

/// Axes of the ship at a ping; of an unknown one by the port axis of the head, without pitch.
ShipAxes ship_axes(const RunPings& run, const Ping& ping);

/// Velocity over ground at a time; 0 without a way.
Eigen::Vector3d level_velocity(const std::optional<Trajectory>& way, double time);

}  // namespace insonify::tool
