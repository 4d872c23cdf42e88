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
inline constexpr std::uint16_t most_subranges = 4096;

/// Numbers of parts into which some surfels are split.
struct PieceCounts {
  std::vector<std::uint16_t> pieces;
  std::size_t capped = 0;  ///< surfels that would need more than most_subranges
};

/// Counts the parts of the given surfels (indices in the scene): the number that `cells` need (E17), or, with
/// options.energy, the number that the surfel's fraction of the received energy needs (E127), whichever is less.
/// Numbers are rounded up, and within 1 and most_subranges. With options.energy, the surfels must be all visible ones,
/// ascending.
PieceCounts count_pieces(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         const SampledCells& cells, const RangeGate& gate, const SamplingOptions& options);

/// Returns the number of the first part of each surfel, and at the end that of all parts. Throws Error for more than
/// 2^28.
std::vector<std::size_t> first_pieces(std::span<const std::uint16_t> pieces, double scatterers_per_cell);

}  // namespace insonify
