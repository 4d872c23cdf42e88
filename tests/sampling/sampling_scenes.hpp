// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sampling/find_scatterers.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify {

/// Adds a wall at x that faces the head at the origin.
inline void add_wall(SceneCloud& scene, double x, double half_width, double half_height, double spacing,
                     double jitter = 0) {
  add_rectangle(scene, {x, -half_width, -half_height}, {0, 2 * half_width, 0}, {0, 0, 2 * half_height}, {-1, 0, 0},
                spacing, jitter);
}

inline BeamFan wide_fan() { return make_fan(91, radians(90), radians(1), radians(60)); }
inline RangeGate long_gate() { return {0.1, 100, 0.05}; }

/// Returns options for visibility alone: every visible surfel is one scatterer at its centre.
inline SamplingOptions unsplit() { return {.scatterers_per_cell = 0}; }

inline Pose at(double x, double y, double z, double yaw_deg = 0, double pitch_deg = 0) {
  return pose_from_yaw_pitch_roll({x, y, z}, radians(yaw_deg), radians(pitch_deg), 0);
}

inline bool equal(const Scatterers& a, const Scatterers& b) {
  return a.range == b.range && a.azimuth == b.azimuth && a.elevation == b.elevation &&
         a.cos_incidence == b.cos_incidence && a.projected_area == b.projected_area && a.material == b.material &&
         a.id == b.id && a.surfel == b.surfel;
}

}  // namespace insonify
