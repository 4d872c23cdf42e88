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
  std::size_t missed = 0;       ///< rays that met nothing
  std::size_t unknown = 0;      ///< of these, with surfels within three footprints on all sides
  std::size_t met_surfels = 0;  ///< different surfels that gave an echo
};

/// Where the rays of all beams (beam_rays) meet the surfels. Each ray's cell is r^2 times its solid angle.
/// The projection (not automatic) changes the cost alone.
CastResult cast_rays(const SceneCloud& scene, const std::vector<GatedSurfel>& surfels, Projection projection,
                     const std::vector<BeamShare>& shares, const RangeGate& gate, const SamplingOptions& options);

}  // namespace insonify
