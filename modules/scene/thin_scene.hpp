#pragma once
#include "core/units.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

struct ThinningOptions {
  double normal_angle = radians(30);  ///< surfels stand for others only if their normals differ by no more [rad]
};

/// A thinner cloud of the same surfaces: some surfels stay, with place, normal, material and id; each takes over the area of
/// those that go.
///
/// The ones that stay are a Poisson disc sample: no two of one material and similar normal are nearer than 0.8 spacings
/// to each other, and every one that goes has such a one that stays within that distance; its area goes to the nearest.
/// So their mean area is 1 to 1.2 spacing^2 where the cloud was denser, and what was thinner is as before. Who stays is
/// decided by the ids alone, not by the order of the surfels.
///
/// spacing   wanted between surfels [m]; a few of them should fit into a resolution cell of the sonar
/// returns   surfels in scene order; the area of each material is kept to rounding. Levels are kept within 0.1 dB as long
///           as the cloud that is left still shows the scene's shapes.
/// Throws Error for an invalid scene, a spacing that is not positive or that cuts the scene into more than 2^21 steps along
/// an axis, or an angle outside 0 .. pi/2. Takes about 2 s per million surfels on one core, 17 bytes for each, and 50 more
/// for each that stays.
SceneCloud thin_scene(const SceneCloud& scene, double spacing, const ThinningOptions& options = {});

}  // namespace insonify
