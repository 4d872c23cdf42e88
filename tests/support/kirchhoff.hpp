// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Kirchhoff's integral over a rigid surface as sent back to a head at the origin, of a point source that has pressure
/// 1 at 1 m: sums over pieces of the surface, kept by range, so that echoes at one frequency and in time follow.
///
///   echo = -(i k / 2 pi) int (1 + i / (k r)) cos / r^2 exp(2 i k r) dS
///
/// Brute force: nodes of Gauss and Legendre, eight on each 5 rad of phase; the error is below 1e-4 of the integral of
/// the absolute value of any line of nodes (`Kirchhoff.*`). Of a cylinder what faces the head counts.
class KirchhoffEcho {
 public:
  using Vector3d = Eigen::Vector3d;

  /// Sums over a flat convex polygon.
  static KirchhoffEcho of_polygon(const std::vector<Vector3d>& corners, double wavenumber);
  /// Sums over the side of a cylinder, without its ends.
  static KirchhoffEcho of_cylinder(const Vector3d& middle, const Vector3d& axis, double length, double radius,
                                   double wavenumber);

  /// Returns the pressure at one frequency times 1 m.
  std::complex<double> steady() const;
  /// Returns the pressure in time, without exp(i w (t - 2 r / c)) of the range given, for a pulse whose envelope over
  /// range [m] is Gaussian with this standard deviation.
  std::complex<double> at_range(double range, double pulse_width) const;
  double nearest() const { return first_; }
  double farthest() const { return first_ + step_ * static_cast<double>(sum_.size()); }

 private:
  KirchhoffEcho(double nearest, double farthest, double wavenumber);
  void add(double range, double weight);

  double first_, step_, wavenumber_;
  std::vector<std::complex<double>> sum_, moment_;  // over the pieces in a slice of range: echo, echo x range
};

}  // namespace insonify
