// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "core/pose.hpp"

namespace insonify {

struct SceneCloud;

/// A rigid part of a scene at the time of a ping. Its surface has random numbers of its own, so that speckle and
/// micro-relief move with it and do not depend on what else is in the scene.
struct ScenePart {
  std::string name{};                                   ///< unique in the scene
  std::string label{};                                  ///< class of its pixels in data sets; empty: its materials
  std::uint64_t key = 0;                                ///< key of its random numbers: part_key(name)
  double spacing = 0;                                   ///< root of its mean surfel area [m]: scale of its micro-relief
  bool normals_oriented = true;                         ///< false: both sides of its surfels reflect
  Pose world_from_part = Pose::Identity();              ///< pose at the time of transmission
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< velocity of the part's origin, in the world [m/s]
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< rotation vector per second, in the world [rad/s]
  /// The part in its own axes; surfel `id` of the scene is number `id` in it. Null: its own axes are the world's.
  std::shared_ptr<const SceneCloud> own{};
  /// Origin of the axes of the part's file, in the part's own axes [m].
  Eigen::Vector3d file_origin = Eigen::Vector3d::Zero();
  double scale = 1;                                ///< lengths of the part over those of its file
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< extents along its file's axes [m]; zero: stands as captured

  /// Returns true if the part moves.
  bool moves() const { return !velocity.isZero(0) || !turn_rate.isZero(0); }
};

/// Returns a 64-bit hash of a name: FNV-1a with further mixing. Equal on all machines.
std::uint64_t part_key(const std::string& name);

}  // namespace insonify
