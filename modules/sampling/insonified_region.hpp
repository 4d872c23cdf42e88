// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "core/pose.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// The part of the world that a head can receive from: a surfel outside neither occludes nor contributes.
struct InsonifiedRegion {
  Pose world_from_head = Pose::Identity();
  Sector sector;
  RangeGate gate;          ///< only the far end counts: surfels nearer than the gate can occlude
  double footprint = 1.2;  ///< radius of a surfel's disc in units of its spacing sqrt(area)
};

/// Returns the region within `radius` [m] of `centre` (world).
InsonifiedRegion region_around(const Eigen::Vector3d& centre, double radius);

/// Returns false only if no surfel of at most `largest_area` [m^2] with its centre in the ball (world, [m]) overlaps
/// the region: the selection rule of find_scatterers for whole groups of surfels.
bool may_intersect(const InsonifiedRegion& region, const Eigen::Vector3d& ball_centre, double ball_radius,
                   double largest_area);

}  // namespace insonify
