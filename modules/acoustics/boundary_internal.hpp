// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "acoustics/aperture.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/multipath_echoes.hpp"

namespace insonify {

/// Returns a point mirrored in a plane; exact for level planes, of which it turns the height alone.
inline Eigen::Vector3d mirrored_in(const MirrorPlane& plane, const Eigen::Vector3d& point) {
  return (point - 2 * plane.normal().dot(point) * plane.normal()) - 2 * plane.offset() * plane.normal();
}

/// A reflecting plane, as a head sees it: the surface, a flat bottom or a mirror.
struct Boundary {
  MirrorPlane plane;                       ///< world; its normal points into the water
  Eigen::Vector3d normal;                  ///< the plane's normal in head axes
  double head_distance = 0;                ///< distance of the head from the plane, into the water [m]
  double rms_height = 0;                   ///< rms height of the relief [m]
  double thickness = 0;                    ///< captured points nearer than this are the boundary itself [m]
  double wavenumber = 0;                   ///< [rad/m]
  double sound_speed = 0;                  ///< sound speed of the water [m/s]
  bool ends_water = false;                 ///< true: nothing beyond it counts (surface, mirrors without edges)
  const FlatBottom* bottom = nullptr;      ///< flat bottom that the plane stands for, or null
  const Mirror* mirror = nullptr;          ///< mirror, or null; neither: the surface, which turns the sign
  std::vector<Eigen::Vector3d> corners{};  ///< in head axes; empty: no edges

  /// Returns the distance from the plane into the water [m] of a position in head axes; negative beyond it.
  double distance(const Eigen::Vector3d& position) const { return normal.dot(position) + head_distance; }
  Eigen::Vector3d mirrored(const Eigen::Vector3d& position) const { return position - 2 * distance(position) * normal; }
  Eigen::Vector3d mirrored_direction(const Eigen::Vector3d& direction) const {
    return direction - 2 * normal.dot(direction) * normal;
  }
  /// Returns true for a captured piece of the boundary itself: near the plane and lying along it. The mirror stands for
  /// it already; its own image would all but coincide with it.
  bool holds(double distance_into_water, double along_normal) const {
    return std::abs(distance_into_water) <= thickness && std::abs(along_normal) > 0.5;
  }
  /// Returns whether the foot of the perpendicular from a position lies within the edges, to a millimetre.
  bool within_edges(const Eigen::Vector3d& position) const;
  /// Returns the pressure reflection coefficient, reduced by roughness.
  std::complex<double> reflection(double grazing) const;
  /// Returns the factor of the boundary's edges (E150) on the path from the head to a position; `image` is the image of
  /// that position in the boundary, in head axes.
  std::complex<double> edges(const Eigen::Vector3d& image) const;
  /// Returns the largest factor of roughness on a bounce within `range` [m] of the image, which is that at the least
  /// grazing angle.
  double strongest_bounce(double range) const;
};

/// Least factor of patterns, reflections and edges on an echo: -80 dB.
inline constexpr double echo_floor = 1e-4;

/// Returns the distance outside the gate within which the pulse of an echo reaches into the gate [m].
double pulse_margin(const Transmission& sent);

/// Returns the square root of the two-way pattern; imaginary where that is negative, so that its square is the two-way
/// pattern.
std::complex<double> one_way_pattern(const EchoOptions& options, double v);

/// Returns two directions across a straight path from the head to `end`, as columns.
Eigen::Matrix<double, 3, 2> across_way(const Eigen::Vector3d& end);

/// Returns the Fresnel parameters per metre across a path of this length [m], at `crossing` as a part of it (E150).
double fresnel_scale(double length, double crossing, double wavenumber);

/// Returns the corners of a plane as Fresnel parameters across a straight path from the head to `end` (E150), which
/// crosses the plane where `crossing` says, as a part of the way; in the same order.
ConvexPolygon fresnel_corners(std::span<const Eigen::Vector3d> corners, const Eigen::Vector3d& end, double crossing,
                              double wavenumber);

/// Returns surface and bottom of `environment`, surface first. Throws Error if there is none, or the head is not in the
/// water between them.
std::vector<Boundary> boundaries_of(const Environment& environment, const Pose& world_from_head,
                                    const Transmission& transmission, double tolerance, const char* who);

/// Returns the mirrors that a head faces; refers to `mirrors`. Throws Error if the head stands on one or behind one
/// without edges, and for more than most_boundaries.
std::vector<Boundary> boundaries_of(std::span<const Mirror> mirrors, const Pose& world_from_head,
                                    const Transmission& transmission, const char* who);

}  // namespace insonify
