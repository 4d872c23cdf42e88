// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/sound_speed_profile.hpp"

namespace insonify {

/// The end of a ray.
struct RayEnd {
  double horizontal = 0;  ///< horizontal distance from its start [m], >= 0
  double depth = 0;       ///< depth [m], positive down
  double elevation = 0;   ///< elevation of the ray there [rad], positive up
};

/// A ray and how the narrow tube of rays around it widens.
struct RayTube {
  RayEnd end;
  double way = 0;  ///< integral of sound speed over the ray's length [m^2/s]
  double width =
      0;  ///< how far neighbouring rays are apart, across the ray in its vertical plane, per angle between them
          ///< at the start, times the sound speed there [m^2/s]; < 0 behind a caustic

  /// Intensity there over that 1 m from the start [1/m^2] (E167): c_start c_end / (way abs(width)), which is 1 / r^2 in
  /// water of one sound speed, and the same both ways. Infinite on a caustic.
  double spreading(double speed_at_start, double speed_at_end) const;
};

/// Returns the tube about the ray of shoot_ray, with its errors. Dynamic ray tracing: within layers of constant gradient
/// the tube widens evenly over `way`; where the gradient changes by dg it is bent by -width cos^2 / sin dg / c^2.
RayTube shoot_tube(const SoundSpeedProfile& profile, double depth, double elevation, double time);

/// Returns where a ray gets that leaves `depth` [m] at `elevation` [rad, positive up] and runs for `time` [s, one way]
/// (E93): arcs of circles in layers of constant gradient, the way back of find_eigenray. Rays end neither at the
/// water's surface nor at its bottom. Throws Error(argument) for an invalid profile, arguments that are not finite, a
/// time < 0, or an elevation beyond +-pi/2.
RayEnd shoot_ray(const SoundSpeedProfile& profile, double depth, double elevation, double time);

}  // namespace insonify
