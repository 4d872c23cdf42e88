// SPDX-License-Identifier: BSD-3-Clause
// Compares mean levels with closed forms. Random amplitudes make single levels scatter; every tolerance states how
// much.
#include "acoustics/direct_echoes.hpp"
#include "acoustics/surface_scattering.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "sonar/shading.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/test.hpp"

namespace {

/// Returns a head with a negligible elevation pattern (a sector over the whole half space) and a uniform array.
SonarHead bottom_sonar(double min_range, double max_range) {
  SonarSpec s;
  s.name = "bottom";
  s.centre_frequency = 900e3, s.bandwidth = 29.5e3;
  s.source_level_db = 220;
  s.beams = 41, s.field_of_view = radians(40);
  s.beam_width = radians(1), s.elevation_width = radians(170);
  s.elevation_shape = ElevationShape::sector;
  s.side_lobe_db = 0;
  s.min_range = min_range, s.max_range = max_range;
  return make_head(s, sound_speed({}));
}

/// Returns the level of a flat Lambert bottom at height h (one-way line pattern, Gaussian pulse, tau_e = 0.469719 / B):
/// RL = SL - 40 log r - 2 a r + 10 log mu + 20 log(h / r) + 10 log[(lambda / L) r^2 / sqrt(r^2 - h^2) c tau_e / 2]
/// ahead. The cone of a beam at u crosses a ring of range at a slant: cos psi = sqrt(1 - u^2 r^2 / (r^2 - h^2)).
double bottom_level_db(const SonarHead& head, double r, double h, double mu, double u) {
  const double c = sound_speed({}), wavelength = c / head.pulse.centre_frequency;
  const double length = head.array.spacing * static_cast<double>(head.array.elements());
  const double cell =
      wavelength / length * r * r / std::sqrt(r * r * (1 - u * u) - h * h) * 0.5 * c * 0.469719 / head.pulse.bandwidth;
  return head.pulse.source_level_db - 40 * std::log10(r) -
         2 * absorption_db_per_m({}, head.pulse.centre_frequency) * r + db_from_power(mu) + 20 * std::log10(h / r) +
         db_from_power(cell);
}

SimulatedPing ping_plane(const SonarHead& head, double h, std::size_t points, const SimulationOptions& options) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = points, .size = {14, 16}});
  return simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, 0, h}, 0, 0, 0), {}, options);
}

/// Returns the mean level less the closed form over a strip of range around r [dB], all beams.
double bottom_excess_db(const SimulatedPing& p, const SonarHead& head, double r, double h) {
  double excess = 0, samples = 0;
  for (std::size_t b = 0; b < head.fan.beams(); ++b) {
    for (std::size_t n = 0; n < head.gate.bins(); ++n) {
      const double range = head.gate.centre(n);
      if (std::abs(range - r) > 0.25) continue;
      const double level =
          pressure_level_db(std::abs(std::complex<double>(p.ping.pressure(static_cast<int>(b), static_cast<int>(n)))));
      excess +=
          power_from_db(level - bottom_level_db(head, range, h, power_from_db(-27), std::sin(head.fan.azimuth[b])));
      ++samples;
    }
  }
  return db_from_power(excess / samples);
}

}  // namespace

// A strip of 0.5 m holds 41 beams x 0.5 m / 1.1 cm = 1900 cells: one standard deviation is 0.1 dB.
TEST(LevelLaws, flat_lambert_bottom_has_the_closed_form_level) {
  const SonarHead head = bottom_sonar(4, 11);
  const SimulatedPing p = ping_plane(head, 3, 300000, {});
  for (const double r : {5.0, 7.0, 10.0}) EXPECT_NEAR(bottom_excess_db(p, head, r, 3), 0, 0.4) << r << " m";
}

TEST(LevelLaws, level_does_not_depend_on_cloud_density_or_splitting) {
  const SonarHead head = bottom_sonar(4, 8);
  for (const std::size_t points : {50000, 100000, 400000})
    EXPECT_NEAR(bottom_excess_db(ping_plane(head, 3, points, {}), head, 6, 3), 0, 0.4) << points << " points";
  for (const double per_cell : {3.0, 30.0})
    EXPECT_NEAR(
        bottom_excess_db(ping_plane(head, 3, 100000, {.sampling = {.scatterers_per_cell = per_cell}}), head, 6, 3), 0,
        0.4)
        << per_cell;
}

TEST(LevelLaws, level_does_not_depend_on_the_number_of_rays) {
  const SonarHead head = bottom_sonar(4, 8);
  for (const int rays : {2000, 4000}) {
    const SimulatedPing p =
        ping_plane(head, 3, 200000, {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = rays}});
    EXPECT_NEAR(bottom_excess_db(p, head, 6, 3), 0, 0.5) << rays << " rays per beam";
  }
}

// Spreading, absorption and Lambert's law stand in the closed form above; what it cannot tell apart is changed here.
// The elevation pattern falls steeply over the strip of ranges: 1 dB.
TEST(LevelLaws, source_level_and_elevation_pattern_move_the_level) {
  SonarHead head = bottom_sonar(4, 8);
  const SimulatedPing p = ping_plane(head, 3, 100000, {});
  head.pulse.source_level_db += 7;
  EXPECT_NEAR(mean_level_db(ping_plane(head, 3, 100000, {}).ping, 5, 7) - mean_level_db(p.ping, 5, 7), 7, 1e-4);
  head = bottom_sonar(4, 8);
  head.fan.elevation_width = radians(20);  // gaussian, axis level: the bottom at 6 m is 30 degrees below
  head.elevation_shape = ElevationShape::gaussian;
  EXPECT_NEAR(bottom_excess_db(ping_plane(head, 3, 100000, {}), head, 6, 3), -10 * std::log10(2.0) * 9, 1);
}
