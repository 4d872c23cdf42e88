// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/units.hpp"

// Interpolation between the n Chebyshev nodes cos((2j + 1) pi / 2n) of [-1, 1].
namespace insonify {

/// Returns the angle of node j of n [rad].
inline double chebyshev_angle(std::size_t j, std::size_t n) {
  return (static_cast<double>(j) + 0.5) * pi / static_cast<double>(n);
}

/// Returns node j of n.
inline double chebyshev_node(std::size_t j, std::size_t n) { return std::cos(chebyshev_angle(j, n)); }

/// Evaluates the Lagrange polynomials of the n nodes at x in [-1, 1], in barycentric form.
inline void lagrange(std::size_t n, double x, double* value) {
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double angle = chebyshev_angle(j, n), off = x - std::cos(angle);
    if (off == 0) {
      std::fill(value, value + n, 0.0);
      value[j] = 1;
      return;
    }
    value[j] = (j % 2 ? -1 : 1) * std::sin(angle) / off;
    sum += value[j];
  }
  for (std::size_t j = 0; j < n; ++j) value[j] /= sum;
}

}  // namespace insonify
