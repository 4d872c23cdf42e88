// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Size, density and seed of a built-in scene.
struct BuiltInSceneOptions {
  std::size_t points = 200000;                         ///< requested number of surfels; met within 2 %
  Eigen::Vector2d size = Eigen::Vector2d(40.0, 40.0);  ///< [m]; plane: extent in x and y; wall: width and height
  double radius = 0.5;                                 ///< [m]; sphere
  double lambert_mu = 0.001995262314968880;  ///< [1/sr] of plane, wall, sphere (harbour, reef, river: per part)
  std::uint64_t seed = 1;                    ///< seeds the stratified jitter, the ripples, corals and boulders
};

/// Returns the names accepted by make_built_in_scene: harbour, reef, river, plane, sphere, wall, poles.
std::vector<std::string> built_in_scene_names();

/// Returns a reproducible scene with outward normals, exact areas and materials. The sampling is stratified and
/// preserves areas:
///   harbour  quay wall, pilings, rippled sea bed, wreck, pipe, calibration sphere; x 0..60, y -30..30, water
///            surface z = 0, sea bed near z = -8; a good pose is 0,0,-3, pitch 10 deg
///   reef     spurs of rough rock over sand, with massive, branching and table corals; x 0..12, y -6..6, z -5..-3; a
///            good pose is 0,0,-3, pitch 15 deg
///   river dunes with ripples, pits and boulders between banks, with gaps as a scan has them behind boulders; x 0..40,
///            y -8..8, z -7..-4.2, water surface z = 0; a good way of a swath is along y = 0 at z = -0.5
///   plane    z = 0, x 0..size.x, y -size.y/2..size.y/2, normal up
///   sphere   centred at (5, 0, 0)
///   wall     x = 5, y -size.x/2..size.x/2, z -size.y/2..size.y/2, normal towards -x, with a 1 m square hole
///            in its centre when it is larger than 2 m
///   poles    three vertical poles (radius 0.1 m) at x = 4, y = -1, 0, 1 in front of a wall at x = 7
/// Throws Error for an unknown name (listing the known ones), points = 0, or a size that is not positive.
SceneCloud make_built_in_scene(const std::string& name, const BuiltInSceneOptions& options = {});

/// Makes the same surfels in the same order and passes them to `consume` in scenes of about `batch` surfels each. Use
/// it for scenes that do not fit into memory. Exceptions thrown by `consume` propagate.
void make_built_in_scene_in_batches(const std::string& name, const BuiltInSceneOptions& options, std::size_t batch,
                                    const std::function<void(const SceneCloud&)>& consume);
/// Returns the built-in scene without surfels, with its materials.
SceneCloud empty_built_in_scene(const std::string& name, const BuiltInSceneOptions& options = {});

}  // namespace insonify
