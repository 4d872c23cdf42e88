// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Returns `wanted`, or for automatic the projection with the lower estimated cost for `queries` directions: the
/// raster, unless too many surfels are too wide for its tiles.
Projection choose_projection(const GatedSurfels& surfels, Projection wanted, std::size_t queries, int threads);

}  // namespace insonify
