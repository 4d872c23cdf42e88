// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Raises scene.noise until no surfel hides another from `viewpoint` (world, [m]). The scanner saw all surfels from
/// there, and a surfel that would hide another is displaced by noise. Surfels that hide nothing keep their noise; an
/// empty scene.noise counts as 0. With `stations`, a number for each surfel, the scanner saw only the surfels whose
/// number is `station`. The result does not depend on `threads`.
void trust_lines_of_sight(const Eigen::Vector3d& viewpoint, int threads, SceneCloud& scene,
                          std::span<const std::uint16_t> stations = {}, std::uint16_t station = 0);

}  // namespace insonify
