#pragma once
#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"

namespace insonify {

/// The part of the world that a head can look at: no surfel outside it blocks or is heard.
struct InsonifiedRegion {
  Pose world_from_head = Pose::Identity();
  Sector sector;
  RangeGate gate;          ///< of which the far end counts: what stands nearer than the gate can block
  double footprint = 1.2;  ///< radius of a surfel's disc in units of its spacing sqrt(area)
};

/// Everything within `radius` [m] of `centre` (world).
InsonifiedRegion region_around(const Eigen::Vector3d& centre, double radius);

/// False only if no surfel of at most `largest_area` [m^2] whose middle lies in the ball (world, [m]) is within reach:
/// the rule by which find_scatterers chooses what to look at, for many surfels at once.
bool may_hold(const InsonifiedRegion& region, const Eigen::Vector3d& ball_centre, double ball_radius,
              double largest_area);

}  // namespace insonify
