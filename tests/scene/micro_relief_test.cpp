// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/micro_relief.hpp"

#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

/// Returns the mean of tan^2 of the tilt over `count` random positions on a plane 1000 wavelengths wide.
double mean_square_slope(const ReliefField& field, double rms_slope, const Vector3d& normal, int count) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> along(-25, 25);
  const Vector3d t1 = normal.unitOrthogonal(), t2 = normal.cross(t1);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const Vector3d tilted = tilted_normal(field, rms_slope, along(random) * t1 + along(random) * t2, normal);
    sum += 1 / std::pow(tilted.dot(normal), 2) - 1;
  }
  return sum / count;
}

std::string message_of(const MicroRelief& relief) {
  return error_of([&] { const ReliefField field(relief); });
}

SceneCloud rough_scene(double relief_slope) {
  SceneCloud scene;
  scene.materials[0].relief_slope = relief_slope;
  add_surfel(scene, {0, 0, 0}, {0, 0, 1}, 0.04);
  add_surfel(scene, {1, 0, 0}, {0, 0, 1}, 0.12);
  return scene;
}

}  // namespace

// tan^2 scatters by about its mean: 200 000 independent positions give 0.25 %, one standard deviation.
TEST(MicroRelief, mean_square_of_the_slope_is_that_of_the_material_on_every_plane_and_for_every_seed) {
  const Vector3d planes[] = {{0, 0, 1}, {1, 0, 0}, Vector3d(1, -2, 3).normalized()};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const ReliefField field({seed, 0.05});
    for (const Vector3d& normal : planes)
      for (const double slope : {0.05, 0.3, 1.0})
        EXPECT_NEAR(mean_square_slope(field, slope, normal, 200000), slope * slope, 0.02 * slope * slope)
            << "seed " << seed << ", normal " << normal.transpose();
  }
}

TEST(MicroRelief, slopes_have_no_preferred_direction_and_no_mean) {
  const ReliefField field({7, 0.05});
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> along(-25, 25);
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d variance = Eigen::Matrix3d::Zero();
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const Vector3d g = field.gradient({along(random), along(random), along(random)});
    mean += g / count;
    variance += g * g.transpose() / count;
  }
  EXPECT_LT(mean.norm(), 0.01);
  EXPECT_LT((variance - 0.5 * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.01);
}

// The slopes are the gradient of a height: their integral over a closed path vanishes.
TEST(MicroRelief, slopes_are_the_gradient_of_a_height) {
  const ReliefField field({3, 0.05});
  const Vector3d corners[] = {{0, 0, 0}, {0.03, 0, 0.01}, {0.02, 0.04, 0}, {0, 0, 0}};
  double climb = 0, way = 0;
  for (int leg = 0; leg < 3; ++leg) {
    const int steps = 20000;
    const Vector3d step = (corners[leg + 1] - corners[leg]) / steps;
    for (int i = 0; i < steps; ++i) {
      const double rise = field.gradient(corners[leg] + (i + 0.5) * step).dot(step);
      climb += rise;
      way += std::abs(rise);
    }
  }
  EXPECT_LT(std::abs(climb), 1e-4 * way);
}

TEST(MicroRelief, depends_on_position_and_seed) {
  const ReliefField field({1, 0.05}), again({1, 0.05}), other({2, 0.05});
  const Vector3d position(12.3, -4.5, 6.7);
  EXPECT_EQ(field.gradient(position), again.gradient(position));
  EXPECT_NE(field.gradient(position), other.gradient(position));
  EXPECT_NE(field.gradient(position), field.gradient(position + Vector3d(0.001, 0, 0)));
}

// The shortest wave is 0.05 m / 2^5 = 1.6 mm: over a micrometre slopes change by at most 2 pi / 1.6 mm x 1 um = 0.4 %
// of the largest (each wave at its steepest: 30 waves of sqrt(1/10)).
TEST(MicroRelief, is_smooth_a_thousand_kilometres_from_zero) {
  const ReliefField field({1, 0.05});
  const Vector3d far(1e6, -1e6, 1e6);
  const double largest = 30 * std::sqrt(1.0 / 10);
  double most = 0, square = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector3d position = far + Vector3d(i * 1e-6, 0, 0);
    const Vector3d step = field.gradient(position + Vector3d(1e-6, 0, 0)) - field.gradient(position);
    most = std::max(most, step.norm());
    square += field.gradient(far + Vector3d(i * 0.1, 0, 0)).squaredNorm() / 10000;
  }
  EXPECT_LT(most, 0.004 * largest);
  EXPECT_GT(most, 0);
  EXPECT_NEAR(square, 1.5, 0.1);
}

// With octaves of equal slope, slopes at positions farther apart than the outer scale are uncorrelated, those much
// closer than the shortest wave fully correlated, and the correlation falls in between.
TEST(MicroRelief, decorrelates_within_the_outer_scale) {
  const ReliefField field({4, 0.05});
  const auto correlation = [&](double distance) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> along(-25, 25);
    double product = 0, square = 0;
    for (int i = 0; i < 50000; ++i) {
      const Vector3d position(along(random), along(random), 0);
      const Vector3d a = field.gradient(position);
      product += a.head<2>().dot(field.gradient(position + Vector3d(distance, 0, 0)).head<2>());
      square += a.head<2>().squaredNorm();
    }
    return product / square;
  };
  EXPECT_GT(correlation(1e-4), 0.98);
  EXPECT_LT(correlation(5e-3), 0.8);
  EXPECT_GT(correlation(5e-3), 0.1);
  double far = 0;
  for (int i = 0; i < 10; ++i) far += correlation(1 + 0.37 * i) / 10;
  EXPECT_NEAR(far, 0, 0.12);  // 30 cosines of weight 1/30: sd 0.13 at one distance, 0.04 over ten
}

TEST(MicroRelief, leaves_a_smooth_normal_and_gives_unit_length) {
  const ReliefField field({1, 0.05});
  const Vector3d normal = Vector3d(3, -4, 12) / 13;
  EXPECT_LT((tilted_normal(field, 0, {1, 2, 3}, normal) - normal).norm(), 1e-15);
  EXPECT_NEAR(tilted_normal(field, 0.7, {1, 2, 3}, normal).norm(), 1, 1e-15);
}

TEST(MicroRelief, is_absent_from_smooth_scenes_and_scales_with_the_surfel_spacing) {
  EXPECT_FALSE(relief_of(rough_scene(0), {}).has_value());
  EXPECT_FALSE(relief_of(SceneCloud{}, {}).has_value());
  const SceneCloud scene = rough_scene(0.1);
  const auto by_spacing = relief_of(scene, {});
  ASSERT_TRUE(by_spacing.has_value());
  const ReliefField expected({1, std::sqrt((0.04f + 0.12f) / 2.0)});
  const Vector3d normal = scene.normal[0].cast<double>().normalized();
  EXPECT_LT((by_spacing->facet_of(scene, 0, 0.1, {1, 2, 3}) - tilted_normal(expected, 0.1, {1, 2, 3}, normal)).norm(),
            1e-6);
}

TEST(MicroRelief, refuses_invalid_scales_and_octaves) {
  EXPECT_EQ(message_of({1, -0.1}), "ReliefField: relief.outer_scale = -0.1 m, must be finite and > 0");
  EXPECT_EQ(message_of({1, 0.1, 0}), "ReliefField: relief.octaves = 0, must be in 1 .. 10");
  EXPECT_EQ(message_of({1, 0.1, 11}), "ReliefField: relief.octaves = 11, must be in 1 .. 10");
  EXPECT_EQ(message_of({1, 0.1, 10}), "no error");
}

TEST(Materials, with_impossible_values_are_refused_with_their_number_and_rule) {
  const auto message = [](const Material& material) -> std::string {
    SceneCloud scene;
    scene.materials = {material};
    return error_of([&] { require_valid(scene, "f"); }, ErrorKind::content);
  };
  EXPECT_EQ(message({"mud", 0.1, 1, 2}), "no error");
  for (const auto& [mu, text] : {std::pair{-1.0, "-1"}, {std::nan(""), "nan"}, {HUGE_VAL, "inf"}})
    EXPECT_EQ(message({"mud", mu}),
              "f: lambert_mu of material 'mud' = " + std::string(text) + " 1/sr, must be finite and >= 0");
  EXPECT_EQ(message({"mud", 0.1, 1.5}), "f: coherent_fraction of material 'mud' = 1.5, must be within 0 and 1");
  EXPECT_EQ(message({"mud", 0.1, std::nan("")}),
            "f: coherent_fraction of material 'mud' = nan, must be within 0 and 1");
  EXPECT_EQ(message({"mud", 0.1, 0, -0.2}), "f: relief_slope of material 'mud' = -0.2, must be finite and >= 0");
}
