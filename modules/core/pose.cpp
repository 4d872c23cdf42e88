// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.hpp"

#include <algorithm>
#include <cmath>

namespace insonify {

Pose pose_from_yaw_pitch_roll(const Eigen::Vector3d& position, double yaw, double pitch, double roll) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Pose pose = Pose::Identity();
  pose.linear() =
      (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) * AngleAxisd(roll, Vector3d::UnitX()))
          .toRotationMatrix();
  pose.translation() = position;
  return pose;
}

Pose pose_of(const PoseAngles& head) {
  return pose_from_yaw_pitch_roll(head.position, head.yaw, head.pitch, head.roll);
}

PoseAngles pose_angles(const Pose& pose) {
  const Eigen::Matrix3d r = pose.linear();
  PoseAngles head;
  head.position = pose.translation();
  const double level = std::hypot(r(0, 0), r(1, 0));
  head.pitch = std::atan2(-r(2, 0), level);
  if (level > 1e-9) {
    head.yaw = std::atan2(r(1, 0), r(0, 0));
    head.roll = std::atan2(r(2, 1), r(2, 2));
  } else {
    head.yaw = std::atan2(-r(0, 1), r(1, 1));
  }
  return head;
}

Pose pose_from_ned(const Eigen::Vector3d& position, double yaw, double pitch, double roll) {
  // A rotation by pi about x maps (x, y, z) to (x, -y, -z); applied on both sides it negates yaw and pitch and keeps
  // roll.
  return pose_from_yaw_pitch_roll({position.x(), -position.y(), -position.z()}, -yaw, -pitch, roll);
}

Eigen::Vector3d unit_vector(Direction direction) {
  const double c = std::cos(direction.elevation);
  return {c * std::cos(direction.azimuth), c * std::sin(direction.azimuth), std::sin(direction.elevation)};
}

Direction direction_of(const Eigen::Vector3d& v) {
  const double r = v.norm();
  if (v.x() == 0 && v.y() == 0) return {0, v.z() < 0 ? -M_PI_2 : M_PI_2};
  return {std::atan2(v.y(), v.x()), std::asin(std::clamp(v.z() / r, -1.0, 1.0))};
}

}  // namespace insonify
