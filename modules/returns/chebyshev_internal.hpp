#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/units.hpp"

// Interpolation between the n Chebyshev nodes cos((2j + 1) pi / 2n), for find_contributors.
namespace insonify {

inline double chebyshev_angle(std::size_t j, std::size_t n) {
  return (static_cast<double>(j) + 0.5) * pi / static_cast<double>(n);
}

/// Returns the number of nodes over [-half, half] that interpolate a sum of cosines of period >= `period` with relative
/// error `error`; 0 if more than `most` are needed. The error of n nodes is x^n / (2^(n-1) n!), x = 2 pi half / period.
inline std::size_t chebyshev_nodes(double half, double period, double error, std::size_t most) {
  const double x = 2 * pi * half / period;
  double left = x;
  for (std::size_t n = 1; n <= most; ++n, left *= x / (2 * static_cast<double>(n)))
    if (left <= error) return n;
  return 0;
}

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
