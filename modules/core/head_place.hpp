#pragma once
#include "core/pose.hpp"

namespace insonify {

/// The parameters of pose_from_yaw_pitch_roll.
struct HeadPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0, pitch = 0, roll = 0;
  bool operator==(const HeadPlace&) const = default;
};
/// Returns pose_from_yaw_pitch_roll of these parameters.
Pose pose_of(const HeadPlace& head);
/// Inverse of pose_of: yaw and roll in (-pi, pi], pitch in [-pi/2, pi/2]; roll is 0 for a vertical head.
HeadPlace head_place(const Pose& pose);

}  // namespace insonify
