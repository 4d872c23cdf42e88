// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "scene/sample_patches_internal.hpp"

namespace insonify {

/// Returns the surfaces of the built-in reef: rough spurs of rock with sand between them, massive, branching and table
/// corals. `seed` determines roughness and positions.
std::vector<Patch> reef_patches(std::uint64_t seed);

/// Returns the materials of the reef, in the order of the numbers that the patches hold.
std::vector<Material> reef_materials();

/// Returns the surfaces of the built-in river bed: dunes with ripples, pits and boulders between two banks, and gaps
/// where a scan saw nothing. `seed` determines phases and positions.
std::vector<Patch> river_patches(std::uint64_t seed);

/// Returns the materials of the river, in the order of the numbers that the patches hold.
std::vector<Material> river_materials();

}  // namespace insonify
