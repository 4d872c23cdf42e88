// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// A rigid part of a scene at the time of a ping: surfels in axes of their own, where they stand, and how they move.
struct PlacedPart {
  std::string name{};   ///< unique in the scene; random numbers of its surface follow from it
  std::string label{};  ///< class of its pixels in data sets; empty: its materials are the classes
  std::shared_ptr<const SceneCloud> cloud{};  ///< in the part's own axes; surfel i has the id i unless `captured`
  /// The part's own axes are those of the world, and it rests there: the ground that all else stands on.
  bool captured = false;
  Pose world_from_part = Pose::Identity();              ///< at the time of transmission
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< of the origin of its axes, in the world [m/s]
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< rotation vector per second, in the world [rad/s]
  /// The surfels that are there, ascending: what lies in the ground is left out. Empty: all.
  std::vector<std::uint32_t> surfels{};

  /// The part is not there, but it is listed: where bodies are drawn, the parts of all pings have the same numbers. It
  /// needs only a name and a label.
  bool absent = false;

  /// Whether the part moves.
  bool moves() const { return !velocity.isZero(0) || !turn_rate.isZero(0); }
};

/// Throws Error(argument) naming `who` and the part unless the part has a name, and if it is there surfels, a finite pose
/// that is a rotation and a translation, and a finite motion; a captured part must not be moved, turned or moving.
void require_valid(const PlacedPart& part, const char* who);

}  // namespace insonify
