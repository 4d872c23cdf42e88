// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <span>

#include <Eigen/Core>

#include "support/ray_tube.hpp"

namespace insonify::traced {

/// A plane that reflects: normal . x = offset, x from the start of the ray, z up [m].
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// A ray reflected by planes.
struct BouncedArrival {
  double time = 0;                  ///< [s]
  Eigen::Vector3d launch, arrival;  ///< unit vectors along it
  double intensity = 0;             ///< intensity over that at 1 m [1/m^2]
};

/// Returns the ray that leaves the origin at `depth`, is reflected by all planes one after the other, and meets
/// `position`. It is shot in three dimensions by steps of at most 1 cm (Runge and Kutta), aimed by Newton's method from
/// the straight way. The intensity is that of the solid angle of neighbouring rays. Returns nothing if the ray does not
/// arrive.
std::optional<BouncedArrival> arrival_by_planes(const Water& water, double depth, std::span<const Plane> planes,
                                                const Eigen::Vector3d& position);

}  // namespace insonify::traced
