// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/line_array.hpp"

#include <cmath>
#include <numeric>

#include "core/bisect.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

void require_valid(const LineArray& array, const char* who) {
  if (array.shading.empty()) fail(ErrorKind::argument, who, ": array has no elements, must have at least one");
  if (!std::isfinite(array.spacing) || array.spacing <= 0)
    fail(ErrorKind::argument, who, ": array.spacing = ", array.spacing, " m, must be > 0");
  const double sum = std::accumulate(array.shading.begin(), array.shading.end(), 0.0);
  const auto n = static_cast<double>(array.elements());
  if (!(std::abs(sum - n) <= 1e-9 * n))
    fail(ErrorKind::argument, who, ": array.shading adds up to ", sum, ", must add up to the ", n, " elements");
}

std::complex<double> array_response(const LineArray& array, double wavelength, double u, double u_beam) {
  const std::size_t n = array.elements();
  const double step = 2 * pi * array.spacing / wavelength * (u - u_beam);
  double sum = 0;
  for (std::size_t m = 0; m < n; ++m) sum += array.shading[m] * std::cos(step * element_position(m, n));
  // The odd parts of opposite elements cancel to the last bit if the shading is symmetric.
  double odd = 0;
  for (std::size_t m = 0; 2 * m + 1 < n; ++m)
    if (const double w = array.shading[n - 1 - m] - array.shading[m]; w != 0)
      odd += w * std::sin(step * element_position(m, n));
  return {sum / static_cast<double>(n), odd / static_cast<double>(n)};  // (E10)
}

double half_power_offset(const LineArray& array, double wavelength, double most) {
  require_valid(array, "half_power_offset");
  const auto power = [&](double u) { return std::norm(array_response(array, wavelength, u, 0)); };
  if (array.elements() == 1) return most;
  // Steps are much finer than the main lobe.
  return half_power_point(power, 0.02 * wavelength / (array.spacing * static_cast<double>(array.elements())), most);
}

double array_beam_width(const LineArray& array, double wavelength) {
  require_valid(array, "array_beam_width");
  return 2 * std::asin(half_power_offset(array, wavelength, 1));
}

double directivity_index_db(const LineArray& array, double wavelength, double u_beam) {
  require_valid(array, "directivity_index_db");
  // Integrate B^2 du over [-1, 1]: pairs of elements whose phase difference at endfire is x contribute 2 cos(x u_beam)
  // sin(x) / x.
  const std::vector<double> pairs = lag_sums(array);
  double integral = 0;
  for (std::size_t lag = 0; lag < pairs.size(); ++lag) {
    const double x = 2 * pi * array.spacing / wavelength * static_cast<double>(lag);
    integral += lag == 0 ? 2 * pairs[0] : 2 * pairs[lag] * 2 * std::cos(x * u_beam) * std::sin(x) / x;
  }
  integral /= static_cast<double>(pairs.size()) * static_cast<double>(pairs.size());
  return db_from_power(2 / integral);  // (E34)
}

std::vector<double> lag_sums(const LineArray& array) {
  const std::size_t n = array.elements();
  std::vector<double> sums(n, 0);
  for (std::size_t lag = 0; lag < n; ++lag)
    for (std::size_t m = 0; m + lag < n; ++m) sums[lag] += array.shading[m] * array.shading[m + lag];
  return sums;
}

std::vector<double> lag_products(const LineArray& array) {
  std::vector<double> products = lag_sums(array);
  const auto n = static_cast<double>(products.size());
  for (std::size_t lag = 0; lag < products.size(); ++lag) products[lag] *= (lag == 0 ? 1 : 2) / (n * n);
  return products;
}

}  // namespace insonify
