// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Returns 1 for each gated surfel that is hidden by another one, else 0. Tests only surfels that could give an echo
/// (in the gate and facing the head). `projection` (not automatic) affects the cost only.
std::vector<std::uint8_t> find_hidden(const GatedSurfels& surfels, Projection projection, int threads);

}  // namespace insonify
