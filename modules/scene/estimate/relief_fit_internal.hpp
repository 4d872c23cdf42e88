// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Cholesky>

#include "scene/estimate/surfel_cell_internal.hpp"

// Private to scene: the rise of a surface over a plane, as a polynomial of the place on that plane (E69).
namespace insonify::cells {

struct ReliefFit {
  Vector2d slope = Vector2d::Zero();  // at the point
  double rise = 0;                    // of the polynomial over the point [m]
  double misfit = 0;                  // [m^2], mean square of what the polynomial leaves, per degree of freedom
  double leverage = 0;                // of the point's own rise on that of the polynomial
  bool found = false;                 // the places determine it
};

// Least squares through the point and its neighbours, all of one weight; `up` is the normal of the plane.
template <int Degree>
ReliefFit fit_relief(std::span<const Place> places, const Vector3d& up) {
  constexpr int terms = (Degree + 1) * (Degree + 2) / 2;
  using Terms = Eigen::Matrix<double, terms, 1>;
  if (places.size() < terms) return {};
  double reach = 0;
  for (const Place& p : places) reach = std::max(reach, p.flat.norm());
  // The point itself stands at the origin with no rise: only its constant term counts.
  Eigen::Matrix<double, terms, terms> normal = Eigen::Matrix<double, terms, terms>::Zero();
  normal(0, 0) = 1;
  Terms right = Terms::Zero();
  double square = 0;
  for (const Place& p : places) {
    const double x = p.flat.x() / reach, y = p.flat.y() / reach, rise = p.offset.dot(up);
    Terms power;
    power[0] = 1;
    for (int degree = 1, t = 1; degree <= Degree; t += ++degree) {
      power.segment(t, degree) = x * power.segment(t - degree, degree);
      power[t + degree] = y * power[t - 1];
    }
    normal.template selfadjointView<Eigen::Lower>().rankUpdate(power);
    right += rise * power;
    square += rise * rise;
  }
  const Eigen::LDLT<Eigen::Matrix<double, terms, terms>, Eigen::Lower> solver(normal);
  constexpr double least = 1e-7;  // of a well-determined pivot
  if (!(solver.vectorD().minCoeff() > least * solver.vectorD().maxCoeff())) return {};
  const Terms found = solver.solve(right);
  const double left = std::max(0.0, square - found.dot(right));
  const double leverage = solver.solve(Terms::Unit(0))[0];
  return {found.template segment<2>(1) / reach, found[0], left / static_cast<double>(places.size() + 1 - terms),
          leverage, true};
}

}  // namespace insonify::cells
