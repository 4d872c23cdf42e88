// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/prepared_scene.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// A direction in which the scan has a hole, so that the presence of a surface is unknown.
struct Hole {
  std::uint32_t beam = 0;               ///< beam in whose share of the sector the hole lies
  double azimuth = 0, elevation = 0;    ///< in head axes [rad]
  double min_range = 0, max_range = 0;  ///< ranges of the surrounding surfels [m]
};

/// Result of find_holes.
struct Holes {
  std::vector<Hole> holes;     ///< sorted by beam, then by elevation
  std::size_t directions = 0;  ///< number of directions tested
};

/// Tests options.rays_per_beam directions per beam, distributed like the rays of find_scatterers. A direction is a hole
/// if surfels within three footprints surround it, but no surfel at their range covers it: an opening up to about seven
/// spacings wide. Wider openings count as open water except in narrow corners. A surface hit behind a hole does not
/// fill it. The options kind, splitting, occlusion and projection are ignored, and the result does not depend on
/// options.threads. Throws Error for an invalid pose, fan, gate or option, as find_scatterers does.
Holes find_holes(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                 const SamplingOptions& options = {});

/// Returns the world positions of holes [m]: in their directions, half way between the nearest and the farthest of the
/// surrounding surfels.
std::vector<Eigen::Vector3d> hole_positions(const Holes& holes, const Pose& world_from_head);

/// Returns a mask, beams x bins: 1 where surface may be missing, i.e. in the bins that overlap the range interval of a
/// hole in the beam's share, else 0. Shadows behind missing surface are not marked. Throws Error if a hole's beam is
/// not in the fan.
Grid<std::uint8_t> mask_holes(const Holes& holes, const BeamFan& fan, const RangeGate& gate);

}  // namespace insonify
