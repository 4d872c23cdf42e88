#pragma once
#include "sampling/insonified_region.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// What simulate_ping looks at, of any scene with these properties: the same bytes come of all surfels and of those
/// within reach alone, in the same order and with SceneCloud::part_of set. With multipath it is a ball, since bounces
/// come from all sides. Throws Error as simulate_ping does.
InsonifiedRegion ping_region(const WholeScene& whole, const SonarHead& head, const Pose& world_from_head,
                             const Environment& environment, const SimulationOptions& options = {});

}  // namespace insonify
