// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/estimate/micro_relief.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Replaces the incidence of each scatterer on a material with a relief_slope by that of the facet that the relief has
/// at its position (E52). With c the cosine of incidence on the smooth surface and t that on the facet (0 if it faces
/// away from the head), projected areas are multiplied by t / c: each part keeps its share of the surfel's area under
/// the new angle, and surfels and rays have the same mean level. Facets do not shadow each other.
///
/// scatterers   in the axes of a head at `world_from_head`; those on smooth materials are unchanged
void tilt_by_relief(const SceneCloud& scene, const Pose& world_from_head, const SceneRelief& relief, int threads,
                    Scatterers& scatterers);

}  // namespace insonify
