// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/sampled_cells.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Most parts of a surfel.
inline constexpr std::uint16_t most_parts = 4096;

/// How many parts each of some surfels is split into.
struct PartCounts {
  std::vector<std::uint16_t> parts;
  std::size_t capped = 0;  ///< surfels that would need more than most_parts
};

/// Counts the parts of the given surfels (indices in the scene): as many as `cells` ask for (E17), or, if
/// options.energy says what a beam receives of each, as their share of it asks for (E127) where that is less; rounded
/// up, at least 1 and at most most_parts. For shares the surfels must be all that are visible, ascending.
PartCounts count_parts(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                       const SampledCells& cells, const RangeGate& gate, const SamplingOptions& options);

/// Returns the number of the first part of each surfel, and at the end that of all parts. Throws Error for more than
/// 2^28.
std::vector<std::size_t> first_parts(std::span<const std::uint16_t> parts, double scatterers_per_cell);

}  // namespace insonify
