// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/shading.hpp"

#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "sonar/line_array.hpp"

namespace insonify {
namespace {

/// Returns the Fourier coefficient m of the Taylor distribution over the aperture (E11; Taylor 1955, eq. for F_m).
double taylor_coefficient(int m, int nbar, double a2, double sigma2) {
  double up = 1, down = 1;
  for (int n = 1; n < nbar; ++n) {
    up *= 1 - m * m / (sigma2 * (a2 + (n - 0.5) * (n - 0.5)));
    if (n != m) down *= 1 - static_cast<double>(m * m) / (n * n);
  }
  return (m % 2 == 1 ? 0.5 : -0.5) * up / down;
}

/// Returns the Chebyshev polynomial of degree n at x, also outside of [-1, 1].
double chebyshev_polynomial(std::size_t n, double x) {
  const auto degree = static_cast<double>(n);
  if (std::abs(x) <= 1) return std::cos(degree * std::acos(x));
  return (x < 0 && n % 2 == 1 ? -1 : 1) * std::cosh(degree * std::acosh(std::abs(x)));
}

void require_elements(std::size_t elements, const char* who) {
  if (elements < 1) fail(ErrorKind::argument, who, ": elements = 0, must be at least 1");
}

void require_side_lobe(double side_lobe_db, const char* who) {
  require(side_lobe_db >= -80 && side_lobe_db < -13.3, who, "side_lobe_db", side_lobe_db, "dB", "within -80 and -13.3");
}

std::vector<double> scaled_to_sum(std::vector<double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double scale = static_cast<double>(weights.size()) / sum;
  for (double& w : weights) w *= scale;
  return weights;
}

}  // namespace

const char* shading_name(Shading shading) {
  constexpr const char* names[] = {"uniform", "taylor", "hamming", "chebyshev"};
  return names[static_cast<int>(shading)];
}

std::vector<double> shading_weights(Shading shading, std::size_t elements, double side_lobe_db) {
  if (shading == Shading::uniform) return uniform_shading(elements);
  if (shading == Shading::hamming) return hamming_shading(elements);
  return shading == Shading::taylor ? taylor_shading(elements, side_lobe_db)
                                    : chebyshev_shading(elements, side_lobe_db);
}

std::vector<double> uniform_shading(std::size_t elements) { return std::vector<double>(elements, 1.0); }

std::vector<double> taylor_shading(std::size_t elements, double side_lobe_db, int nbar) {
  require_elements(elements, "taylor_shading");
  require_side_lobe(side_lobe_db, "taylor_shading");
  if (nbar < 2) fail(ErrorKind::argument, "taylor_shading: nbar = ", nbar, ", must be at least 2");

  const double a = std::acosh(amplitude_from_db(-side_lobe_db)) / pi;
  const double sigma2 = nbar * nbar / (a * a + (nbar - 0.5) * (nbar - 0.5));
  std::vector<double> weights(elements, 1.0);
  for (std::size_t e = 0; e < elements; ++e) {
    const double x = element_position(e, elements) / static_cast<double>(elements);
    for (int m = 1; m < nbar; ++m)
      weights[e] += 2 * taylor_coefficient(m, nbar, a * a, sigma2) * std::cos(2 * pi * m * x);  // (E11)
  }
  return scaled_to_sum(weights);
}

std::vector<double> hamming_shading(std::size_t elements) {
  require_elements(elements, "hamming_shading");
  std::vector<double> weights(elements);
  for (std::size_t e = 0; e < elements; ++e)
    weights[e] =
        0.54 + 0.46 * std::cos(2 * pi * element_position(e, elements) / static_cast<double>(elements));  // (E31)
  return scaled_to_sum(weights);
}

std::vector<double> chebyshev_shading(std::size_t n, double side_lobe_db) {
  require_elements(n, "chebyshev_shading");
  require_side_lobe(side_lobe_db, "chebyshev_shading");
  if (n == 1) return {1.0};

  // The pattern is T(x0 cos(psi / 2)) with psi the phase between elements. n samples at psi = 2 pi k / n determine it.
  // Sample n - k equals sample k, and sample n / 2 is zero.
  const std::size_t half = (n - 1) / 2;
  const double x0 = std::cosh(std::acosh(amplitude_from_db(-side_lobe_db)) / static_cast<double>(n - 1));
  std::vector<double> pattern(half + 1);
  for (std::size_t k = 0; k <= half; ++k)
    pattern[k] = chebyshev_polynomial(n - 1, x0 * std::cos(pi * static_cast<double>(k) / static_cast<double>(n)));

  // Transform the pattern to the elements. All phases are multiples of pi / n: one period of cosines serves every term.
  std::vector<double> cosine(2 * n);
  for (std::size_t j = 0; j < 2 * n; ++j) cosine[j] = std::cos(pi * static_cast<double>(j) / static_cast<double>(n));
  std::vector<double> weights(n, pattern[0]);
  for (std::size_t e = 0; e < n; ++e) {
    const std::size_t twice_place = 2 * e + 1 > n ? 2 * e + 1 - n : n - 2 * e - 1;
    for (std::size_t k = 1; k <= half; ++k) weights[e] += 2 * pattern[k] * cosine[k * twice_place % (2 * n)];  // (E32)
  }
  return scaled_to_sum(weights);
}

}  // namespace insonify
