// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// The arrival that one position of a smooth body sends back to the head, in head axes [m].
struct BodyArrival {
  Eigen::Vector3d position;  ///< place that sends it back: a specular point, a point of an edge, a corner
  Eigen::Vector3d
      apparent;  ///< where it seems to come from: `position`; near the middle of a body that is small in phase
  std::complex<double> factor;  ///< amplitude over exp(2 i k r) / (2 r), r the range of `apparent`; of a rigid body
  std::complex<double> rise;    ///< change of `factor` with wavenumber, times the wavenumber
  double grazing;               ///< angle of sound to the surface at `position` [rad]
};

/// Returns the echo of a rigid plate by Kirchhoff's integral (E164): of its specular point, if that lies within the
/// edges, of the foot of the perpendicular on each edge, if that lies within the edge, and of each corner.
///
/// corners     convex, counterclockwise as seen from the head [m]
/// normal      unit vector towards the head
/// wavenumber  [rad/m]
///
/// At the wavenumber the sum of the arrivals is Kirchhoff's integral to 1e-4 of the largest arrival, and to 1 / (k r).
/// Edges fade with wavenumber^-1/2 and corners with its inverse: `rise`.
std::vector<BodyArrival> plate_arrivals(std::span<const Eigen::Vector3d> corners, const Eigen::Vector3d& normal,
                                        double wavenumber);

/// Returns the echo of the side of a rigid cylinder, by stationary phase across its axis (E166): of its specular point,
/// if that lies within its length, and of both ends of the line along it that is nearest to the head. Errors of 1 / (k
/// radius). Empty if the head is not beside it.
///
/// middle  of the axis; axis: unit vector; length and radius [m]
std::vector<BodyArrival> cylinder_arrivals(const Eigen::Vector3d& middle, const Eigen::Vector3d& axis, double length,
                                           double radius, double wavenumber);

}  // namespace insonify
