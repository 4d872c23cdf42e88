// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

namespace insonify::traced {

/// Sound speed over depth, linear between entries.
struct Water {
  std::vector<double> depth, speed;  ///< [m], positive down; [m/s]
  double speed_at(double z) const;
  double gradient_at(double z) const;
};

/// A ray at a horizontal distance.
struct Arrival {
  double time = 0;       ///< [s]
  double launch = 0;     ///< elevation at the start [rad], positive up
  double arrival = 0;    ///< elevation at the end [rad]
  double intensity = 0;  ///< intensity over that at 1 m [1/m^2]
};

/// Returns the fastest of the rays that never turn back which join two points, by integrating the ray equations over
/// distance (Runge and Kutta, steps of at most 5 cm that end where the gradient changes). The intensity is that of the
/// tube between two rays 1e-6 rad apart. Launch angles are tried within 1 rad of the straight way. Returns nothing if
/// there is no such ray.
std::optional<Arrival> fastest_arrival(const Water& water, double depth_from, double depth_to, double horizontal);

}  // namespace insonify::traced
