// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include <Eigen/Dense>

#include "core/chebyshev.hpp"

namespace insonify {

inline Eigen::VectorXd chebyshev_points(std::size_t n) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(n));
  for (std::size_t j = 0; j < n; ++j) x[static_cast<Eigen::Index>(j)] = chebyshev_node(j, n);
  return x;
}

/// Chebyshev polynomials T_k(x), k < n: x by k.
Eigen::MatrixXd chebyshev_polynomials(const Eigen::VectorXd& x, Eigen::Index n);

/// values(x) = matrix x values(n nodes).
Eigen::MatrixXd from_nodes(const Eigen::VectorXd& x, std::size_t n);

/// Slopes at n nodes = matrix x values there.
Eigen::MatrixXd slope_at_nodes(std::size_t n);

/// Coefficients of powers of x, highest first = matrix x values(n nodes).
Eigen::MatrixXd powers_from_nodes(std::size_t n);

}  // namespace insonify
