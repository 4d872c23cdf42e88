// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/units.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Options of thin_scene.
struct ThinningOptions {
  double normal_angle = radians(30);  ///< largest angle between the normals of a surfel and its representative [rad]
};

/// Returns a sparser cloud of the same surfaces: a subset of the surfels with position, normal, material and id. Each
/// remaining surfel takes over the area of the removed surfels that it represents.
///
/// The subset is a Poisson disc sample: no two remaining surfels of one material with similar normals are closer than
/// 0.8 spacing. Every removed surfel has a remaining one of its material and orientation within that distance; its area
/// goes to the nearest of them. The mean area is 1 to 1.2 spacing^2 where the cloud was denser; sparser regions are
/// unchanged. The selection depends only on the ids, not on the order of the surfels.
///
/// spacing   target distance between surfels [m]; a few of them should fit into a resolution cell of the sonar
/// returns   surfels in scene order; the area of each material is kept to rounding. Levels are kept within 0.1 dB as
///           long as the remaining cloud still resolves the shapes of the scene.
/// Throws Error for an invalid scene, a spacing that is not positive or that divides the scene into more than 2^21
/// cells along an axis, or an angle outside 0 .. pi/2. Takes about 2 s per million surfels on one core, and 17 bytes
/// per surfel plus 50 per kept one.
SceneCloud thin_scene(const SceneCloud& scene, double spacing, const ThinningOptions& options = {});

}  // namespace insonify
