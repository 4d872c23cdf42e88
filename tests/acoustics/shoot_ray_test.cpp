// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/shoot_ray.hpp"

#include <random>

#include "acoustics/refract_paths.hpp"
#include "support/test.hpp"

namespace {

const SoundSpeedProfile shallow_layers{{0, 3, 8, 9, 20, 40}, {1512, 1511, 1498, 1500, 1495, 1496}};

}  // namespace

TEST(ShootRay, goes_straight_in_water_of_one_speed) {
  const RayEnd end = shoot_ray({{0}, {1500}}, 2, radians(-30), 0.02);
  EXPECT_NEAR(end.horizontal, 30 * std::cos(radians(30)), 1e-12);
  EXPECT_NEAR(end.depth, 2 + 15, 1e-12);
  EXPECT_NEAR(end.elevation, radians(-30), 1e-12);
}

// The fastest ray between two points, found by another method, leads from the one to the other.
TEST(ShootRay, straight_up_and_down_leaves_the_profile) {
  // Water of one speed goes on above and below.
  const SoundSpeedProfile profile{{5, 6}, {1500, 1490}};
  EXPECT_NEAR(shoot_ray(profile, 2, pi / 2, 0.01).depth, 2 - 15, 1e-9);
  EXPECT_NEAR(shoot_ray(profile, 7, -pi / 2, 0.01).depth, 7 + 14.9, 1e-9);
  const double through = std::log(1500 / 1490.0) / 10;  // [s], of the layer
  EXPECT_NEAR(shoot_ray(profile, 4, -pi / 2, 1 / 1500.0 + through + 2 / 1490.0).depth, 8, 1e-9);
}

TEST(ShootRay, follows_the_eigenray_to_its_end) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 400; ++trial) {
    const double from = 12 * unit(random), to = 50 * unit(random), far = 0.01 + 60 * unit(random);
    const Eigenray ray = find_eigenray(shallow_layers, from, to, far);
    const RayEnd end = shoot_ray(shallow_layers, from, ray.elevation, ray.travel_time);
    // Ends are stationary in neither: an elevation good to 1e-9 rad moves them by 60 m x 1e-9 and more near a caustic.
    EXPECT_NEAR(end.horizontal, far, 1e-5) << from << " m to " << to << " m";
    EXPECT_NEAR(end.depth, to, 1e-5) << from << " m to " << to << " m";
  }
}

TEST(ShootRay, is_its_own_way_back) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double depth = 30 * unit(random), elevation = pi * (unit(random) - 0.5), time = 0.05 * unit(random);
    const RayEnd there = shoot_ray(shallow_layers, depth, elevation, time);
    const RayEnd back = shoot_ray(shallow_layers, there.depth, -there.elevation, time);
    EXPECT_NEAR(back.depth, depth, 1e-8);
    EXPECT_NEAR(back.horizontal, there.horizontal, 1e-8);
    EXPECT_NEAR(back.elevation, -elevation, 1e-8);
  }
}

// One gradient g, level start: a circle of radius c / g, on which the slope grows as gd(g t).
TEST(ShootRay, bends_in_a_circle_towards_slow_water) {
  const double g = 0.02, c = 1500, time = 0.4;
  const RayEnd end = shoot_ray({{-1e4, 1e4}, {1300, 1700}}, 0, 0, time);
  const double slope = std::atan(std::sinh(g * time));
  EXPECT_NEAR(end.elevation, slope, 1e-12);
  EXPECT_NEAR(end.horizontal, c / g * std::sin(slope), 1e-7);
  EXPECT_NEAR(end.depth, -c / g * (1 - std::cos(slope)), 1e-7);
}

TEST(ShootRay, level_on_the_axis_of_a_duct_stays_there) {
  const RayEnd end = shoot_ray({{0, 20, 40}, {1520, 1480, 1520}}, 20, 0, 0.1);
  EXPECT_DOUBLE_EQ(end.depth, 20);
  EXPECT_NEAR(end.horizontal, 148, 1e-9);
}

TEST(ShootRay, refuses_what_is_no_ray) {
  EXPECT_EQ(error_of([] {
              shoot_ray({{0}, {1500}}, 0, 2, 0.1);
            }),
            "shoot_ray: elevation = 2 rad, must be within -pi/2 and pi/2");
  EXPECT_EQ(error_of([] { shoot_ray({{0}, {1500}}, 0, 0, -1); }), "shoot_ray: time = -1 s, must be finite and >= 0");
  EXPECT_THAT(error_of([] { shoot_ray({}, 0, 0, 1); }), testing::HasSubstr("shoot_ray"));
}
