// SPDX-License-Identifier: BSD-3-Clause
// Whole pings of a captured cloud without normals, against sums over its true surface.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/files.hpp"
#include "support/heads.hpp"
#include "support/height_field.hpp"
#include "support/scene_for_ping.hpp"

using namespace insonify;

namespace {

// Returns waves from 0.16 to 1.6 m in all directions, slopes of 25 degrees in the mean.
HeightField rough_bed() {
  struct Wave {
    double kx, ky, phase, height;
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Wave> waves(40);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double length = 0.16 * std::pow(10, uniform(random)), angle = 2 * pi * uniform(random);
    waves[i] = {2 * pi / length * std::cos(angle), 2 * pi / length * std::sin(angle), 2 * pi * uniform(random),
                0.018 * length};
  }
  return height_field({4.5, 0}, 3.5, 0.02, [&](double x, double y) {
    double z = 0;
    for (const Wave& w : waves) z += w.height * std::cos(w.kx * x + w.ky * y + w.phase);
    return z;
  });
}

double decibels(double a, double b) { return db_from_power(a / b); }

class WholePing : public ::testing::Test {
 protected:
  static constexpr Eigen::Index groups = 4, bands = 6;
  static const HeightField& bed() {
    static const HeightField field = rough_bed();
    return field;
  }
  static const LoadedScene& loaded() {
    LoadOptions load;
    load.viewpoint = Eigen::Vector3d(4.5, 0, 5);
    static const LoadedScene loaded = load_scene(own_file("bed.xyz", points_of(bed())), load);
    return loaded;
  }
  static Grid<double> simulated(const SceneCloud& scene, SynthesisMethod method) {
    SimulationOptions options;
    options.synthesis.method = method;
    return energy_of(simulate_ping(scene, head(), pose(), {}, options).ping.pressure, groups, bands);
  }
  static void expect_level(const SceneCloud& scene, double total, double part) {
    const Grid<double> energy = simulated(scene, SynthesisMethod::incoherent);
    EXPECT_NEAR(decibels(energy.sum(), truth().sum()), 0, total);
    for (Eigen::Index n = 0; n < bands; ++n)
      EXPECT_NEAR(decibels(energy.col(n).sum(), truth().col(n).sum()), 0, part) << "band " << n;
    for (Eigen::Index i = 0; i < energy.size(); ++i)
      if (truth()(i) > 1e-3 * truth().maxCoeff()) {
        EXPECT_NEAR(decibels(energy(i), truth()(i)), 0, part) << "cell " << i;
      }
  }
  static SonarHead head() { return small_head({.min_range = 2.5, .max_range = 7}); }
  static Pose pose() { return pose_from_yaw_pitch_roll({0.2, 0, 2}, 0, radians(25), 0); }
  static const Grid<double>& truth() {
    static const Grid<double> energy =
        energy_by_definition(bed(), Material{}.lambert_mu, head(), pose(), medium_of(Water{}, 450e3), 1, groups, bands);
    return energy;
  }
};

}  // namespace

TEST_F(WholePing, of_the_points_of_a_rough_bed_has_the_expected_level_of_its_true_surface) {
  expect_level(loaded().scene, 0.2, 0.5);
}

TEST_F(WholePing, of_a_rough_bed_as_a_raster_has_the_expected_level_of_its_true_surface) {
  ASSERT_TRUE(loaded().mesh);
  expect_level(scene_for_ping(loaded(), head(), pose(), {}), 0.1, 0.3);
}

TEST_F(WholePing, of_a_rough_bed_with_speckle_has_its_total) {
  EXPECT_NEAR(decibels(simulated(loaded().scene, SynthesisMethod::gridded).sum(), truth().sum()), 0, 0.2);
}
