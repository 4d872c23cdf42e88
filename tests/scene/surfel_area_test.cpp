// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/surfel_area.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/scene_index.hpp"

using namespace insonify;
using Eigen::Vector3f;

namespace {

double sum_of(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Returns a plate of 3 m x 2 m with one point per cell of `spacing`, off its centre by up to `jitter` spacings.
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

// Apart, and one above the other.
TEST(SurfelArea, of_two_plates_is_that_of_each) {
  for (const Vector3f& by : {Vector3f(0.3f, 0.2f, 0.4f), Vector3f(0.025f, 0.025f, 0.06f)}) {
    std::vector<Vector3f> points = plate(0.05f, 0);
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(points[i] + by);
    EXPECT_NEAR(sum_of(areas_of_flat(points)), 12.0, 12.0 * 0.02) << by.transpose();
  }
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

namespace {

// Returns plane normals of 32 neighbours, as load_scene gives them.
std::vector<Vector3f> base_normals(const std::vector<Vector3f>& points) {
  const SceneIndex index(points);
  std::vector<Neighbour> nearest;
  std::vector<Vector3f> normals;
  for (const Vector3f& p : points) {
    index.find_nearest(p, 32, nearest);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Neighbour& n : nearest) mean += points[n.index].cast<double>() / static_cast<double>(nearest.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Neighbour& n : nearest) {
      const Eigen::Vector3d d = points[n.index].cast<double>() - mean;
      moments += d * d.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
    normals.push_back(solver.eigenvectors().col(0).cast<float>());
  }
  return normals;
}

struct FieldCase {
  const char* name;
  double (*height)(double, double);
  double dx, dy, jitter, length, width;
  double tolerance_plan, tolerance_area;
};

// Returns waves from eight directions, 8 to 12 spacings of 2 cm long, with slopes to 70 degrees.
double stones(double x, double y) {
  double height = 0;
  for (int k = 0; k < 8; ++k) {
    const double direction = 2.4 * k + 0.3, wavenumber = 2 * pi / (0.16 * (1 + 0.07 * k));
    height += 0.57 / wavenumber * std::sin(wavenumber * (x * std::cos(direction) + y * std::sin(direction)) + k * k);
  }
  return height;
}

}  // namespace

TEST(SurfelShapes, of_a_height_field_cover_its_plan_and_its_surface) {
  const FieldCase fields[] = {
      {"plane", [](double, double) { return 0.0; }, 0.02, 0.02, 0.8, 2, 2, 0.01, 0.02},
      {"scan lines 1:10", [](double, double) { return 0.0; }, 0.01, 0.1, 0, 2, 2, 0.01, 0.02},
      {"60 degrees", [](double x, double) { return 0.35 * std::sin(5 * x); }, 0.02, 0.02, 0.5, 2, 2, 0.01, 0.02},
      {"84 degrees, tilted", [](double x, double) { return 9.5 * x; }, 0.005, 0.02, 0.5, 1, 1, 0.01, 0.02},
      {"84 degrees, wave, stretched", [](double x, double) { return std::sin(9.5 * x); }, 0.0005, 0.005, 0.5, 1, 0.3,
       0.01, 0.02},
      {"stones", stones, 0.02, 0.02, 0.3, 2.4, 2.4, 0.01, 0.02}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> half(-0.5, 0.5);
  for (const FieldCase& f : fields) {
    std::vector<Vector3f> points;
    for (double x = f.dx / 2; x < f.length; x += f.dx)
      for (double y = f.dy / 2; y < f.width; y += f.dy) {
        const double a = x + f.jitter * f.dx * half(random), b = y + f.jitter * f.dy * half(random);
        points.push_back(Eigen::Vector3d(a, b, f.height(a, b)).cast<float>());
      }
    const SurfelShapes shapes = estimate_surfel_shapes(points, base_normals(points));
    // True areas by class of slope, 20 degrees each, of the whole field and of its estimate.
    double total = 0, area = 0, plan = 0, true_class[5] = {}, found_class[5] = {};
    const double step = 0.004, e = 1e-5;
    for (double x = step / 2; x < f.length; x += step)
      for (double y = step / 2; y < f.width; y += step) {
        const double u = (f.height(x + e, y) - f.height(x - e, y)) / (2 * e);
        const double v = (f.height(x, y + e) - f.height(x, y - e)) / (2 * e), stretch = std::sqrt(1 + u * u + v * v);
        total += step * step * stretch;
        true_class[static_cast<int>(degrees(std::acos(1 / stretch)) / 20)] += step * step * stretch;
      }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double cosine = std::abs(shapes.normal[i].z());
      area += shapes.area[i];
      plan += shapes.area[i] * cosine;
      found_class[std::min(4, static_cast<int>(degrees(std::acos(std::min(1.0, cosine))) / 20))] += shapes.area[i];
    }
    EXPECT_NEAR(plan / (f.length * f.width), 1, f.tolerance_plan) << f.name;
    EXPECT_NEAR(area / total, 1, f.tolerance_area) << f.name;
    EXPECT_EQ(shapes.strays, 0u) << f.name;
    for (int c = 0; c < 5; ++c) {
      if (true_class[c] < 0.1 * total) continue;
      EXPECT_NEAR(found_class[c] / true_class[c], 1, 0.05) << f.name << ", class " << c;
    }
  }
}

TEST(SurfelShapes, cut_strays_down_and_count_them) {
  std::vector<Vector3f> points;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      points.emplace_back(0.02f * static_cast<float>(i), 0.02f * static_cast<float>(j), 0.0f);
  const std::size_t plate = points.size();
  for (int k = 0; k < 5; ++k)
    points.emplace_back(0.2f * static_cast<float>(k), 0.3f, 0.7f + 0.1f * static_cast<float>(k % 2));
  const SurfelShapes shapes = estimate_surfel_shapes(points, std::vector<Vector3f>(points.size(), Vector3f(0, 0, 1)));
  for (std::size_t i = plate; i < points.size(); ++i) EXPECT_LT(shapes.area[i], 4 * 0.0004) << i;
  EXPECT_NEAR(std::accumulate(shapes.area.begin(), shapes.area.begin() + plate, 0.0), 1.44, 0.02);
}

// Noise is not relief: 2 % of a plane's area for a standard deviation of one spacing, where its triangulation has 60 %
// more.
TEST(SurfelShapes, of_a_noisy_plane_are_those_of_the_plane) {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  for (const float noise : {0.005f, 0.01f, 0.02f}) {
    std::vector<Vector3f> points = plate(0.02f, 0.4f);
    for (Vector3f& p : points) p.z() = noise * normal(random);
    const SurfelShapes shapes = estimate_surfel_shapes(points, base_normals(points));
    EXPECT_NEAR(sum_of(shapes.area), 6, 0.02 * 6) << noise;
  }
}

// Around a point of a raster with lines 1 : 5 apart stand but three lines, through which there is no cubic.
TEST(SurfelShapes, know_noise_on_lines_far_apart) {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  const auto noisy_of = [&](float noise) {
    std::vector<Vector3f> points;
    for (int i = 0; i < 60; ++i)
      for (int j = 0; j < 300; ++j) {
        const float x = 0.05f * static_cast<float>(i), y = 0.01f * static_cast<float>(j);
        points.push_back({x, y, 0.03f * std::sin(6 * x) * std::cos(5 * y) + noise * normal(random)});
      }
    const SurfelShapes shapes = estimate_surfel_shapes(points, base_normals(points));
    return static_cast<double>(
               std::count_if(shapes.height_noise.begin(), shapes.height_noise.end(), [](float s) { return s > 0; })) /
           static_cast<double>(points.size());
  };
  EXPECT_LT(noisy_of(0), 0.05);
  EXPECT_GT(noisy_of(0.015f), 0.95);
}

// A viewpoint that only orients the normals of a raster of heights does not make it a scan.
TEST(SurfelShapes, of_a_raster_of_heights_do_not_depend_on_the_viewpoint) {
  std::vector<Vector3f> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const float x = 0.02f * static_cast<float>(i), y = 0.02f * static_cast<float>(j);
      points.push_back({x, y, 0.05f * std::sin(20 * x) * std::cos(15 * y)});
    }
  const auto base = base_normals(points);
  EXPECT_EQ(estimate_surfel_shapes(points, base, {.viewpoint = Eigen::Vector3d(0.4, 0.4, 3)}).area,
            estimate_surfel_shapes(points, base).area);
}

// A plane seen aslant from one position, in steps of range of two to four spacings: its area, not that of the steps.
TEST(SurfelShapes, of_points_seen_at_once_are_those_of_their_solid_angles) {
  const Eigen::Vector3d across = Eigen::Vector3d(-1, 0.7, 0.3).normalized();
  const double step = radians(0.25), quantum = 0.05;
  std::vector<Vector3f> points;
  double area = 0;
  for (int i = -60; i < 60; ++i)
    for (int j = -80; j < 80; ++j) {
      const double elevation = step * (i + 0.5), azimuth = step * (j + 0.5);
      const Eigen::Vector3d d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
      const double cosine = -across.dot(d), range = 3 / cosine;
      area += step * step * std::cos(elevation) * range * range / cosine;
      points.push_back((quantum * std::round(range / quantum) * d).cast<float>());
    }
  const auto base = base_normals(points);
  EXPECT_NEAR(sum_of(estimate_surfel_shapes(points, base, {.viewpoint = Eigen::Vector3d::Zero()}).area) / area, 1,
              0.03);
}
