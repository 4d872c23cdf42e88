// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/visible_surfels.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Visible surfels (indices in the scene, ascending) by place, with their bounds and the numbers of their parts.
struct PlacedSurfels {
  std::vector<std::uint32_t> surfel;
  std::vector<SurfelBounds> bounds;
  std::vector<std::uint16_t> pieces;
};

/// Sorts surfels by bands of 64 bins and inside a band by u, if asked for, then by index: neighbours add to the same part
/// of an image.
PlacedSurfels sort_by_place(const SceneCloud& scene, const HeadFrame& head, const RangeGate& gate, SurfelOrder order,
                            std::span<const std::uint32_t> surfels, std::span<const std::uint16_t> pieces, int threads);

}  // namespace insonify
