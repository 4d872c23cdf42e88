#pragma once
#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/micro_relief.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Gives every scatterer on a material with a relief_slope the incidence of the facet that the relief puts in its
/// place (E52). With c the cosine of incidence on the smooth surface, t that on the facet (0 if it looks away from the
/// head), projected areas are multiplied by t / c: a surfel's part keeps its share of the surfel's area, seen under the
/// new angle, and surfels and rays keep one mean level. Facets do not shadow each other.
///
/// scatterers   in axes of a head at `world_from_head`; those on smooth materials are not touched
void tilt_by_relief(const SceneCloud& scene, const Pose& world_from_head, const ReliefField& relief, int threads,
                    Scatterers& scatterers);

}  // namespace insonify
