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

// Normal equations of a polynomial through the point and its neighbours, all of one weight. Those of lower degrees are
// their first terms.
template <int Degree>
struct ReliefSums {
  Eigen::Matrix<double, terms_of<Degree>, terms_of<Degree>> normal;
  Terms<Degree> right;
  double square = 0;  // sum of squared rises [m^2]
  double reach = 0;   // distance of the farthest neighbour on the plane [m]
  std::size_t neighbours = 0;
};

// Sums over neighbours; `up` is the normal of the plane.
template <int Degree>
ReliefSums<Degree> relief_sums(std::span<const FlatNeighbour> neighbours, const Vector3d& up) {
  ReliefSums<Degree> sums;
  sums.neighbours = neighbours.size();
  for (const FlatNeighbour& p : neighbours) sums.reach = std::max(sums.reach, p.flat.norm());
  // The point itself stands at the origin with no rise: only its constant term counts.
  sums.normal.setZero(), sums.right.setZero();
  sums.normal(0, 0) = 1;
  for (const FlatNeighbour& p : neighbours) {
    const double rise = p.offset.dot(up);
    const Terms<Degree> power = terms_at<Degree>(p.flat.x() / sums.reach, p.flat.y() / sums.reach);
    sums.normal.noalias() += power * power.transpose();
    sums.right += rise * power;
    sums.square += rise * rise;
  }
  return sums;
}

// Fits a polynomial of a degree to sums of this or a higher one.
template <int Degree, int Summed>
ReliefFit fit_relief(const ReliefSums<Summed>& sums) {
  constexpr int terms = terms_of<Degree>;
  using Square = Eigen::Matrix<double, terms, terms>;
  if (sums.neighbours < terms) return {};
  const Terms<Degree> right = sums.right.template head<terms>();
  const Eigen::LDLT<Square, Eigen::Lower> solver(Square(sums.normal.template topLeftCorner<terms, terms>()));
  if (!(solver.vectorD().minCoeff() > least_pivot * solver.vectorD().maxCoeff())) return {};
  const Terms<Degree> found = solver.solve(right);
  const double left = std::max(0.0, sums.square - found.dot(right));
  return {found.template segment<2>(1) / sums.reach, left / static_cast<double>(sums.neighbours + 1 - terms), true};
}

}  // namespace insonify::cells
