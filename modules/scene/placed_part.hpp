// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// A rigid part of a scene at the time of a ping: surfels in the part's own axes, their pose, and their motion.
struct PlacedPart {
  std::string name{};   ///< unique in the scene; determines the random numbers of its surface
  std::string label{};  ///< class of its pixels in data sets; empty: its materials are the classes
  std::shared_ptr<const SceneCloud> cloud{};  ///< in the part's own axes; surfel i has the id i unless `captured`
  /// True: the part's own axes are those of the world, and it rests there. Other parts stand on it as the ground.
  bool captured = false;
  Pose world_from_part = Pose::Identity();              ///< pose at the time of transmission
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< velocity of the part's origin, in the world [m/s]
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< rotation vector per second, in the world [rad/s]
  /// Surfels of the part that are in the scene, ascending; those below the ground are left out. Empty: all.
  std::vector<std::uint32_t> surfels{};

  /// True: the part is listed, but not in the scene. In scenes with randomly drawn bodies this gives the parts of all
  /// pings the same numbers. An absent part needs only a name and a label.
  bool absent = false;

  /// Origin of the axes of the part's file, in the part's own axes, which begin near its surfels [m].
  Eigen::Vector3d file_origin = Eigen::Vector3d::Zero();

  double scale = 1;  ///< lengths of `cloud` over those of the part's file
  /// Extents of the part along its own axes, as scaled [m], e.g. of the mesh that its surfels are a sample of. Zero:
  /// those of the box of its surfels.
  Eigen::Vector3d size = Eigen::Vector3d::Zero();

  /// Key of the random numbers of its surface. Absent: part_key(name). With 0 a captured part has the numbers that it
  /// has as a scene of its own.
  std::optional<std::uint64_t> key{};

  /// Returns the pose of the axes of the part's file.
  Pose world_from_file() const { return world_from_part * Eigen::Translation3d(file_origin); }
  /// Places the axes of the part's file at a pose, with a velocity of their origin [m/s] and a turn rate [rad/s].
  void place_file(const Pose& world_from_file, const Eigen::Vector3d& speed = Eigen::Vector3d::Zero(),
                  const Eigen::Vector3d& turn = Eigen::Vector3d::Zero()) {
    world_from_part = world_from_file * Eigen::Translation3d(-file_origin);
    velocity = speed - turn.cross(world_from_file.linear() * file_origin);
    turn_rate = turn;
  }
  /// Returns true if the part moves.
  bool moves() const { return !velocity.isZero(0) || !turn_rate.isZero(0); }
};

/// Throws Error(argument) naming `who` and the part unless the part is valid. A part needs a name. Unless absent, it
/// also needs surfels, a finite pose that is a rotation and a translation, and a finite motion. A captured part must
/// not be moved, turned or moving.
void require_valid(const PlacedPart& part, const char* who);

}  // namespace insonify
