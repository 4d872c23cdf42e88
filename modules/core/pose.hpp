// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Geometry>

namespace insonify {

/// Pose of the head: x_world = world_from_head * x_head. Head axes: x forward, y port, z up (REP 103).
using Pose = Eigen::Isometry3d;

/// Returns the pose at `position` [m] with orientation R = Rz(yaw) Ry(pitch) Rx(roll), angles in rad, world z up: yaw
/// positive to port, pitch positive nose down, roll positive starboard down.
Pose pose_from_yaw_pitch_roll(const Eigen::Vector3d& position, double yaw, double pitch, double roll);

/// The parameters of pose_from_yaw_pitch_roll.
struct PoseAngles {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0, pitch = 0, roll = 0;                 ///< [rad]
  bool operator==(const PoseAngles&) const = default;
};
/// Returns pose_from_yaw_pitch_roll of these parameters.
Pose pose_of(const PoseAngles& head);
/// Inverts pose_of. Yaw and roll are in (-pi, pi], pitch in [-pi/2, pi/2]; roll is 0 for a vertical head.
PoseAngles pose_angles(const Pose& pose);

/// Returns the pose given in a north-east-down world (z down; yaw positive clockwise, pitch positive nose up, roll
/// positive starboard down), converted to the z-up world (x, -y, -z) by a rotation of pi about x on both sides.
Pose pose_from_ned(const Eigen::Vector3d& position, double yaw, double pitch, double roll);

/// Direction in head axes: azimuth = atan2(y, x) [rad, positive to port], elevation = asin(z/r) [rad].
struct Direction {
  double azimuth = 0;
  double elevation = 0;
};

/// Returns the unit vector of a direction in head axes.
Eigen::Vector3d unit_vector(Direction direction);
/// Returns the direction of a non-zero vector; straight up and straight down have azimuth 0.
Direction direction_of(const Eigen::Vector3d& vector);

}  // namespace insonify
