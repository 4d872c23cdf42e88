#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "scene/estimate/micro_relief.hpp"

namespace insonify {

/// The surfels that find_scatterers splits, counted and not yet split.
struct VisibleSurfels {
  std::vector<std::uint32_t> surfel;  ///< index in the scene; by bands of range, and inside each by u
  std::vector<std::size_t> first;     ///< number of the first part of each, and of all parts
  std::vector<SurfelBounds> bounds;   ///< of each
  SamplingReport report;
  SamplingOptions options;  ///< with the outer scale of the relief that was left open
  std::optional<ReliefField> relief;
};

/// Returns the visible surfels of a view, of which make_parts makes what find_scatterers would give, in another order;
/// options.kind does not count. Errors as find_scatterers.
VisibleSurfels find_visible(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                            const RangeGate& gate, const SamplingOptions& options = {});

/// Returns the scatterers of surfels that are seen (indices in the scene, ascending), split and tilted as by
/// find_scatterers with these options.
Scatterers split_seen(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                      const RangeGate& gate, std::span<const std::uint32_t> surfels, const SamplingOptions& options);

/// Returns the scatterers of the given ones of `visible` (indices there).
Scatterers make_parts(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible,
                      std::span<const std::uint32_t> which, int threads);
/// Returns the scatterers of all of them.
Scatterers make_parts(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible);

}  // namespace insonify
