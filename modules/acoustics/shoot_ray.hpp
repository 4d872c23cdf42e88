// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/sound_speed_profile.hpp"

namespace insonify {

/// Where a ray gets.
struct RayEnd {
  double horizontal = 0;  ///< [m], >= 0 ahead of its start
  double depth = 0;       ///< [m], positive down
  double elevation = 0;   ///< of the ray there [rad], positive up
};

/// Returns where a ray gets that leaves `depth` [m] at `elevation` [rad, positive up] and runs for `time` [s, one way]
/// (E93): arcs of circles in layers of constant gradient, the way back of find_eigenray. Rays end neither at the
/// water's surface nor at its bottom. Throws Error(argument) for an invalid profile, arguments that are not finite, a
/// time < 0, or an elevation beyond +-pi/2.
RayEnd shoot_ray(const SoundSpeedProfile& profile, double depth, double elevation, double time);

}  // namespace insonify
