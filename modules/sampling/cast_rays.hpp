#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels.hpp"

namespace insonify {

/// The part of the insonified sector that one beam's rays cover.
struct BeamShare {
  double min_azimuth = 0, max_azimuth = 0;      ///< [rad]
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};

/// Shares of all beams: they tile `sector` in azimuth, cut at the midpoints between neighbouring beams. Beams
/// of one azimuth share the sector's elevations in the same way. So every direction belongs to one beam, also when
/// rows are staggered or no two beams have an azimuth in common: rays serve all beams, not only their own.
std::vector<BeamShare> beam_shares(const BeamFan& fan, const Sector& sector);

struct CastResult {
  Scatterers scatterers;
  std::size_t missed = 0;       ///< rays that met nothing
  std::size_t unknown = 0;      ///< of these, with surfels within three footprints on all sides
  std::size_t met_surfels = 0;  ///< different surfels that gave an echo
};

/// rays_per_beam rays in each beam's share: one per equal interval of elevation, jittered in it, spread in
/// azimuth by the golden ratio. Each ray's cell is its part of the share: r^2 cos(elevation) dtheta dphi.
/// The projection (not automatic) changes the cost alone.
CastResult cast_rays(const SceneCloud& scene, const std::vector<GatedSurfel>& surfels, Projection projection,
                     const std::vector<BeamShare>& shares, const RangeGate& gate, const SamplingOptions& options);

}  // namespace insonify
