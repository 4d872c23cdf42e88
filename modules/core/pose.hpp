#pragma once
#include <Eigen/Geometry>

namespace insonify {

/// Where the head is: x_world = world_from_head * x_head. Head axes: x forward, y port, z up (REP 103).
using Pose = Eigen::Isometry3d;

/// Pose from a position [m] and angles [rad]: yaw about z (positive to port), pitch about y (positive nose
/// down), roll about x (positive starboard down); R = Rz(yaw) Ry(pitch) Rx(roll), world z up.
Pose pose_from_yaw_pitch_roll(const Eigen::Vector3d& position, double yaw, double pitch, double roll);

/// The same pose given in a north-east-down world (z down, pitch positive nose up, roll positive starboard
/// down, yaw clockwise): rotated by half a turn about x on both sides into the z-up world (x, -y, -z).
Pose pose_from_ned(const Eigen::Vector3d& position, double yaw, double pitch, double roll);

/// A direction as seen from the head: azimuth = atan2(y, x) [rad, positive to port], elevation = asin(z/r).
struct Direction {
  double azimuth = 0;
  double elevation = 0;
};

/// Unit vector of a direction in head axes.
Eigen::Vector3d unit_vector(Direction direction);
/// Direction of a vector that is not zero; straight up or down has azimuth 0.
Direction direction_of(const Eigen::Vector3d& vector);

}  // namespace insonify
