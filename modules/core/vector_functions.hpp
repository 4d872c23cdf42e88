// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bit>
#include <cstdint>

/// Elementary functions of one double without branches, calls or tables, so that loops over them are vectorised. All
/// instruction sets give the same bits if products and sums are not contracted. They do not depend on Eigen or libm.
namespace insonify::vec {

#define INSONIFY_ALWAYS_INLINE [[gnu::always_inline]] inline

constexpr double round_magic = 0x1.8p52;

/// Returns the nearest whole number, for |x| < 2^51.
INSONIFY_ALWAYS_INLINE double nearest(double x) { return (x + round_magic) - round_magic; }
/// Returns the largest whole number that is not above x, for |x| < 2^51.
INSONIFY_ALWAYS_INLINE double floor(double x) {
  const double n = nearest(x);
  return n > x ? n - 1 : n;
}
/// Returns the smallest whole number that is not below x, for |x| < 2^51.
INSONIFY_ALWAYS_INLINE double ceil(double x) {
  const double n = nearest(x);
  return n < x ? n + 1 : n;
}

/// Returns sine and cosine of an angle in cycles, |cycles| < 2^51; accurate to 2e-16.
INSONIFY_ALWAYS_INLINE void sine_cosine(double cycles, double& sine, double& cosine) {
  const double share = cycles - nearest(cycles), quarter = nearest(4 * share);  // quarter: -2 .. 2
  const double x = 6.283185307179586477 * (share - 0.25 * quarter), q = x * x;
  const double s = x + x * q *
                           (-1.66666666666666324348e-01 +
                            q * (8.33333333332248946124e-03 +
                                 q * (-1.98412698298579493134e-04 +
                                      q * (2.75573137070700676789e-06 +
                                           q * (-2.50507602534068634195e-08 + q * 1.58969099521155010221e-10)))));
  const double c = 1 - 0.5 * q +
                   q * q *
                       (4.16666666666666019037e-02 +
                        q * (-1.38888888888741095749e-03 +
                             q * (2.48015872894767294178e-05 +
                                  q * (-2.75573143513906633035e-07 +
                                       q * (2.08757232129817482790e-09 + q * -1.13596475577881948265e-11)))));
  const bool odd = quarter * quarter == 1;
  const double a = odd ? c : s, b = odd ? s : c;
  // Quarters 0: s, c; 1: c, -s; +-2: -s, -c; -1: -c, s.
  sine = quarter * quarter == 4 || quarter == -1 ? -a : a;
  cosine = quarter * quarter == 4 || quarter == 1 ? -b : b;
}

/// Returns the exponential of x, limited to [-708, 709]. Accurate to 4e-16 of the result.
INSONIFY_ALWAYS_INLINE double exp(double x) {
  x = x < -708 ? -708 : x;
  x = x > 709 ? 709 : x;
  const double shifted = x * 1.44269504088896340736 + round_magic, n = shifted - round_magic;
  const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  double p = 1.0 / 6227020800;
  p = p * r + 1.0 / 479001600;
  p = p * r + 1.0 / 39916800;
  p = p * r + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1;
  p = p * r + 1;
  return p * std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
}

/// Returns the natural logarithm of a normal number above 0; accurate to 4e-16 of the result, or of 1 near 1.
INSONIFY_ALWAYS_INLINE double log(double x) {
  // x = 2^e m with m within sqrt(1/2) and sqrt(2).
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (0x3ff0000000000000 - 0x3fe6a09e667f3bcd);
  const double e = std::bit_cast<double>((bits >> 52) | 0x4330000000000000) - (0x1p52 + 1023);
  const double m = std::bit_cast<double>((bits & 0x000fffffffffffff) + 0x3fe6a09e667f3bcd);
  const double f = m - 1, s = f / (2 + f), z = s * s;
  const double r = z * (6.666666666666735130e-01 +
                        z * (3.999999999940941908e-01 +
                             z * (2.857142874366239149e-01 +
                                  z * (2.222219843214978396e-01 +
                                       z * (1.818357216161805012e-01 +
                                            z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const double half = 0.5 * f * f;
  return e * 6.93147180369123816490e-01 - ((half - (s * (half + r) + e * 1.90821492927058770002e-10)) - f);
}

/// Returns the arcus tangent for |t| <= 1/16, accurate to 2e-16: Taylor series up to t^13.
INSONIFY_ALWAYS_INLINE double atan_of_small(double t) {
  const double q = t * t;
  return t + t * q * (-1.0 / 3 + q * (1.0 / 5 + q * (-1.0 / 7 + q * (1.0 / 9 + q * (-1.0 / 11 + q * (1.0 / 13))))));
}

}  // namespace insonify::vec
