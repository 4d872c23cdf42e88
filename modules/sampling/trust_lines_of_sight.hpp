#pragma once
#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Raises scene.noise so that no surfel hides another from `viewpoint` (world, [m]), the place that all of them were seen
/// from: what was seen through a surface says how ragged the scan is there. Surfels that hide nothing keep their noise; an
/// empty scene.noise counts as 0. Does not depend on `threads`.
void trust_lines_of_sight(const Eigen::Vector3d& viewpoint, int threads, SceneCloud& scene);

}  // namespace insonify
