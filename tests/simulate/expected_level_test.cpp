// SPDX-License-Identifier: BSD-3-Clause
// Tests expected levels without speckle, their error with finitely many points, and holes of the scan.
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::expected_level_tests {

const SonarHead head = small_head({.beams = 12,
                                   .field_of_view_deg = 24,
                                   .elevation_width_deg = 30,
                                   .min_range = 3,
                                   .max_range = 8,
                                   .source_level_db = 200});

/// Returns water that scatters, between surface and bottom.
Environment loud_sea() {
  Environment e;
  e.surface = SeaSurface{3, 1e-4, -35};
  e.bottom = FlatBottom{-3};
  e.bottom->lambert_mu = 1e-4;
  e.volume_scattering_db = -50;
  e.self_noise_db = 55;
  return e;
}

const SceneCloud& plane() {
  static const SceneCloud scene = make_built_in_scene("plane", {.points = 12000, .size = {14, 10}});
  return scene;
}

const Pose above = pose_from_yaw_pitch_roll({-4, 0, 2.5}, 0, radians(25), 0);

SimulatedPing ping_levels(const SimulationOptions& options, const Environment& environment = {},
                          std::int64_t number = 0) {
  return simulate_event(plane(), head, {.world_from_head = above, .number = number}, environment, options);
}

Grid<double> power(const ComplexGridF& pressure) { return pressure.cast<std::complex<double>>().abs2(); }

TEST(ExpectedLevel, is_the_mean_power_of_many_pings_with_speckle) {
  SimulationOptions options{.sampling = {.scatterers_per_cell = 4},
                            .synthesis = {.method = SynthesisMethod::incoherent},
                            .effects = {.multipath = Choice::never, .noise = true},
                            .outputs = {.layers = true}};
  const SimulatedPing expected = ping_levels(options, loud_sea());
  EXPECT_TRUE(expected.ping.expected_level);
  EXPECT_TRUE((expected.ping.pressure.imag() == 0).all());

  // Amplitudes by the seed; it also moves the parts of surfels, so means over many cells are compared.
  options.synthesis.method = SynthesisMethod::gridded;
  std::map<std::string, double> mean;
  constexpr int pings = 30;
  for (std::uint64_t seed = 1; seed <= pings; ++seed) {
    options.seed = seed;
    const SimulatedPing p = ping_levels(options, loud_sea(), static_cast<std::int64_t>(seed));
    EXPECT_FALSE(p.ping.expected_level);
    for (const Layer& layer : p.ping.layers) mean[layer.name] += power(layer.pressure).sum() / pings;
  }
  ASSERT_EQ(expected.ping.layers.size(), 5u);
  for (const Layer& layer : expected.ping.layers)
    EXPECT_NEAR(db_from_power(power(layer.pressure).sum() / mean[layer.name]), 0, 0.25) << layer.name;
}

TEST(ExpectedLevel, adds_layers_by_their_squares) {
  const SimulatedPing p = ping_levels({.sampling = {.scatterers_per_cell = 2},
                                       .synthesis = {.method = SynthesisMethod::incoherent},
                                       .effects = {.multipath = Choice::always, .noise = true},
                                       .outputs = {.layers = true}},
                                      loud_sea());
  ASSERT_EQ(p.ping.layers.size(), 6u);
  Grid<double> sum = Grid<double>::Zero(p.ping.pressure.rows(), p.ping.pressure.cols());
  for (const Layer& layer : p.ping.layers) sum += power(layer.pressure);
  EXPECT_LT(((power(p.ping.pressure) - sum).abs() / sum).maxCoeff(), 1e-5);
}

TEST(ExpectedLevel, does_not_depend_on_the_amplitude_law_nor_on_threads) {
  SimulationOptions options{.sampling = {.scatterers_per_cell = 2},
                            .synthesis = {.method = SynthesisMethod::incoherent}};
  const SimulatedPing one = ping_levels(options);
  options.amplitude = SurfaceAmplitude::random_phase;
  options.threads = 3;
  EXPECT_TRUE((ping_levels(options).ping.pressure == one.ping.pressure).all());
}

TEST(HoleMask, of_a_ping_marks_what_the_scan_left_out) {
  SceneCloud scene;
  const SceneCloud whole = make_built_in_scene("plane", {.points = 60000, .size = {14, 10}});
  const double gap = 4.5 * std::sqrt(14.0 * 10 / 60000);
  scene.materials = whole.materials;
  constexpr double middle = 0.8;  // fraction of the hole, on the axis of the fan
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (std::hypot(whole.point[i].x() - middle, whole.point[i].y()) > gap)
      add_surfel(scene, whole.point[i].cast<double>(), whole.normal[i].cast<double>(), whole.area[i]);
  SimulationOptions options{.sampling = {.scatterers_per_cell = 0, .rays_per_beam = 512}, .outputs = {.mask = true}};
  const auto ping_of = [&](const SceneCloud& s) { return simulate_ping(s, head, above, {}, options); };
  const SimulatedPing clean = ping_of(whole), pierced = ping_of(scene);
  ASSERT_EQ(pierced.ping.unknown.size(), pierced.ping.pressure.size());
  EXPECT_EQ(clean.report.holes.directions, 12u * 512u);
  EXPECT_EQ(clean.report.holes.unknown, 0u);
  EXPECT_EQ(clean.ping.unknown.cast<int>().sum(), 0);
  EXPECT_GT(pierced.report.holes.unknown, 0u);
  const double range = std::hypot(4 + middle, 2.5);
  for (Eigen::Index b = 0; b < pierced.ping.unknown.rows(); ++b)
    for (Eigen::Index n = 0; n < pierced.ping.unknown.cols(); ++n)
      if (pierced.ping.unknown(b, n)) {
        EXPECT_LT(std::abs(pierced.ping.gate.centre(static_cast<std::size_t>(n)) - range), 3 * gap);
        EXPECT_LT(std::abs(pierced.ping.fan.azimuth[static_cast<std::size_t>(b)]), radians(1) + gap / range);
      }
  options.outputs.mask = false;
  EXPECT_EQ(ping_of(scene).ping.unknown.size(), 0);
}

}  // namespace insonify::expected_level_tests
