// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "returns/pixel_labels.hpp"
#include "sampling/seen_surfels.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Returns how the head of a ping sees each part of the scene (PartView). A part that stands as captured has neither
/// share nor extents.
///
/// seen     1 of each surfel of the scene that the head sees
std::vector<PartView> part_views(const SceneCloud& scene, const std::vector<std::uint8_t>& seen,
                                 const ResolvedPing& ping);

}  // namespace insonify
