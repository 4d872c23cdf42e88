// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/beam_rays_internal.hpp"
#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

struct CastResult {
  Scatterers scatterers;
  std::size_t missed = 0;       ///< rays that hit no surfel
  std::size_t unknown = 0;      ///< missed rays that are surrounded by surfels within three footprints
  std::size_t hit_surfels = 0;  ///< number of distinct surfels hit inside the gate
};

/// Casts the rays of all beams (beam_rays) and returns a scatterer for each hit inside the gate, with a projected area
/// of r^2 times the solid angle of the ray. `projection` (not automatic) affects the cost only.
CastResult cast_rays(const SceneCloud& scene, const GatedSurfels& surfels, Projection projection,
                     const std::vector<BeamCell>& shares, const RangeGate& gate, const SamplingOptions& options);

}  // namespace insonify
