// SPDX-License-Identifier: BSD-3-Clause
#include "support/kirchhoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace insonify {
namespace {

using Eigen::Vector3d;
constexpr double phase_per_panel = 5, slices_per_wavelength = 8;
constexpr double node[] = {-0.9602898564975363, -0.7966664774136267, -0.5255324099163290, -0.1834346424956498,
                           0.1834346424956498,  0.5255324099163290,  0.7966664774136267,  0.9602898564975363};
constexpr double weight[] = {0.1012285362903763, 0.2223810344533745, 0.3137066458778873, 0.3626837833783620,
                             0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

/// Calls body(x, weight of x) for nodes on [from, to], in as many panels as `phase` needs.
template <typename Body>
void on_nodes(double from, double to, double phase, Body&& body) {
  const int panels = 1 + static_cast<int>(std::abs(phase) / phase_per_panel);
  const double half = 0.5 * (to - from) / panels;
  for (int p = 0; p < panels; ++p)
    for (int k = 0; k < 8; ++k) body(from + half * (2 * p + 1 + node[k]), half * weight[k]);
}

}  // namespace

KirchhoffEcho::KirchhoffEcho(double nearest, double farthest, double wavenumber)
    : first_(nearest), step_(2 * std::numbers::pi / wavenumber / slices_per_wavelength), wavenumber_(wavenumber) {
  const auto slices = static_cast<std::size_t>((farthest - nearest) / step_) + 2;
  sum_.resize(slices), moment_.resize(slices);
}

void KirchhoffEcho::add(double range, double area) {
  const auto slice = static_cast<std::size_t>(std::clamp((range - first_) / step_, 0.0, double(sum_.size() - 1)));
  const double off = range - first_ - (static_cast<double>(slice) + 0.5) * step_;
  const std::complex<double> echo = area / (range * range) * std::polar(1.0, 2 * wavenumber_ * (range - first_)) *
                                    std::complex<double>(1, 1 / (wavenumber_ * range));
  sum_[slice] += echo;
  moment_[slice] += echo * off;
}

KirchhoffEcho KirchhoffEcho::of_polygon(const std::vector<Vector3d>& corners, double wavenumber) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  double nearest = std::abs(normal.dot(corners[0])), farthest = 0;
  for (const Vector3d& corner : corners) farthest = std::max(farthest, corner.norm());
  KirchhoffEcho echo(nearest, farthest, wavenumber);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    // A triangle as a square of which one side is shrunk to its first corner.
    const Vector3d &a = corners[0], b = corners[k] - a, c = corners[k + 1] - corners[k];
    const double twice_area = b.cross(c).norm();
    const auto steepest = [&](const Vector3d& along) {
      double most = 0;
      for (const Vector3d& at : {a, corners[k], corners[k + 1]})
        most = std::max(most, std::abs(at.dot(along)) / at.norm());
      return 2 * wavenumber * most;
    };
    const double out = std::max(steepest(b), steepest(b + c)), across = steepest(c);
    on_nodes(0, 1, out, [&](double x, double wx) {
      on_nodes(0, 1, across * x, [&](double y, double wy) {
        const Vector3d position = a + x * (b + y * c);
        const double range = position.norm();
        echo.add(range, twice_area * x * wx * wy * std::abs(normal.dot(position)) / range);
      });
    });
  }
  return echo;
}

KirchhoffEcho KirchhoffEcho::of_cylinder(const Vector3d& middle, const Vector3d& axis, double length, double radius,
                                         double wavenumber) {
  const double along = axis.dot(middle), out = (middle - along * axis).norm(), half = 0.5 * length;
  const Vector3d towards = -(middle - along * axis) / out, aside = axis.cross(towards);
  const double least = std::max(0.0, std::abs(along) - half), most = std::abs(along) + half;
  KirchhoffEcho echo(std::hypot(out - radius, least), std::hypot(out, most), wavenumber);
  const double edge = std::acos(radius / out), slope = 2 * wavenumber * most / std::hypot(out - radius, most);
  on_nodes(-edge, edge, 4 * wavenumber * radius * edge, [&](double turn, double wt) {
    const Vector3d normal = std::cos(turn) * towards + std::sin(turn) * aside;
    const Vector3d start = middle + radius * normal;
    on_nodes(-half, half, slope * length, [&](double s, double ws) {
      const Vector3d position = start + s * axis;
      const double range = position.norm();
      echo.add(range, radius * wt * ws * std::max(0.0, -normal.dot(position)) / range);
    });
  });
  return echo;
}

std::complex<double> KirchhoffEcho::steady() const {
  std::complex<double> sum = 0;
  for (const std::complex<double>& slice : sum_) sum += slice;
  return std::complex<double>(0, -wavenumber_ / (2 * std::numbers::pi)) * sum *
         std::polar(1.0, std::remainder(2 * wavenumber_ * first_, 2 * std::numbers::pi));
}

std::complex<double> KirchhoffEcho::at_range(double range, double pulse_width) const {
  std::complex<double> sum = 0;
  const double variance = pulse_width * pulse_width;
  for (std::size_t n = 0; n < sum_.size(); ++n) {
    const double late = range - first_ - (static_cast<double>(n) + 0.5) * step_;
    if (std::abs(late) > 7 * pulse_width) continue;
    const double g = std::exp(-late * late / (2 * variance)), slope = -late / variance * g,
                 curvature = (late * late / variance - 1) / variance * g;
    sum += g * sum_[n] - slope * moment_[n];
    // The factor k of the integral: that of each frequency of the pulse.
    sum += std::complex<double>(0, 0.5 / wavenumber_) * (slope * sum_[n] - curvature * moment_[n]);
  }
  return std::complex<double>(0, -wavenumber_ / (2 * std::numbers::pi)) * sum *
         std::polar(1.0, std::remainder(2 * wavenumber_ * first_, 2 * std::numbers::pi));
}

}  // namespace insonify
