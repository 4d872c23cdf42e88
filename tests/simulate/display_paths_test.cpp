// SPDX-License-Identifier: BSD-3-Clause
// Compares display cells of echoes by way of other surfaces (E190), and their layers, with means of samples.
#include "core/random.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/surface_rays.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::display_path_tests {

constexpr int cells = 24;

/// A head that looks along a bed at z = 0 from x = -5, in an environment.
struct Position {
  SceneCloud scene = make_built_in_scene("plane", {.points = 40000, .size = {20, 24}});
  SonarHead head = small_head({.beams = 24,
                               .field_of_view_deg = 60,
                               .beam_width_deg = 3,
                               .elevation_width_deg = 40,
                               .min_range = 4,
                               .max_range = 14});
  Environment environment{};
  SimulationOptions options{};
  Pose pose = pose_from_yaw_pitch_roll({-5, 0, 3}, 0.1, 0.3, 0);

  Position() { options.outputs.display_bins = cells, options.outputs.layers = true; }
  SimulatedPing ping(bool phases, std::uint64_t seed = 1) const {
    SimulationOptions o = options;
    o.seed = seed, o.synthesis.phases = phases;
    return simulate_event(scene, head, {.world_from_head = pose}, environment, o);
  }
  /// Returns the mean intensity of a layer over `seeds`.
  Grid<double> layer(const std::string& name, bool phases, int seeds) const {
    Grid<double> mean = Grid<double>::Zero(24, cells);
    for (int seed = 1; seed <= seeds; ++seed) {
      const SimulatedPing made = ping(phases, static_cast<std::uint64_t>(seed));
      EXPECT_EQ(made.report.options.synthesis.phases, phases);
      for (const Layer& layer : made.ping.layers)
        if (layer.name == name) mean += layer.pressure.cast<std::complex<double>>().abs2() / seeds;
    }
    return mean;
  }
};

/// Returns a free surface a metre above the head: paths by it are nearly as loud as direct ones.
Position below_a_surface() {
  Position position;
  position.environment.surface = SeaSurface{4, 1e-4};
  position.options.effects.multipath = Choice::always;
  return position;
}

void expect_same_levels(const Position& position, const std::string& name, int seeds, double total_db, double band_db) {
  const Grid<double> drawn = position.layer(name, false, seeds), samples = position.layer(name, true, seeds);
  ASSERT_GT(samples.sum(), 0);
  EXPECT_NEAR(db_from_power(drawn.sum() / samples.sum()), 0, total_db);
  for (int band = 0; band + 4 <= cells; band += 4) {
    const double energy = samples.middleCols(band, 4).sum();
    if (energy < 0.02 * samples.sum()) continue;
    EXPECT_NEAR(db_from_power(drawn.middleCols(band, 4).sum() / energy), 0, band_db) << band;
  }
}

TEST(DisplayPaths, both_senses_by_a_boundary_add_up_as_pressures) {
  expect_same_levels(below_a_surface(), "multipath", 10, 0.15, 0.4);
}

TEST(DisplayPaths, both_senses_add_less_where_a_beam_hears_one) {
  Position position = below_a_surface();
  // Rolled, directions out and back differ along the array by about half the width of a beam.
  position.pose = pose_from_yaw_pitch_roll({-5, 0, 3}, 0.1, 0.3, 0.12);
  expect_same_levels(position, "multipath", 10, 0.15, 0.5);
}

TEST(DisplayPaths, layers_are_of_their_own_echoes_and_the_sum_of_all) {
  Position position = below_a_surface();
  position.options.effects.noise = true;
  const SimulatedPing all = position.ping(false);
  ASSERT_EQ(all.ping.layers.size(), 3u);
  EXPECT_EQ(all.ping.layers[1].name, "multipath");
  EXPECT_EQ(all.ping.layers[2].name, "noise");
  double energy = 0;
  for (const Layer& layer : all.ping.layers) energy += layer.pressure.cast<std::complex<double>>().abs2().sum();
  EXPECT_NEAR(db_from_power(all.ping.pressure.cast<std::complex<double>>().abs2().sum() / energy), 0, 0.3);
  position.options.effects.multipath = Choice::never, position.options.effects.noise = false;
  const SimulatedPing direct = position.ping(false);
  EXPECT_TRUE((direct.ping.pressure == all.ping.layers[0].pressure).all());
  EXPECT_TRUE((direct.ping.layers[0].pressure == direct.ping.pressure).all());
}

TEST(DisplayPaths, mirrors_show_ghosts_and_glints) {
  Position position;
  position.environment.mirrors = {with_size({.name = "wall", .position = {5, 0, 3}, .normal = {-1, 0, 0}}, 30, 6)};
  position.options.effects.mirrors = Choice::always;
  position.pose = pose_from_yaw_pitch_roll({-5, 0, 3}, 0, 0.1, 0);
  expect_same_levels(position, "mirrors", 4, 0.3, 0.5);
}

TEST(DisplayPaths, double_echoes_add_up_as_pressures) {
  if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  Position position;
  position.scene = SceneCloud{};
  position.scene.materials = {{"bed", 0.1}};
  // A bed of 4 m that ends at a wall.
  for (const bool wall : {false, true})
    for (std::uint64_t i = 0; i < 10000; ++i) {
      const auto at = random_uniform(3, RandomStage::scene_points, {position.scene.size(), 0, 0});
      const double a = 0.04 * (static_cast<double>(i % 100) + at[0]),
                   b = 0.04 * (static_cast<double>(i / 100) + at[1]) - 2;
      add_surfel(position.scene, wall ? Eigen::Vector3d(5, b, a) : Eigen::Vector3d(5 - a, b, 0),
                 Eigen::Vector3d(wall ? -1 : 0, 0, wall ? 0 : 1), 1.6e-3, 0);
    }
  position.pose = pose_from_yaw_pitch_roll({-3, 0, 2}, 0, 0.15, 0);
  position.options.effects.double_echoes = 4;
  expect_same_levels(position, "double-echoes", 10, 0.3, 0.8);
}

}  // namespace insonify::display_path_tests
