#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/sampled_cells.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// The number of the first part of each surfel, and at the end that of all parts.
struct PartCounts {
  std::vector<std::size_t> first;
  std::size_t capped = 0;  ///< surfels that would need more than 4096 parts
};
/// Counts the parts of the given surfels (indices in the scene): as many as `cells` ask for (E17), rounded up, 1 .. 4096.
/// Throws Error for more than 2^28.
PartCounts count_parts(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                       const SampledCells& cells, int threads);

/// Returns the scatterers of the given surfels, `first` as counted for them, in order. Part 0 is at the surfel's centre;
/// part k is point k of a low-discrepancy sequence over a disc of the surfel's area in its tangent plane, shifted and
/// rotated by random numbers of (seed, surfel id): at the same position in the scene for every pose.
Scatterers split_surfels(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         std::span<const std::size_t> first, std::uint64_t seed, int threads);

}  // namespace insonify
