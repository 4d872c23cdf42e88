#pragma once
#include <cstddef>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// `wanted`, or for automatic the projection that costs less for so many directions: raster, unless too many surfels fill
/// more than it puts into tiles.
Projection choose_projection(const std::vector<GatedSurfel>& surfels, Projection wanted, std::size_t queries,
                             int threads);

}  // namespace insonify
