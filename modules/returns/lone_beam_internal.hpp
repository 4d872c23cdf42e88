// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "returns/bottom_fits_internal.hpp"
#include "returns/ping.hpp"

namespace insonify {

/// Effect of a plane on the echo of a lone beam.
struct LonePlane {
  double pulse = 0;      ///< variance of the pulse's intensity in range [m^2]
  double curvature = 0;  ///< variance of ranges on a plane across the beam, weighted by its pattern [m^2]
  double slope = 0;      ///< variance that a level bed adds, because the beam is tilted [m^2]
  double steep = 0;      ///< variance that a bed 25 degrees off the normal of the beam would add [m^2]
  double across = 0;     ///< mean range of a plane across the beam, less that on its axis [m]
  double range = 0;      ///< range on the axis [m]
};

/// Returns the echo of a level bed at `range` [m] on the axis of a ping's only beam. `pulse_deviation` is the standard
/// deviation of the pulse's intensity in range [m]. (E170)
LonePlane plane_of_lone_beam(const Ping& ping, double range, double pulse_deviation);

/// Returns the range of the bed on the beam's axis by the centre of gravity of the echo about `start`, and its
/// deviation (E171). The echo's own width shows how far slope and relief extend it; a plane of the same width gives the
/// difference between the mean range over the footprint and that on the axis. The deviation is relative to the mean of
/// the bed over the footprint. It is infinite without an echo.
BottomEstimate range_of_lone_beam(const BottomBeam& beam, const LonePlane& plane, double start);

}  // namespace insonify
