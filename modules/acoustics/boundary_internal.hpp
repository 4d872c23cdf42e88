// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "acoustics/environment.hpp"
#include "acoustics/multipath_echoes.hpp"

namespace insonify {

/// A reflecting plane, as a head sees it.
struct Boundary {
  double height = 0;         ///< world z [m]
  double water_side = 1;     ///< 1: the water lies above it, -1: below
  double head_height = 0;    ///< of the head above the plane, negative below it [m]
  Eigen::Vector3d up;        ///< of the world, in head axes
  double rms_height = 0;     ///< of its relief [m]
  double thickness = 0;      ///< captured points so near to it are the boundary itself [m]
  double wavenumber = 0;     ///< [rad/m]
  const FlatBottom* bottom;  ///< nullptr: the surface, which reflects everything with the sign turned

  /// Distance from the plane into the water [m] of a place in head axes; negative beyond it.
  double distance(const Eigen::Vector3d& place) const { return water_side * (up.dot(place) + head_height); }
  Eigen::Vector3d mirrored(const Eigen::Vector3d& place) const {
    return place - 2 * (up.dot(place) + head_height) * up;
  }
  Eigen::Vector3d mirrored_direction(const Eigen::Vector3d& direction) const {
    return direction - 2 * up.dot(direction) * up;
  }
  /// True for a captured piece of the boundary itself: near the plane and lying rather than standing. The mirror
  /// stands for it already; its own image would all but coincide with it.
  bool holds(double distance_into_water, double normal_up) const {
    return std::abs(distance_into_water) <= thickness && std::abs(normal_up) > 0.5;
  }
  /// Pressure reflection coefficient, with what roughness leaves of it.
  std::complex<double> reflection(double grazing) const;
  /// What roughness leaves at most of a bounce within `range` [m] of the image, at the least grazing angle there is.
  double strongest_bounce(double range) const;
};

/// The boundaries of `environment`, surface first. Throws Error if there is none, or the head is not in the water
/// between them.
std::vector<Boundary> boundaries_of(const Environment& environment, const Pose& world_from_head,
                                    const Transmission& transmission, double tolerance, const char* who);

}  // namespace insonify
