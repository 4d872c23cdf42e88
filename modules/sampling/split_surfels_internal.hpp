// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Returns the scatterers of the given surfels, `first` the number of the first part of each (first_pieces), in order.
/// Part 0 is at the surfel's centre; part k is point k of a low-discrepancy sequence over a disc of the surfel's area
/// in its tangent plane, shifted and rotated by random numbers of (seed, surfel id): at the same position in the scene
/// for every pose. Where a surfel is deeper than range_resolution [m], its surface is divided among the parts by range
/// (E128).
Scatterers split_surfels(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         std::span<const std::size_t> first, double range_resolution, std::uint64_t seed, int threads);

}  // namespace insonify
