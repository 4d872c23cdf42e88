// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "scene/prepared_scene.hpp"

namespace insonify {

/// Returns a block of a part, which the part has in its own axes, at the pose of the part in a scene. `first` is the
/// place of the part's first surfel in the order of the scene.
inline SurfelBlock placed_block(SurfelBlock block, const Eigen::Isometry3d& scene_from_part, std::uint32_t first) {
  constexpr float rounding = 1 + 1e-5F, of_coordinate = 4e-7F;  // of a float
  block.centre = (scene_from_part * block.centre.cast<double>()).cast<float>();
  block.radius = block.radius * rounding + of_coordinate * (block.centre.norm() + block.radius);
  block.begin += first, block.end += first;
  return block;
}

}  // namespace insonify
