// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/true_delays/node_functions_internal.hpp"

namespace insonify {
namespace {

/// Chebyshev coefficients = matrix x values(n nodes).
Eigen::MatrixXd coefficients_from_nodes(std::size_t n) {
  Eigen::MatrixXd known = chebyshev_polynomials(chebyshev_points(n), static_cast<Eigen::Index>(n)).transpose();
  known *= 2 / static_cast<double>(n);
  known.row(0) *= 0.5;
  return known;
}

}  // namespace

Eigen::MatrixXd chebyshev_polynomials(const Eigen::VectorXd& x, Eigen::Index n) {
  Eigen::MatrixXd t(x.size(), n);
  t.col(0).setOnes();
  if (n > 1) t.col(1) = x;
  for (Eigen::Index k = 2; k < n; ++k) t.col(k) = 2 * x.array() * t.col(k - 1).array() - t.col(k - 2).array();
  return t;
}

Eigen::MatrixXd from_nodes(const Eigen::VectorXd& x, std::size_t n) {
  return chebyshev_polynomials(x, static_cast<Eigen::Index>(n)) * coefficients_from_nodes(n);
}

Eigen::MatrixXd slope_at_nodes(std::size_t n) {
  const Eigen::VectorXd x = chebyshev_points(n);
  const Eigen::MatrixXd t = chebyshev_polynomials(x, static_cast<Eigen::Index>(n));
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(t.rows(), t.cols());
  if (n > 1) slope.col(1).setOnes();
  for (Eigen::Index k = 2; k < t.cols(); ++k)
    slope.col(k) = 2 * t.col(k - 1).array() + 2 * x.array() * slope.col(k - 1).array() - slope.col(k - 2).array();
  return slope * coefficients_from_nodes(n);
}

Eigen::MatrixXd powers_from_nodes(std::size_t n) {
  Eigen::MatrixXd vandermonde(n, n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      vandermonde(j, k) = std::pow(chebyshev_node(j, n), static_cast<double>(n - 1 - k));
  return vandermonde.inverse();
}

}  // namespace insonify
