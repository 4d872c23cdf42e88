// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/surfel_noise.hpp"

#include "scene/estimate/surfel_area.hpp"
#include "support/test.hpp"

namespace {

double median_noise(double noise, double curvature) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 80; ++i)
    for (int j = 0; j < 80; ++j) {
      const float x = 0.05f * static_cast<float>(i), y = 0.05f * static_cast<float>(j);
      points.emplace_back(x, y, static_cast<float>(noise) * normal(random) + static_cast<float>(curvature) * x * x);
    }
  std::vector<float> found = estimate_surfel_noise(points);
  std::nth_element(found.begin(), found.begin() + found.size() / 2, found.end());
  return found[found.size() / 2];
}

}  // namespace

TEST(SurfelNoise, is_the_standard_deviation_across_the_surface) {
  for (const double noise : {0.002, 0.01, 0.02}) EXPECT_NEAR(median_noise(noise, 0), noise, 0.2 * noise) << noise;
}

TEST(SurfelNoise, of_a_smooth_surface_is_none) {
  EXPECT_LT(median_noise(0, 0), 1e-6);
  EXPECT_LT(median_noise(0, 0.1), 1e-3);  // bent by 2 mm from middle to rim of a neighbourhood
}

// The noise that shapes estimate with their own search is that of the noise alone, with copies of points, too.
TEST(SurfelShapes, give_the_noise_of_surfels_on_request) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(0, 4);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(place(random), place(random), 0.01f * normal(random));
  const auto compare = [&] {
    const std::vector<Eigen::Vector3f> up(points.size(), Eigen::Vector3f::UnitZ());
    const std::vector<float> alone = estimate_surfel_noise(points);
    const std::vector<float> shared = estimate_surfel_shapes(points, up, {.noise = true}).noise;
    ASSERT_EQ(shared.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_FLOAT_EQ(shared[i], alone[i]) << i;
    EXPECT_TRUE(estimate_surfel_shapes(points, up).noise.empty());
    EXPECT_EQ(estimate_surfel_shapes(points, up, {.viewpoint = Eigen::Vector3d(2, 2, 9), .noise = true}).noise.size(),
              points.size());
  };
  compare();
  for (int i = 0; i < 100; ++i) points.push_back(points[static_cast<std::size_t>(7 * i)]);
  compare();
  points.resize(3);
  EXPECT_EQ(
      estimate_surfel_shapes(points, std::vector<Eigen::Vector3f>(3, Eigen::Vector3f::UnitZ()), {.noise = true}).noise,
      std::vector<float>(3, 0));
}

// A bed of dunes needs no base normals; the wall that stands on it does.
TEST(SurfelShapes, ask_for_base_normals_outside_of_height_fields) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, 6), high(0.2f, 3);
  std::vector<Eigen::Vector3f> points, base;
  for (int i = 0; i < 3600; ++i) {
    const float x = place(random), y = place(random);
    points.emplace_back(x, y, 0.1f * std::sin(3 * x));
    base.push_back(Eigen::Vector3f::UnitZ());
  }
  const std::size_t bed = points.size();
  for (int i = 0; i < 1800; ++i) {
    points.emplace_back(6.5f, place(random), high(random));
    base.push_back(Eigen::Vector3f::UnitX());
  }
  std::size_t of_bed = 0, of_wall = 0;
  const SurfelShapes given = estimate_surfel_shapes(points, base);
  const SurfelShapes asked = estimate_surfel_shapes(points, {}, {.base = [&](const std::vector<std::uint32_t>& wanted) {
                                                      std::vector<Eigen::Vector3f> found;
                                                      for (const std::uint32_t i : wanted)
                                                        found.push_back(base[i]), ++(i < bed ? of_bed : of_wall);
                                                      return found;
                                                    }});
  EXPECT_LT(of_bed, bed / 10);
  EXPECT_GT(of_wall, (points.size() - bed) * 9 / 10);
  EXPECT_EQ(asked.normal, given.normal);
  EXPECT_EQ(asked.area, given.area);
  const auto up = [](const std::vector<std::uint32_t>& wanted) {
    return std::vector<Eigen::Vector3f>(wanted.size(), Eigen::Vector3f::UnitY());
  };
  EXPECT_EQ(estimate_surfel_shapes(std::span(points).first(3), {}, {.base = up}).normal,
            std::vector<Eigen::Vector3f>(3, Eigen::Vector3f::UnitY()));
  EXPECT_TRUE(estimate_surfel_shapes({}, {}, {.base = up}).normal.empty());
}

// Boxes and pits on a third of a raster, and a slope of 45 degrees, are no noise of its heights (E160).
TEST(SurfelShapes, know_noise_of_heights) {
  const auto noise_of = [&](float noise) {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 80; ++i)
      for (int j = 0; j < 80; ++j) {
        const bool box = i % 20 < 11 && j % 20 < 11;
        const float x = 0.25f * static_cast<float>(i), y = 0.25f * static_cast<float>(j);
        points.emplace_back(x, y, x + (box ? (i < 40 ? 2.0f : -1.0f) : 0) + noise * normal(random));
      }
    const std::vector<Eigen::Vector3f> up(points.size(), Eigen::Vector3f::UnitZ());
    const std::vector<float> found = estimate_surfel_shapes(points, up).height_noise;
    return *std::max_element(found.begin(), found.end());
  };
  EXPECT_EQ(noise_of(0), 0);
  EXPECT_NEAR(noise_of(0.02f), 0.02, 0.001);
}
