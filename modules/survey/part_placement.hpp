// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "acoustics/motion.hpp"
#include "scene/ground.hpp"

namespace insonify {

/// Position, rest and motion of a part of a scene.
struct PartPlacement {
  bool captured = true;                                ///< true: the coordinates of the file count, and no other member
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< origin of the file's axes at time 0 [m, world]
  PartRest rest = PartRest::none;                      ///< how the part rests on the ground at time 0
  double bury = 0;                                     ///< depth below the ground [m]
  double yaw = 0, pitch = 0, roll = 0;                 ///< angles of pose_from_yaw_pitch_roll [rad]
  double scale = 1;                                    ///< factor of all lengths
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< rotation vector per second, world axes [rad/s]
  /// Replaces position, velocity and turn rate; yaw, pitch and roll turn the part in the axes of these poses.
  std::optional<Trajectory> trajectory{};

  /// Returns true if the pose depends on time.
  bool moves() const { return trajectory || !velocity.isZero(0) || !turn_rate.isZero(0); }
};

/// Bodies at random positions in an area: their number, the area, and the ranges of their poses.
struct ScatterRule {
  int least = 0, most = 0;                 ///< number of bodies, uniform between both
  std::vector<Eigen::Vector2d> area;       ///< corners of a polygon [m, world]
  std::optional<double> min_distance{};    ///< distance of centres [m]; absent: footprints do not overlap
  double yaw = 0, tilt = 0;                ///< half widths of uniform draws [rad]; tilt: pitch and roll each
  double least_bury = 0, most_bury = 0;    ///< buried share of the height of the body
  double least_scale = 1, most_scale = 1;  ///< factor of all lengths
  double empty_share = 0;                  ///< share of the draws that have no body at all
  PartRest rest = PartRest::ground;
};

/// Throws Error(argument) unless counts and intervals ascend, the area is a polygon, and the largest number of bodies
/// fits into it at the least distance: their discs cover at most 0.45 of the area.
void require_valid(const ScatterRule& rule, const char* who);

/// The pose of the axes of a part's file in the world, and their motion.
struct MovingAxes {
  Pose pose = Pose::Identity();
  Motion motion;
};
/// Returns the axes at `time` [s] of a part called `name`. Throws Error(content) outside the times of its trajectory.
MovingAxes axes_at(const PartPlacement& placement, const std::string& name, double time);

/// Returns the cloud with all lengths multiplied by `scale`; the cloud itself for 1.
std::shared_ptr<const SceneCloud> scaled(const std::shared_ptr<const SceneCloud>& cloud, double scale);

/// Returns the area of a polygon [m^2], 0 for fewer than three corners.
double area_of_polygon(const std::vector<Eigen::Vector2d>& corners);
/// Returns true if a position lies within a polygon.
bool is_within(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& position);

}  // namespace insonify
