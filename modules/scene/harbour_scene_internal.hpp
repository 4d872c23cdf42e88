#pragma once
#include <cstdint>
#include <vector>

#include "scene/material.hpp"
#include "scene/sample_patches_internal.hpp"

namespace insonify {

/// Returns the surfaces of the harbour: quay wall, pilings, rippled sea bed, wreck, pipe, boulders, tyres and
/// calibration sphere; see built_in_scenes.hpp. `seed` determines the phases of the ripples.
std::vector<Patch> harbour_patches(std::uint64_t seed);
std::vector<Material> harbour_materials();

}  // namespace insonify
