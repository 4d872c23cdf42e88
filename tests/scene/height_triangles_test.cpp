// Surfaces between the points of height fields.
#include "scene/estimate/height_triangles.hpp"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace insonify;
using Eigen::Vector3f;

namespace {

// n x n points over 1 m2, off their grid by up to `off` spacings.
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
  std::vector<std::uint8_t> noisy(points.size(), 1);
  noisy[7] = 0;
  const auto heights = smoothed_heights(points, noisy);
  EXPECT_EQ(smoothed_heights(points, noisy, 1), heights);
  EXPECT_EQ(heights[7], points[7].z());
  double before = 0, after = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    before += std::pow(points[i].z() - wave(points[i]), 2);
    after += std::pow(heights[i] - wave(points[i]), 2);
  }
  EXPECT_LT(after, 0.15 * before);
}
