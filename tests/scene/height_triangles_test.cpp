// SPDX-License-Identifier: BSD-3-Clause
// Tests the surfaces between the points of height fields.
#include "scene/estimate/height_triangles.hpp"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "scene/estimate/smoothed_heights.hpp"

using namespace insonify;
using Eigen::Vector3f;

namespace {

// Returns n x n points over 1 m^2, off their grid by up to `off` spacings.
std::vector<Vector3f> scattered(int n, float off) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-off, off);
  std::vector<Vector3f> points;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      points.emplace_back((static_cast<float>(i) + uniform(random)) / static_cast<float>(n),
                          (static_cast<float>(j) + uniform(random)) / static_cast<float>(n), uniform(random));
  return points;
}

double plan_of(const std::vector<Vector3f>& points, const std::array<std::uint32_t, 3>& t) {
  const Eigen::Vector3d a = points[t[0]].cast<double>(), b = points[t[1]].cast<double>(),
                        c = points[t[2]].cast<double>();
  return (b - a).cross(c - a).z() / 2;
}

}  // namespace

TEST(HeightTriangles, tile_the_plan_without_overlap) {
  for (const float off : {0.0f, 0.3f, 3.0f}) {
    const auto points = scattered(40, off);
    const auto triangles = height_triangles(points);
    EXPECT_EQ(height_triangles(points, 1), triangles);
    double sum = 0;
    for (const auto& t : triangles) {
      ASSERT_GT(plan_of(points, t), 0);  // counter-clockwise
      sum += plan_of(points, t);
    }
    // Every place between four points lies in one triangle, which no overlap changes.
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0.1, 0.85);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d p(uniform(random), uniform(random), 0);
      int around = 0;
      for (const auto& t : triangles) {
        bool inside = true;
        for (int e = 0; e < 3; ++e) {
          const Eigen::Vector3d a = points[t[e]].cast<double>(), b = points[t[(e + 1) % 3]].cast<double>();
          inside = inside && (b - a).head<2>().x() * (p - a).y() - (b - a).head<2>().y() * (p - a).x() > 0;
        }
        around += inside;
      }
      ASSERT_EQ(around, 1) << off << " " << p.transpose();
    }
    if (off == 0) {
      EXPECT_NEAR(sum, std::pow(39.0 / 40, 2), 1e-4);
    }
  }
}

TEST(HeightTriangles, hold_no_other_point_in_their_circles) {
  const auto points = scattered(20, 1);
  for (const auto& t : height_triangles(points)) {
    const Eigen::Vector2d a = points[t[0]].head<2>().cast<double>(), b = points[t[1]].head<2>().cast<double>() - a,
                          c = points[t[2]].head<2>().cast<double>() - a;
    const double d = 2 * (b.x() * c.y() - b.y() * c.x());
    const Eigen::Vector2d middle(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(),
                                 b.x() * c.squaredNorm() - c.x() * b.squaredNorm());
    const double radius = middle.norm() / d;
    for (const Vector3f& p : points) ASSERT_GT((p.head<2>().cast<double>() - a - middle / d).norm(), radius - 1e-3);
  }
}

TEST(HeightTriangles, leave_holes_open) {
  auto points = scattered(40, 0.3f);
  std::erase_if(points, [](const Vector3f& p) { return (p.head<2>() - Eigen::Vector2f(0.5f, 0.5f)).norm() < 0.1f; });
  for (const auto& t : height_triangles(points)) {
    const Eigen::Vector2f middle = (points[t[0]] + points[t[1]] + points[t[2]]).head<2>() / 3;
    EXPECT_GT((middle - Eigen::Vector2f(0.5f, 0.5f)).norm(), 0.07f);
  }
  EXPECT_TRUE(height_triangles({}).empty());
}

TEST(SmoothedHeights, lie_near_the_surface_that_noise_hides) {
  std::mt19937 random(9);
  std::normal_distribution<float> noise;
  auto points = scattered(80, 0.3f);
  const auto wave = [](const Vector3f& p) { return 0.05f * std::sin(12 * p.x()) * std::cos(9 * p.y()); };
  const float spacing = 1.0f / 80;
  for (Vector3f& p : points) p.z() = wave(p) + 0.5f * spacing * noise(random);
  std::vector<float> sigma(points.size(), 0.5f * spacing);
  sigma[7] = 0;
  const auto heights = smoothed_heights(points, sigma);
  EXPECT_EQ(smoothed_heights(points, sigma, 1), heights);
  EXPECT_EQ(heights[7], points[7].z());
  double before = 0, after = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    before += std::pow(points[i].z() - wave(points[i]), 2);
    after += std::pow(heights[i] - wave(points[i]), 2);
  }
  EXPECT_LT(after, 0.15 * before);
}

// The width of neighbourhoods follows the surface: a plane becomes as even as the widest ones make it, and waves that
// noise of one spacing does not hide keep their slopes.
TEST(SmoothedHeights, keep_the_waves_that_rise_out_of_noise_and_no_others) {
  constexpr int n = 128;
  constexpr float spacing = 1.0f / n;
  const auto slopes = [](const std::vector<float>& heights) {  // mean square, between neighbours of a raster, inside
    double sum = 0;
    int count = 0;
    for (int j = 12; j < n - 12; ++j)
      for (int i = 12; i < n - 12; ++i, ++count)
        sum += std::pow(
            (heights[static_cast<std::size_t>(j * n + i + 1)] - heights[static_cast<std::size_t>(j * n + i)]) / spacing,
            2);
    return sum / count;
  };
  const auto bed = [](float steepness, float i, float j) {  // of two waves, 12 and 20 spacings long
    const float k = 2 * 3.14159265f;
    return steepness * spacing / k *
           (12 * std::sin(k * (i + 0.5f * j) / 13.4f) + 20 * std::cos(k * (j - 0.3f * i) / 20.9f));
  };
  std::mt19937 random(3);
  std::normal_distribution<float> noise;
  for (const float steepness : {0.0f, 0.5f}) {
    std::vector<Vector3f> points;
    std::vector<float> truth;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        truth.push_back(bed(steepness, static_cast<float>(i), static_cast<float>(j)));
        points.emplace_back(static_cast<float>(i) * spacing, static_cast<float>(j) * spacing,
                            truth.back() + spacing * noise(random));
      }
    const auto heights = smoothed_heights(points, std::vector<float>(points.size(), spacing));
    EXPECT_NEAR(slopes(heights), slopes(truth), 0.2 * slopes(truth) + 0.003) << steepness;
  }
}

TEST(SmoothedHeights, of_a_few_points_are_theirs_if_no_cubic_goes_through_them) {
  const std::vector<Vector3f> points = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}};
  EXPECT_EQ(smoothed_heights(points, std::vector<float>(4, 9)), (std::vector<float>{1, 2, 3, 4}));
}

// A pole, a quay and a low wall across the grid, of which a cubic would make hills: points move by noise alone, and
// noise goes as close to the pole and the wall as there are enough neighbours on one side.
TEST(SmoothedHeights, leave_steps_and_objects_where_they_are) {
  constexpr int n = 64;
  constexpr float sigma = 0.02f;
  std::mt19937 random(5);
  std::normal_distribution<float> noise;
  std::vector<Vector3f> points;
  std::vector<float> truth;
  const auto to_wall = [](int i, int j) {
    return 0.9f * static_cast<float>(i - 40) + 0.4f * static_cast<float>(j - 32);
  };
  const auto to_pole = [](int i, int j) { return std::max(std::abs(i - 12), std::abs(j - 20)); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      truth.push_back(0.1f * static_cast<float>(i) + (to_wall(i, j) > 0 ? 0.3f : 0) + (j > 50 ? 8.0f : 0) +
                      (to_pole(i, j) == 0 ? 4.0f : 0));
      points.emplace_back(0.25f * static_cast<float>(i), 0.25f * static_cast<float>(j),
                          truth.back() + sigma * noise(random));
    }
  const auto heights = smoothed_heights(points, std::vector<float>(points.size(), sigma));
  const auto left = [&](auto&& here) {  // mean square of what is off the truth, over that of the noise
    double sum = 0;
    int count = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        if (!here(i, j)) continue;
        const auto at = static_cast<std::size_t>(j * n + i);
        sum += std::pow((heights[at] - truth[at]) / sigma, 2), ++count;
      }
    return sum / count;
  };
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LE(std::abs(heights[i] - points[i].z()), 2.901f * sigma) << i;
  EXPECT_EQ(heights[20 * n + 12], points[20 * n + 12].z());
  EXPECT_LT(left([&](int i, int j) { return to_pole(i, j) > 0 && to_pole(i, j) < 5; }), 0.2);
  EXPECT_LT(left([&](int i, int j) { return j < 45 && std::abs(to_wall(i, j)) < 3; }), 0.8);
  EXPECT_LT(left([&](int i, int j) { return j < 45 && i < 25 && to_pole(i, j) > 0; }), 0.1);
}
