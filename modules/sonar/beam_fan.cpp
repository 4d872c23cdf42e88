// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/beam_fan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

Direction direction(const BeamFan& fan, std::size_t beam) { return {fan.azimuth[beam], fan.elevation[beam]}; }

// Returns `angle` plus the whole turns that bring it nearest to `reference`.
double near_to(double reference, double angle) { return reference + std::remainder(angle - reference, 2 * pi); }

// Returns the cone that is `margin` of u farther counter-clockwise; it ends at the array's axis.
double farther_round(double cone, double margin) {
  const double turned = std::remainder(cone, 2 * pi), u = std::sin(turned);
  const bool ahead = std::abs(turned) <= pi / 2;
  return cone +
         std::remainder(
             (ahead ? std::asin(std::min(1.0, u + margin)) : pi - std::asin(std::max(-1.0, u - margin))) - turned,
             2 * pi);
}

// Returns the cosine, exactly 0 at +-pi/2, where the rounded cosine would leave out the zenith itself.
double cos_elevation(double elevation) { return std::abs(elevation) < pi / 2 ? std::cos(elevation) : 0; }

}  // namespace

BeamFan make_fan(std::size_t beams, double field_of_view, double beam_width, double elevation_width, double elevation) {
  if (beams == 0) fail(ErrorKind::argument, "make_fan: beams = 0, must be at least 1");
  if (!(field_of_view > 0 && field_of_view <= 2 * pi) && !(beams == 1 && field_of_view == 0))
    fail(ErrorKind::argument, "make_fan: field_of_view = ", field_of_view, " rad, must be > 0 and at most 2 pi");
  BeamFan fan;
  fan.beam_width = beam_width;
  fan.elevation_width = elevation_width;
  fan.elevation.assign(beams, elevation);
  for (std::size_t b = 0; b < beams; ++b)
    fan.azimuth.push_back(field_of_view * ((static_cast<double>(b) + 0.5) / static_cast<double>(beams) - 0.5));
  require_valid(fan, "make_fan");
  return fan;
}

void require_valid(const BeamFan& fan, const char* who) {
  if (fan.beams() == 0) fail(ErrorKind::argument, who, ": fan has no beams, must have at least 1");
  if (fan.elevation.size() != fan.beams())
    fail(ErrorKind::argument, who, ": fan.elevation has ", fan.elevation.size(), " entries, must have one per beam (",
         fan.beams(), ")");
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    if (!(std::abs(fan.azimuth[b]) <= pi))
      fail(ErrorKind::argument, who, ": fan.azimuth[", b, "] = ", fan.azimuth[b], " rad, must be within +-pi");
    if (!(std::abs(fan.elevation[b]) <= pi / 2))
      fail(ErrorKind::argument, who, ": fan.elevation[", b, "] = ", fan.elevation[b], " rad, must be within +-pi/2");
  }
  if (!(fan.beam_width > 0 && std::isfinite(fan.beam_width)))
    fail(ErrorKind::argument, who, ": fan.beam_width = ", fan.beam_width, " rad, must be > 0");
  if (!(fan.elevation_width > 0 && std::isfinite(fan.elevation_width)))
    fail(ErrorKind::argument, who, ": fan.elevation_width = ", fan.elevation_width, " rad, must be > 0");
  if (!(fan.row_width >= 0 && std::isfinite(fan.row_width)))
    fail(ErrorKind::argument, who, ": fan.row_width = ", fan.row_width, " rad, must be >= 0; 0: no planar array");
}

std::vector<FanRow> fan_rows(const BeamFan& fan) {
  std::map<double, FanRow> by_elevation;
  for (std::size_t b = 0; b < fan.beams(); ++b) by_elevation[fan.elevation[b]].beams.push_back(b);
  std::vector<FanRow> rows;
  for (auto& [elevation, row] : by_elevation) rows.push_back({elevation, std::move(row.beams)});
  return rows;
}

std::size_t middle_beam(const BeamFan& fan) {
  const std::vector<FanRow> rows = fan_rows(fan);
  std::vector<std::size_t> beams = rows[rows.size() / 2].beams;
  const auto middle = beams.begin() + static_cast<std::ptrdiff_t>(beams.size() / 2);
  std::nth_element(beams.begin(), middle, beams.end(),
                   [&](std::size_t a, std::size_t b) { return fan.azimuth[a] < fan.azimuth[b]; });
  return *middle;
}

double cone_azimuth(const Vector3d& p) {
  return std::atan2(p.y(), std::copysign(std::sqrt(p.x() * p.x() + p.z() * p.z()), p.x()));
}

Direction direction_in_cone(double cone, double turn) {
  const double about = std::abs(std::cos(cone));
  return direction_of({std::cos(cone) * std::cos(turn), std::sin(cone), about * std::sin(turn)});
}

std::pair<double, double> turns_between(double cone, double min_elevation, double max_elevation) {
  const double about = std::max(std::abs(std::cos(cone)), 1e-12);
  const auto turn = [about](double elevation) { return std::asin(std::clamp(std::sin(elevation) / about, -1.0, 1.0)); };
  return {turn(min_elevation), turn(max_elevation)};
}

Sector insonified_sector(const BeamFan& fan, double elevation_half_extent, double margin) {
  require_valid(fan, "insonified_sector");
  std::vector<double> azimuth = fan.azimuth;
  std::sort(azimuth.begin(), azimuth.end());

  // The fan is the complement of the widest azimuth gap between beams, so it may extend across +-pi (a head that looks
  // astern).
  double begin = azimuth.front(), widest = azimuth.front() + 2 * pi - azimuth.back();
  for (std::size_t b = 1; b < azimuth.size(); ++b)
    if (azimuth[b] - azimuth[b - 1] > widest) {
      widest = azimuth[b] - azimuth[b - 1];
      begin = azimuth[b];
    }
  const double centre = begin + (2 * pi - widest) / 2;

  // Find the outermost cones, and extend them by the margin.
  double least = centre, most = centre;
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    const double cone =
        near_to(centre + std::remainder(fan.azimuth[b] - centre, 2 * pi), cone_azimuth(unit_vector(direction(fan, b))));
    least = b == 0 ? cone : std::min(least, cone);
    most = b == 0 ? cone : std::max(most, cone);
  }
  const double wide = margin > 0 ? margin : main_lobe_reach * fan.beam_width;
  least = -farther_round(-least, wide);
  most = farther_round(most, wide);
  if (most - least >= 2 * pi) least = centre - pi, most = centre + pi;
  const auto [low, high] = std::minmax_element(fan.elevation.begin(), fan.elevation.end());
  return {least, most, std::max(-pi / 2, *low - elevation_half_extent),
          std::min(pi / 2, *high + elevation_half_extent)};
}

std::pair<double, double> azimuths_of(const Sector& sector) {
  const double up = std::min(std::max(std::abs(sector.min_elevation), std::abs(sector.max_elevation)), pi / 2);
  // A cone leaves its azimuth away from the plane z = 0 towards +-pi/2.
  const auto outermost = [&](double edge) {
    const double turned = std::remainder(edge, 2 * pi), u = std::sin(turned);
    const double reached = std::asin(std::clamp(u / std::max(std::cos(up), 1e-12), -1.0, 1.0));
    return std::max(edge, near_to(edge, std::abs(turned) <= pi / 2 ? reached : pi - reached));
  };
  const double low = -outermost(-sector.min_azimuth), high = outermost(sector.max_azimuth);
  if (high - low < 2 * pi) return {low, high};
  return {(low + high) / 2 - pi, (low + high) / 2 + pi};
}

SectorBounds::SectorBounds(const Sector& sector)
    : whole_circle_(sector.max_azimuth - sector.min_azimuth >= 2 * pi),
      convex_(sector.max_azimuth - sector.min_azimuth <= pi),
      port_(std::sin(sector.max_azimuth), -std::cos(sector.max_azimuth)),
      starboard_(-std::sin(sector.min_azimuth), std::cos(sector.min_azimuth)),
      top_(std::sin(sector.max_elevation), cos_elevation(sector.max_elevation)),
      bottom_(std::sin(sector.min_elevation), cos_elevation(sector.min_elevation)) {}

}  // namespace insonify
