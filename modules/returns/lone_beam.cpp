// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "returns/lone_beam_internal.hpp"

namespace insonify {
namespace {

constexpr double width_of_gaussian = 2.354820045;  // full width at half maximum, in standard deviations
constexpr double steepest_lone = 1.3;              // largest angle of a beam from the vertical, on a level bed [rad]
constexpr double steep_bed = 0.4363;               // largest angle off the normal of a whole echo's search [rad]
constexpr double reach_of_echo = 4;                // reach of a centre of gravity, in standard deviations
constexpr double cell_in_deviations = 3.545;       // 2 sqrt(pi): effective spacing of independent samples
constexpr int most_passes = 20;

/// Moments of an echo about a position: energy, mean [m], variance [m^2], and the sums for its errors.
struct LoneEcho {
  double energy = 0, mean = 0, variance = 0;
  double squares = 0;    ///< sum of x^2 over the bins, about the mean [m^2]
  double own_error = 0;  ///< sum of (intensity x)^2 over energy^2 [m^2]
};

LoneEcho lone_echo(const BottomBeam& beam, double centre, double reach) {
  const double last = static_cast<double>(beam.intensity.size());
  const auto begin =
      static_cast<std::size_t>(std::clamp(std::ceil((centre - reach - beam.first) / beam.step), 0.0, last));
  const auto end =
      static_cast<std::size_t>(std::clamp(std::floor((centre + reach - beam.first) / beam.step) + 1, 0.0, last));
  LoneEcho echo;
  double first = 0, second = 0;
  for (std::size_t n = begin; n < end; ++n) {
    const double x = beam.range(n) - centre, here = beam.compensated(n);
    echo.energy += here, first += here * x, second += here * x * x;
  }
  if (!(echo.energy > 0)) return echo;
  const double mean = first / echo.energy;
  echo.mean = centre + mean;
  echo.variance = std::max(0.0, second / echo.energy - mean * mean);
  for (std::size_t n = begin; n < end; ++n) {
    const double x = beam.range(n) - echo.mean, share = beam.compensated(n) / echo.energy;
    echo.squares += x * x, echo.own_error += share * share * x * x;
  }
  return echo;
}

/// Returns the intensity of noise at a range, compensated like echoes.
double compensated_noise(const BottomBeam& beam, double range) {
  const auto n = static_cast<std::size_t>(
      std::clamp(std::round((range - beam.first) / beam.step), 0.0, static_cast<double>(beam.intensity.size() - 1)));
  return beam.noise * beam.gain[n];
}

/// Returns the variance of an echo's mean due to speckle.
double variance_by_speckle(const BottomBeam& beam, const LonePlane& plane, const LoneEcho& echo) {  // (E171)
  const double extent = std::max(echo.variance - plane.pulse, plane.curvature + plane.slope);
  const double shape = 1 + (pi - 1) * std::min(1.0, plane.curvature / extent);
  const double by_width = 0.5 * extent / std::sqrt(1 + extent / (shape * plane.pulse));
  const double excess = std::max(0.0, echo.variance - plane.pulse) / std::max(echo.variance, plane.pulse);
  return std::max(by_width, excess * 0.5 * cell_in_deviations * std::sqrt(plane.pulse) / beam.step * echo.own_error);
}

}  // namespace

LonePlane plane_of_lone_beam(const Ping& ping, double range, double pulse_deviation) {  // (E170)
  const double across = ping.fan.beam_width / width_of_gaussian, along = ping.fan.elevation_width / width_of_gaussian;
  const Eigen::Matrix3d turn = ping.world_from_head.linear();
  const double azimuth = ping.fan.azimuth[0], elevation = ping.fan.elevation[0];
  const Eigen::Vector3d axis = turn * unit_vector({azimuth, elevation});
  const Eigen::Vector3d to_port = turn * Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
  const Eigen::Vector3d up = axis.cross(to_port);
  const double down = std::max(std::abs(axis.z()), std::cos(steepest_lone));
  const auto of_slope = [&](const Eigen::Vector3d& side, double width) {
    return std::pow(range * side.z() / down * width, 2);
  };
  LonePlane plane{.pulse = pulse_deviation * pulse_deviation, .range = range};
  plane.curvature = 0.5 * range * range * (std::pow(across, 4) + std::pow(along, 4));
  plane.slope = of_slope(to_port, across) + of_slope(up, along);
  plane.steep = std::pow(range * std::tan(steep_bed) * std::max(across, along), 2);
  const double angles = across * across + along * along;
  plane.across = 0.5 * range * angles * (1 + 4 * angles / 3);
  return plane;
}

BottomEstimate range_of_lone_beam(const BottomBeam& beam, const LonePlane& plane, double start) {
  const double least = std::sqrt(plane.pulse + plane.curvature + plane.slope);
  double width = std::sqrt(plane.pulse + plane.curvature + plane.slope + plane.steep), centre = start;
  LoneEcho echo;
  for (int pass = 0; pass < most_passes; ++pass) {  // shrink a wide window
    echo = lone_echo(beam, centre, std::max(reach_of_echo * width, 1.01 * beam.step));
    if (!(echo.energy > 0) || !std::isfinite(echo.mean)) return {start, std::numeric_limits<double>::infinity()};
    const double moved = std::abs(echo.mean - centre), before = width;
    centre = echo.mean;
    width = std::max(least, std::min(width, std::sqrt(echo.variance)));
    if (moved < 1e-3 * beam.step && before - width < 1e-3 * beam.step) break;
  }
  const double tilted = std::max(plane.slope, echo.variance - plane.pulse - plane.curvature);
  const double noise = compensated_noise(beam, centre) / echo.energy;
  const double cells = std::max(1.0, cell_in_deviations * std::sqrt(plane.pulse) / beam.step);
  const double by_noise = cells * noise * (noise * echo.squares + 2 * std::max(echo.variance, plane.pulse));  // (E94)
  return {centre - plane.across - 2 * tilted / plane.range,
          std::sqrt(variance_by_speckle(beam, plane, echo) + by_noise)};
}

}  // namespace insonify
