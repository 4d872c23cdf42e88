// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "core/chebyshev.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t max_width = 16, max_degree = 24;

std::size_t width_for(double tolerance) {
  const double digits = -std::log10(std::clamp(tolerance, 1e-16, 0.1));
  return std::min(max_width, static_cast<std::size_t>(std::ceil(digits)) + 1);
}

/// Returns the coefficients, lowest power first, of the polynomial of `degree` that interpolates f at the Chebyshev
/// nodes of [-1, 1].
std::vector<double> fit_polynomial(const std::function<double(double)>& f, std::size_t degree) {
  const std::size_t n = degree + 1;
  std::vector<double> values(n), result(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) values[j] = f(chebyshev_node(j, n));
  // Chebyshev coefficients, summed as polynomials by the recurrence T_(k+1) = 2 t T_k - T_(k-1).
  std::vector<double> now(n, 0.0), before(n, 0.0);
  now[0] = before[1] = 1;  // T_0 and T_-1 = T_1
  for (std::size_t k = 0; k < n; ++k) {
    double c = 0;
    for (std::size_t j = 0; j < n; ++j) c += values[j] * std::cos(static_cast<double>(k) * chebyshev_angle(j, n));
    c *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
    for (std::size_t p = 0; p < n; ++p) result[p] += c * now[p];
    before.swap(now);
    for (std::size_t p = 0; p < n; ++p) now[p] = (p > 0 ? 2 * before[p - 1] : 0) - now[p];
  }
  return result;
}

double value_at(const std::vector<double>& polynomial, double t) {
  double sum = 0;
  for (std::size_t p = polynomial.size(); p-- > 0;) sum = sum * t + polynomial[p];
  return sum;
}

}  // namespace

template <typename Real>
PolynomialPieces<Real> PolynomialPieces<Real>::fit(const std::function<double(double)>& f, double start,
                                                   std::size_t pieces, double error) {
  const auto piece = [&](std::size_t l) {
    return [&f, low = start + static_cast<double>(l)](double t) { return f(low + 0.5 * (t + 1)); };
  };
  std::vector<std::vector<double>> best(pieces);
  std::size_t degree = 2;
  for (bool good = false; !good && degree < max_degree;) {
    ++degree, good = true;
    for (std::size_t l = 0; l < pieces && (good || degree == max_degree); ++l) {
      const auto exact = piece(l);
      best[l] = fit_polynomial(exact, degree);
      for (int s = 0; s <= 40 && good; ++s) {
        const double t = -1 + s / 20.0;
        good = std::abs(value_at(best[l], t) - exact(t)) <= error;
      }
    }
  }

  PolynomialPieces result;
  result.pieces = pieces;
  result.lanes = (pieces + 7) / 8 * 8;
  result.degree = degree;
  result.coefficient.assign((degree + 1) * result.lanes + 8, Real(0));
  for (std::size_t p = 0; p <= degree; ++p)
    for (std::size_t l = 0; l < pieces; ++l)
      result.coefficient[p * result.lanes + l] = static_cast<Real>(best[l][degree - p]);
  return result;
}

template struct PolynomialPieces<float>;
template struct PolynomialPieces<double>;

GriddingKernel::GriddingKernel(double tolerance) : width_(width_for(tolerance)) {
  const double per_width = width_ == 2 ? 2.20 : width_ == 3 ? 2.26 : width_ == 4 ? 2.38 : 2.30;
  beta_ = per_width * static_cast<double>(width_);
}

GriddingKernel::GriddingKernel(std::size_t width, double oversampling)
    : width_(width), beta_(0.97 * pi * static_cast<double>(width) * (1 - 0.5 / oversampling)) {}

double GriddingKernel::at(double x) const {
  const double z = 2 * x / static_cast<double>(width_);
  return std::abs(z) < 1    ? std::exp(beta_ * (std::sqrt((1 - z) * (1 + z)) - 1))
         : std::abs(z) == 1 ? std::exp(-beta_)
                            : 0;  // (E60)
}

double GriddingKernel::transform(double frequency) const {
  // The substitution x = (w/2) sin(s) removes the square root; the trapezoidal rule then converges rapidly.
  constexpr int steps = 400;
  const double half = 0.5 * static_cast<double>(width_);
  double sum = 0;
  for (int k = 0; k <= steps; ++k) {
    const double s = pi * (k / static_cast<double>(steps) - 0.5), weight = k == 0 || k == steps ? 0.5 : 1;
    sum +=
        weight * std::exp(beta_ * (std::cos(s) - 1)) * std::cos(2 * pi * frequency * half * std::sin(s)) * std::cos(s);
  }
  return sum * half * pi / steps;
}

}  // namespace insonify
