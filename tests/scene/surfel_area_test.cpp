#include "scene/surfel_area.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"

using namespace insonify;
using Eigen::Vector3f;

namespace {

double sum_of(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// A plate of 3 m x 2 m with one point per cell of `spacing`, moved from its centre by up to `jitter`
// spacings.
std::vector<Vector3f> plate(float spacing, float jitter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shift(-jitter, jitter);
  std::vector<Vector3f> points;
  for (int i = 0; i < std::lround(3 / spacing); ++i)
    for (int j = 0; j < std::lround(2 / spacing); ++j)
      points.emplace_back((static_cast<float>(i) + 0.5f + shift(random)) * spacing,
                          (static_cast<float>(j) + 0.5f + shift(random)) * spacing, 0);
  return points;
}

std::vector<float> areas_of_flat(const std::vector<Vector3f>& points, int threads = 0) {
  return estimate_surfel_areas(points, std::vector<Vector3f>(points.size(), Vector3f::UnitZ()), {.threads = threads});
}

}  // namespace

TEST(SurfelArea, of_a_regular_plate_is_one_cell_each_at_borders_and_corners_too) {
  const auto areas = areas_of_flat(plate(0.05f, 0));
  for (const float a : areas) ASSERT_NEAR(a, 0.05 * 0.05, 1e-6);
}

TEST(SurfelArea, of_a_stratified_plate_adds_up_to_its_area) {
  for (const float spacing : {0.1f, 0.05f, 0.02f}) {
    EXPECT_NEAR(sum_of(areas_of_flat(plate(spacing, 0.25f))), 6.0, 6.0 * 0.02) << spacing;
    EXPECT_NEAR(sum_of(areas_of_flat(plate(spacing, 0.5f))), 6.0, 6.0 * 0.02) << spacing;
  }
}

TEST(SurfelArea, of_a_sphere_adds_up_to_its_area) {
  const SceneCloud sphere = make_built_in_scene("sphere", {.points = 5000, .radius = 0.7});
  const auto areas = estimate_surfel_areas(sphere.point, sphere.normal);
  EXPECT_NEAR(sum_of(areas), 4 * pi * 0.49, 4 * pi * 0.49 * 0.02);
}

TEST(SurfelArea, does_not_depend_on_the_sign_of_normals_or_on_threads) {
  const std::vector<Vector3f> points = plate(0.05f, 0.4f);
  const auto areas = areas_of_flat(points, 1);
  EXPECT_EQ(areas, areas_of_flat(points, 2));
  EXPECT_EQ(areas, areas_of_flat(points, 7));
  const auto turned = estimate_surfel_areas(points, std::vector<Vector3f>(points.size(), -Vector3f::UnitZ()));
  for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(turned[i], areas[i], 1e-3 * areas[i]);
}

TEST(SurfelArea, is_shared_by_coincident_points) {
  std::vector<Vector3f> points = plate(0.1f, 0.3f);
  const auto once = areas_of_flat(points);
  const std::size_t n = points.size();
  for (int copy = 0; copy < 40; ++copy)
    for (std::size_t i = 0; i < n; ++i) points.push_back(points[i]);
  const auto many = areas_of_flat(points);
  for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(many[i] * 41, once[i], 1e-5 * once[i]);
  EXPECT_NEAR(sum_of(many), sum_of(once), 1e-4 * sum_of(once));
}

TEST(SurfelArea, of_two_plates_apart_is_that_of_each) {
  std::vector<Vector3f> points = plate(0.05f, 0);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(points[i] + Vector3f(0.3f, 0.2f, 0.4f));
  EXPECT_NEAR(sum_of(areas_of_flat(points)), 12.0, 12.0 * 0.02);
}

TEST(SurfelArea, of_two_sheets_one_above_the_other_is_that_of_each) {
  std::vector<Vector3f> points = plate(0.05f, 0);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(points[i] + Vector3f(0.025f, 0.025f, 0.06f));
  EXPECT_NEAR(sum_of(areas_of_flat(points)), 12.0, 12.0 * 0.02);
}

TEST(SurfelArea, follows_the_density_of_scan_lines) {
  // Points 1 cm apart on lines 12 cm apart, cell-centred on 1.2 m x 1.2 m.
  std::vector<Vector3f> points;
  for (int line = 0; line < 10; ++line)
    for (int i = 0; i < 120; ++i)
      points.push_back(Eigen::Vector3d(0.01 * (i + 0.5), 0.12 * (line + 0.5), 0).cast<float>());
  EXPECT_NEAR(sum_of(areas_of_flat(points)), 1.44, 1.44 * 0.1);
}

TEST(SurfelArea, of_points_in_a_row_is_their_spacing_squared) {
  std::vector<Vector3f> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(0.1f * static_cast<float>(i), 0, 0);
  for (const float a : areas_of_flat(points)) EXPECT_NEAR(a, 0.01, 0.01 * 0.2);
}

TEST(SurfelArea, of_an_outlier_is_no_larger_than_its_neighbours) {
  std::vector<Vector3f> points = plate(0.1f, 0.2f);
  points.emplace_back(30.f, 5.f, 0.2f);
  points.emplace_back(-8.f, 70.f, 3.f);
  const auto areas = areas_of_flat(points);
  EXPECT_LT(areas[points.size() - 1], 0.04);
  EXPECT_LT(areas[points.size() - 2], 0.04);
}

TEST(SurfelArea, of_fewer_than_four_points_is_zero) {
  EXPECT_TRUE(areas_of_flat({}).empty());
  EXPECT_EQ(areas_of_flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), std::vector<float>(3, 0.0f));
}

TEST(SurfelArea, of_degenerate_clouds_is_finite) {
  for (const auto& points : {std::vector<Vector3f>(50, Vector3f(1, 2, 3)),
                             std::vector<Vector3f>{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {1e6f, 0, 0}}})
    for (const float a : areas_of_flat(points)) EXPECT_TRUE(std::isfinite(a) && a >= 0) << a;
}

TEST(SurfelArea, refuses_bad_arguments) {
  const std::vector<Vector3f> points(5, Vector3f::Zero()), normals(4, Vector3f::UnitZ());
  EXPECT_THROW(estimate_surfel_areas(points, normals), Error);
  EXPECT_THROW(estimate_surfel_areas(points, points, {.neighbours = 5}), Error);
}
