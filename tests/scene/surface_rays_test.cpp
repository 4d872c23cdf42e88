// SPDX-License-Identifier: BSD-3-Clause
// Tests rays from surface to surface: against a search over all discs, areas at edges, backs and noise.
#include "scene/surface_rays.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"

using namespace insonify;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr double footprint = 1.2;

/// Adds the surfels of a square of 1 m about `middle`, jittered within their cells.
void add_square(SceneCloud& scene, const Vector3d& middle, const Vector3d& normal, int per_side) {
  const Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  for (int i = 0; i < per_side * per_side; ++i) {
    const auto u = random_uniform(3, RandomStage::scene_points, {scene.size(), 0, 0});
    add_surfel(
        scene,
        middle + ((i % per_side + u[0]) / per_side - 0.5) * along + ((i / per_side + u[1]) / per_side - 0.5) * across,
        normal, 1.0 / (per_side * per_side));
  }
}

SurfaceRay ray_from(const Vector3d& from, const Vector3d& direction, std::uint32_t surfel = SurfaceRayEnd::none - 1) {
  return {surfel, from.cast<float>(), direction.normalized().cast<float>()};
}

/// Returns the nearest disc in front of a ray, found among all.
SurfaceRayEnd nearest_of_all(const SceneCloud& scene, const SurfaceRay& ray) {
  SurfaceRayEnd hit{SurfaceRayEnd::none, std::numeric_limits<float>::infinity(), 0};
  for (std::uint32_t j = 0; j < scene.size(); ++j) {
    const float facing = scene.normal[j].dot(ray.direction);
    const float t = scene.normal[j].dot(scene.point[j] - ray.from) / facing;
    const float off = (ray.from + t * ray.direction - scene.point[j]).norm();
    if (j != ray.surfel && t > 0 && t < hit.distance && off <= footprint * std::sqrt(scene.area[j]))
      hit = {j, t, facing};
  }
  if (hit.density >= 0) hit.surfel = SurfaceRayEnd::none;  // none, or a back
  return hit;
}

}  // namespace

class SurfaceRaysTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  }
};

TEST_F(SurfaceRaysTest, meet_what_a_search_over_all_surfels_finds) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 4000});
  const SurfaceRays rays(scene, footprint);
  int met = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const auto u = random_uniform(5, RandomStage::ray_jitter, {k, 0, 0});
    const Vector3d direction(std::cos(2 * pi * u[0]), std::sin(2 * pi * u[0]), 2 * u[1] - 1);
    const Vector3f start = scene.point[static_cast<std::size_t>(u[2] * 4000)] + Vector3f(0, 0, 1.5f);
    const SurfaceRay ray = ray_from(start.cast<double>(), direction);
    const SurfaceRayEnd expected = nearest_of_all(scene, ray), found = rays.first_hit(ray);
    // A start within three radii behind a disc passes it: such starts are not compared.
    if (expected.surfel == SurfaceRayEnd::none && found.surfel != SurfaceRayEnd::none) continue;
    ASSERT_EQ(expected.surfel == SurfaceRayEnd::none, found.surfel == SurfaceRayEnd::none) << k;
    if (found.surfel == SurfaceRayEnd::none) continue;
    EXPECT_NEAR(found.distance, expected.distance, 1e-4f * expected.distance + 1e-5f) << k;
    const Vector3f at = ray.from + found.distance * ray.direction;
    EXPECT_LE((scene.point[found.surfel] - at).norm(), (scene.point[expected.surfel] - at).norm() + 1e-5f);
    ++met;
  }
  EXPECT_GT(met, 800);
}

// Areas: parallel rays onto a plate, far beyond its edges.
TEST_F(SurfaceRaysTest, density_integrates_to_the_area_of_a_plate) {
  SceneCloud scene;
  add_square(scene, {0, 0, 0}, {0, 0, 1}, 20);
  const SurfaceRays rays(scene, footprint);
  double area = 0, middle = 0;
  constexpr int n = 400;
  for (int i = 0; i < n * n; ++i) {
    const double x = 1.5 * ((i % n + 0.5) / n - 0.5), y = 1.5 * ((i / n + 0.5) / n - 0.5);
    const SurfaceRayEnd hit = rays.first_hit(ray_from({x - 1, y, 1}, {1, 0, -1}));
    if (hit.surfel == SurfaceRayEnd::none) continue;
    area += hit.density * 2.25 / (n * n);
    if (std::abs(x) < 0.4 && std::abs(y) < 0.4) middle += hit.density * 2.25 / (n * n) / 0.64;
  }
  EXPECT_NEAR(area, 1, 2e-3);
  EXPECT_NEAR(middle, 1, 0.02);
}

TEST_F(SurfaceRaysTest, do_not_pass_backs_nor_meet_their_own_surface) {
  SceneCloud scene;
  add_square(scene, {0, 0, 0}, {0, 0, 1}, 10);
  add_square(scene, {0, 0, 1}, {0, 0, 1}, 10);  // its back is turned to the first
  add_square(scene, {0, 0, 2}, {0, 0, -1}, 10);
  const SurfaceRays rays(scene, footprint);
  EXPECT_EQ(rays.first_hit(ray_from({0, 0, 0}, {0, 0, 1}, 55)).surfel, SurfaceRayEnd::none);
  const SurfaceRayEnd above = rays.first_hit(ray_from({0, 0, 1}, {0.1, 0, 1}, 155));
  ASSERT_NE(above.surfel, SurfaceRayEnd::none);
  EXPECT_GE(above.surfel, 200u);
  EXPECT_NEAR(above.distance, std::sqrt(1.01), 1e-4);

  // Over a surface whose points scatter across it by 2 mm, rays at a grazing angle reach the wall behind it.
  SceneCloud noisy;
  add_square(noisy, {0, 0, 0}, {0, 0, 1}, 30);
  noisy.noise.assign(noisy.size(), 2e-3f);
  for (std::size_t i = 0; i < noisy.size(); ++i)
    noisy.point[i].z() =
        static_cast<float>(2e-3 * random_complex_normal(9, RandomStage::scene_points, {i, 0, 0}).real());
  add_square(noisy, {0.6, 0, 0}, {-1, 0, 0}, 30);
  noisy.noise.resize(noisy.size(), 0);
  SceneCloud exact = noisy;
  exact.noise.clear();
  const SurfaceRays with(noisy, footprint), without(exact, footprint);
  int sent = 0, met = 0, met_as_exact = 0;
  for (std::uint32_t i = 0; i < 900; ++i) {
    if (noisy.point[i].x() > 0) continue;
    const SurfaceRay ray = ray_from(noisy.point[i].cast<double>(), {1, 0, 0.01}, i);
    ++sent, met += with.first_hit(ray).surfel != SurfaceRayEnd::none;
    met_as_exact += without.first_hit(ray).surfel != SurfaceRayEnd::none;
  }
  EXPECT_GT(met, 0.95 * sent);
  EXPECT_LT(met_as_exact, 0.6 * sent);
}

TEST_F(SurfaceRaysTest, of_no_surfels_and_of_one_meet_none) {
  SceneCloud scene;
  EXPECT_EQ(SurfaceRays(scene, footprint).first_hit(ray_from({0, 0, 0}, {0, 0, 1})).surfel, SurfaceRayEnd::none);
  add_surfel(scene, {0, 0, 0}, {0, 0, 1}, 1);
  EXPECT_EQ(SurfaceRays(scene, footprint).first_hit(ray_from({0, 0, 0}, {1, 0, 1}, 0)).surfel, SurfaceRayEnd::none);
}
