// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/elevation_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace insonify {
namespace {
/// Argument at which sinc(x) = sin(pi x) / (pi x) falls to 1/sqrt(2).
constexpr double sinc_half_power = 0.4429464715;

double sinc(double x) {
  if (std::abs(x) < 1e-8) return 1;
  return std::abs(x) < 1e15 ? std::sin(pi * x) / (pi * x) : 0;
}
}  // namespace

double gaussian_lobe(double width, double off_axis) {
  const double x = off_axis / width;
  return std::exp2(-2 * x * x);  // (E14, E57) intensity 2^(-(2x)^2): one half at x = 1/2
}

double elevation_response(ElevationShape shape, double width, double elevation_off_centre) {
  if (shape == ElevationShape::gaussian) return gaussian_lobe(width, elevation_off_centre);
  if (shape == ElevationShape::sector) return std::abs(elevation_off_centre) <= width / 2 ? 1 : 0;
  return sinc(sinc_half_power * std::sin(elevation_off_centre) / std::sin(std::min(width / 2, pi / 2)));  // (E14)
}

double elevation_half_extent(ElevationShape shape, double width, double floor_db) {
  if (shape == ElevationShape::sector) return std::min(width / 2, pi / 2);
  if (shape == ElevationShape::line) return pi / 2;
  // Solve -10 log10(2) (2x)^2 = floor.
  return std::min(0.5 * width * std::sqrt(-floor_db / (10 * std::log10(2.0))), pi / 2);
}

}  // namespace insonify
