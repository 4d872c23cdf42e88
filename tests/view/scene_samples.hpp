// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/units.hpp"
#include "support/scenes.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// Returns a head with a fan of 61 beams.
inline SceneHead head_at(const Pose& world_from_head, double field_of_view_deg = 90, double max_range = 15) {
  return {world_from_head, make_fan(61, radians(field_of_view_deg), radians(2), radians(20)), {1, max_range, 0.05}};
}

}  // namespace insonify
