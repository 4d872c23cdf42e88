#pragma once
#include <cstdint>
#include <vector>

#include "sampling/find_scatterers.hpp"

namespace insonify {

/// What became of a surfel that a head was asked about.
enum class Visibility : std::uint8_t {
  not_asked,
  outside,      ///< of the fan's sector or the gate
  turned_away,  ///< shows the head its back
  hidden,       ///< behind other surfels
  seen
};

/// How a head sees the surfels marked in `asked` (one entry per surfel, 0: not asked); the others only block. Sector,
/// gate, hit rule and options are those of find_scatterers, and so is the answer. Does not depend on options.threads.
/// Throws Error for an invalid fan or gate, or if `asked` has another length than the scene.
std::vector<Visibility> find_visibility(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& asked,
                                        const SamplingOptions& options);
/// The same from a scene in blocks: the same answer, at a cost that grows with what the fan reaches, beside one byte
/// per surfel of the scene.
std::vector<Visibility> find_visibility(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& asked,
                                        const SamplingOptions& options);

/// Scatterers of the listed surfels, seen or not, split as find_scatterers splits them: the same parts with the same
/// ids at the same places. A part that turns its back has cos_incidence and projected_area 0.
Scatterers split_listed(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                        const std::vector<std::uint32_t>& surfels, const SamplingOptions& options);
/// The same for a scene in blocks.
Scatterers split_listed(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                        const RangeGate& gate, const std::vector<std::uint32_t>& surfels,
                        const SamplingOptions& options);

}  // namespace insonify
