// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace insonify {

/// A function of compact support as piecewise polynomials on intervals of unit length, evaluated for all intervals at
/// once, one per lane: lane l is f(start + l + z) for z in [0, 1).
template <typename Real>
struct PolynomialPieces {
  std::size_t pieces = 0, lanes = 0, degree = 0;
  std::vector<Real> coefficient;  ///< (degree + 1) x lanes plus 8 of padding, highest power first, in t = 2 z - 1

  /// Fits polynomials of the lowest degree with an error below `error`; `lanes` is `pieces` rounded up to a multiple of
  /// 8, and the excess lanes are zero.
  static PolynomialPieces fit(const std::function<double(double)>& f, double start, std::size_t pieces, double error);
};

/// The "exponential of semicircle" kernel of Barnett, Magland and af Klinteberg (2019) for non-uniform FFTs with an
/// oversampling factor of 2 (E60): phi(x) = exp(beta (sqrt(1 - (2x/w)^2) - 1)), x in grid steps, |x| <= w/2.
class GriddingKernel {
 public:
  /// Chooses the narrowest kernel with an error below `tolerance`; at most 16 grid steps wide, accurate to 1e-14.
  explicit GriddingKernel(double tolerance);
  /// The kernel of this width for a grid `oversampling` (above 1) times as fine as needed.
  GriddingKernel(std::size_t width, double oversampling);

  std::size_t width() const { return width_; }
  double at(double x) const;
  /// Returns the Fourier transform at `frequency` [cycles per grid step], |frequency| <= 1 / (2 oversampling): integral
  /// of phi(x) cos(2 pi f x).
  double transform(double frequency) const;
  /// Returns the kernel of a point that lies between grid steps: lane l is the l-th step within reach.
  template <typename Real>
  PolynomialPieces<Real> pieces(double error) const {
    return PolynomialPieces<Real>::fit([this](double x) { return at(x); }, -0.5 * static_cast<double>(width_), width_,
                                       error);
  }

 private:
  std::size_t width_;
  double beta_;
};

}  // namespace insonify
