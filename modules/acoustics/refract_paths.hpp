// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "acoustics/sound_speed_profile.hpp"
#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// A ray between two points of the same vertical plane.
struct Eigenray {
  double travel_time = 0;  ///< one way [s]
  double elevation = 0;    ///< where it leaves the first point [rad], positive up
};

/// Returns the ray that joins two points `horizontal` [m] and two depths [m] apart: arcs of circles in layers of
/// constant gradient (E43). Rays end neither at the water's surface nor at its bottom. Of several rays that turn once
/// at most the fastest (no path that is fastest of all turns twice); only where there is none, rays that turn more
/// often, up to eight times above and below each. Travel time is good to 1e-12 of itself; the ends may be exchanged.
/// The elevation of a vertical ray is +-pi/2; that between a point and itself 0. Throws Error(content) if no ray joins
/// them (a shadow zone: nothing but diffraction gets there), Error(argument) for an invalid profile, depths that are
/// not finite, or horizontal that is not finite and >= 0.
Eigenray find_eigenray(const SoundSpeedProfile& profile, double depth_from, double depth_to, double horizontal);

/// Returns an upper bound of the changes by refract_paths to any of the scatterers (in head axes), from the box of their
/// ranges and directions alone. The bound is some two to four times the true change where sound speed changes evenly.
/// Both are 0 if sound speed is the same wherever a ray between head and scatterers can run. `head_depth` [m] is the
/// depth of the head's origin; straight rays are timed with the profile's sound speed there. Errors as refract_paths.
RefractionBound refraction_bound(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                                 const Scatterers& scatterers);

/// Options of refract_paths.
struct RefractionOptions {
  const SceneCloud* scene = nullptr;  ///< whose surfels the scatterers are; none: their incidence stays
  double absorption = 0;              ///< absorption of amplitude over the true distance, not the apparent range [Np/m]
  int threads = 0;                    ///< 0: all cores; the result does not depend on it
};

/// Most that a tube of rays raises the intensity at a position over that of straight ones, each way. On a caustic, where rays
/// cross, it would be infinite.
inline constexpr double most_focusing = 10;

/// Moves every scatterer to its apparent position: at half the two-way travel time times the sound speed at the head, in
/// the direction from which its ray arrives (E43), within the vertical plane that holds it. Its projected area takes
/// what the tube of rays makes of spherical spreading, both ways, at most most_focusing each (E167), and the absorption
/// over the true distance. With `scene` its incidence is that of the refracted ray, by the normal of its surfel. Visibility
/// stays that of straight rays. World z points up, depth = head_depth - (z_world - z_head). Scatterers in a shadow zone
/// are silenced (projected area 0) and left in place.
///
/// More than some 8000 scatterers are interpolated over depth and distance: within 1e-6 m, 1e-5 rad and 0.05 dB of
/// find_eigenray and shoot_tube, and where points tried show that this would not hold each ray is solved. (A profile of
/// more than 150 entries within the scene's depths: 3e-6 m and 2e-5 rad.) Throws Error(argument) for an invalid profile,
/// head_depth or pose that is not finite, or a range that is not finite and > 0.
RefractedPaths refract_paths(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                             Scatterers& scatterers, const RefractionOptions& options = {});

/// Returns the largest changes by refract_paths to the scatterers inside sector and gate, in range, in angle at the head and in
/// level but for incidence, from about 1000 of them. Errors as refract_paths.
RefractionBound refraction_in_view(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                                   const Scatterers& scatterers, const Sector& sector, const RangeGate& gate,
                                   int threads = 0);

}  // namespace insonify
