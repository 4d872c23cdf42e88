#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/find_scatterers.hpp"
#include "sampling/range_gate.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// A direction in which the scan has a hole: what stands there is not known.
struct Hole {
  std::uint32_t beam = 0;               ///< in whose share of the sector it lies
  double azimuth = 0, elevation = 0;    ///< in head axes [rad]
  double min_range = 0, max_range = 0;  ///< of the surfels around it [m]
};

struct Holes {
  std::vector<Hole> holes;     ///< by beam, then upwards in elevation
  std::size_t directions = 0;  ///< how many were looked at
};

/// Looks along options.rays_per_beam directions of each beam's share of the insonified sector, spread like the rays of
/// find_scatterers. There is a hole where surfels stand within three footprints on all sides, but nothing at their range
/// meets the ray: an opening less than about seven spacings wide. A wider one counts as open water but for its narrow
/// corners. What a ray meets further behind does not fill the hole.
/// Of `options` kind, splitting, occlusion and projection have no part in it. The result does not depend on
/// options.threads. Throws Error for an invalid pose, fan, gate or option, as find_scatterers does.
Holes find_holes(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                 const SamplingOptions& options = {});

/// Where holes are in the world [m]: in their directions, half way between the nearest and the farthest of the surfels
/// around them.
std::vector<Eigen::Vector3d> places_of(const Holes& holes, const Pose& world_from_head);

/// Mask, beams x bins: 1 where surface may be missing, in bins that touch the range interval of a hole in the beam's
/// share; else 0. Shadows behind missing surface are not marked. Throws Error if a hole's beam is not of the fan.
Grid<std::uint8_t> mask_holes(const Holes& holes, const BeamFan& fan, const RangeGate& gate);

}  // namespace insonify
