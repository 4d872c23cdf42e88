// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Cholesky>

#include "scene/estimate/surfel_cell_internal.hpp"

// Private to scene: the rise of a surface over a plane, as a polynomial of the position on that plane (E69).
namespace insonify::cells {

struct ReliefFit {
  Vector2d slope = Vector2d::Zero();  // slope at the point
  double misfit = 0;                  // mean square residual per degree of freedom [m^2]
  bool found = false;                 // true: the positions determine the polynomial
};

template <int Degree>
inline constexpr int terms_of = (Degree + 1) * (Degree + 2) / 2;
template <int Degree>
using Terms = Eigen::Matrix<double, terms_of<Degree>, 1>;

inline constexpr double least_pivot = 1e-7;  // smallest pivot of a well-determined fit, over the largest

// Returns the terms of a polynomial at (x, y).
template <int Degree>
Terms<Degree> terms_at(double x, double y) {
  Terms<Degree> power;
  power[0] = 1;
  for (int degree = 1, t = 1; degree <= Degree; t += ++degree) {
    power.segment(t, degree) = x * power.segment(t - degree, degree);
    power[t + degree] = y * power[t - 1];
  }
  return power;
}

// Fits a polynomial through the point and its neighbours, all of one weight; `up` is the normal of the plane.
template <int Degree>
ReliefFit fit_relief(std::span<const FlatNeighbour> neighbours, const Vector3d& up) {
  constexpr int terms = terms_of<Degree>;
  using Terms = cells::Terms<Degree>;
  if (neighbours.size() < terms) return {};
  double reach = 0;
  for (const FlatNeighbour& p : neighbours) reach = std::max(reach, p.flat.norm());
  // The point itself stands at the origin with no rise: only its constant term counts.
  Eigen::Matrix<double, terms, terms> normal = Eigen::Matrix<double, terms, terms>::Zero();
  normal(0, 0) = 1;
  Terms right = Terms::Zero();
  double square = 0;
  for (const FlatNeighbour& p : neighbours) {
    const double rise = p.offset.dot(up);
    const Terms power = terms_at<Degree>(p.flat.x() / reach, p.flat.y() / reach);
    normal.template selfadjointView<Eigen::Lower>().rankUpdate(power);
    right += rise * power;
    square += rise * rise;
  }
  const Eigen::LDLT<Eigen::Matrix<double, terms, terms>, Eigen::Lower> solver(normal);
  if (!(solver.vectorD().minCoeff() > least_pivot * solver.vectorD().maxCoeff())) return {};
  const Terms found = solver.solve(right);
  const double left = std::max(0.0, square - found.dot(right));
  return {found.template segment<2>(1) / reach, left / static_cast<double>(neighbours.size() + 1 - terms), true};
}

}  // namespace insonify::cells
