// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "scene/estimate/micro_relief.hpp"

namespace insonify {

/// Order of visible surfels: by bands of range, and inside each by u, as streams of echoes add them to an image, or as
/// they stand in the scene.
enum class SurfelOrder { range_and_u, range };

/// The surfels that find_scatterers splits, counted and not yet split.
struct VisibleSurfels {
  std::vector<std::uint32_t> surfel;  ///< index in the scene; by bands of range, and inside each by SurfelOrder
  std::vector<std::size_t> first;     ///< number of the first part of each, and of all parts
  std::vector<SurfelBounds> bounds;   ///< bounds of each
  SamplingReport report;
  SamplingOptions options;  ///< with the outer scale of the relief that was left open
  std::optional<SceneRelief> relief;
};

/// Returns the visible surfels of a view. make_chunks makes the scatterers of find_scatterers from them, in another
/// order. options.kind is ignored. Errors as find_scatterers.
VisibleSurfels find_visible(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                            const RangeGate& gate, const SamplingOptions& options = {},
                            SurfelOrder order = SurfelOrder::range_and_u);

/// Returns the scatterers of visible surfels (indices in the scene, ascending), split and tilted as by find_scatterers
/// with these options.
Scatterers split_seen(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                      const RangeGate& gate, std::span<const std::uint32_t> surfels, const SamplingOptions& options);

/// Returns the scatterers of some of the visible surfels (`which`: indices in `visible`).
Scatterers make_chunks(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible,
                       std::span<const std::uint32_t> which, int threads);
/// Returns the scatterers of all visible surfels.
Scatterers make_chunks(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible);

}  // namespace insonify
