#pragma once
#include <cstdint>
#include <vector>

#include "scene/material.hpp"
#include "scene/sample_patches_internal.hpp"

namespace insonify {

/// Quay wall, pilings, rippled sea bed, wreck, pipe, boulders, tyres and a calibration sphere; see
/// built_in_scenes.hpp. `seed` shifts the ripples.
std::vector<Patch> harbour_patches(std::uint64_t seed);
std::vector<Material> harbour_materials();

}  // namespace insonify
