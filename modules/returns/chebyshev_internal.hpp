#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/units.hpp"

// Private to find_contributors: interpolation between n Chebyshev nodes cos((2j + 1) pi / 2n).
namespace insonify {

inline double chebyshev_angle(std::size_t j, std::size_t n) {
  return (static_cast<double>(j) + 0.5) * pi / static_cast<double>(n);
}

/// How many nodes over [-half, half] interpolate a sum of cosines no faster than 2 pi / period to `error` of its size;
/// 0: more than `most`. n nodes err by x^n / (2^(n-1) n!), x = 2 pi half / period.
inline std::size_t chebyshev_nodes(double half, double period, double error, std::size_t most) {
  const double x = 2 * pi * half / period;
  double left = x;
  for (std::size_t n = 1; n <= most; ++n, left *= x / (2 * static_cast<double>(n)))
    if (left <= error) return n;
  return 0;
}

/// Lagrange's polynomials of the n nodes at x within [-1, 1], by their barycentric form.
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
