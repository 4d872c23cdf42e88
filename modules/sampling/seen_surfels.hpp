// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sampling/find_scatterers.hpp"

namespace insonify {

/// Visibility of a surfel from a head.
enum class Visibility : std::uint8_t {
  not_queried,
  outside,      ///< outside of sector or gate
  turned_away,  ///< faces away from the head
  hidden,       ///< behind other surfels
  seen
};

/// Returns the visibility of the surfels marked in `queried` (one entry per surfel, 0: not queried); the others only
/// occlude. Sector, gate, hit rule and options are those of find_scatterers, and so is the result, which does not
/// depend on options.threads. Throws Error for an invalid fan or gate, or if `queried` does not have one entry per
/// surfel.
std::vector<Visibility> find_visibility(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& queried,
                                        const SamplingOptions& options);
/// Returns the same for a prepared scene, at a cost that grows with the insonified region, plus one byte per surfel of
/// the scene.
std::vector<Visibility> find_visibility(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& queried,
                                        const SamplingOptions& options);

/// Returns the scatterers of the listed surfels, visible or not, split as by find_scatterers: the same parts with the
/// same ids and positions. Parts that face away have cos_incidence and projected_area 0.
Scatterers split_listed(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                        const std::vector<std::uint32_t>& surfels, const SamplingOptions& options);
/// Returns the same for a prepared scene.
Scatterers split_listed(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                        const RangeGate& gate, const std::vector<std::uint32_t>& surfels,
                        const SamplingOptions& options);

}  // namespace insonify
