// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/motion.hpp"

namespace insonify {

/// Pose and motion of a vehicle.
struct VehicleState {
  Pose pose;
  Motion motion;
};

/// Returns the two entries about a time, because interpolation checks all entries of its trajectory. O(log n).
Trajectory entries_about(const Trajectory& trajectory, double time);

/// Returns pose and motion at a time; before and after the trajectory the vehicle moves and turns as in its first and
/// last interval. O(log n).
VehicleState vehicle_at(const Trajectory& trajectory, double time);

}  // namespace insonify
