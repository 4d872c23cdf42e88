// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/direct_echoes.hpp"
#include "sonar/sonar_head.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Returns water without absorption at 1500 m/s.
inline Medium clear_water() { return {c0, {}}; }

/// Returns one head-on beam of one element over a gate whose bin centres fall on every multiple of 2 mm.
inline SonarHead single_beam(const Pulse& pulse, double min_range, double max_range) {
  SonarHead head;
  head.name = "single";
  head.pulse = pulse;
  head.fan = make_fan(1, 1, 1, 1);
  head.array = {0.5 * c0 / pulse.centre_frequency, {1.0}};
  head.gate = {min_range - 0.001, max_range + 0.001, 0.002};
  return head;
}

inline Scatterers targets_at(const std::vector<double>& range, double azimuth = 0, double elevation = 0) {
  Scatterers s;
  s.range = range;
  s.azimuth.assign(range.size(), azimuth);
  s.elevation.assign(range.size(), elevation);
  return s;
}

/// Returns scatterers at places in the axes of the head, each seen head on with this area [m^2].
inline Scatterers scatterers_at(const std::vector<Eigen::Vector3d>& positions, float area = 1) {
  Scatterers s;
  for (const Eigen::Vector3d& position : positions) {
    const Direction d = direction_of(position);
    s.range.push_back(position.norm()), s.azimuth.push_back(d.azimuth), s.elevation.push_back(d.elevation);
    s.id.push_back(s.id.size());
  }
  s.cos_incidence.assign(positions.size(), 1), s.projected_area.assign(positions.size(), area);
  s.material.assign(positions.size(), 0), s.surfel.assign(positions.size(), 0);
  return s;
}

/// Returns echoes of targets of cross-section sigma [m^2] and amplitude 1.
inline Echoes echoes_of(const Scatterers& targets, const Pulse& pulse, const Medium& medium, double sigma = 1) {
  const std::vector<double> sigmas(targets.size(), sigma);
  const std::vector<std::complex<double>> xi(targets.size(), 1);
  return target_echoes(targets, sigmas, xi, pulse, medium);
}

}  // namespace insonify
