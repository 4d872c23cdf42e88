// SPDX-License-Identifier: BSD-3-Clause
// Compares legs and glints by tilted mirrors in a profile with rays shot in three dimensions and reflected.
#include <numeric>

#include "acoustics/refracted_bench.hpp"
#include "core/text.hpp"
#include "support/bounced_ray.hpp"
#include "support/scenes.hpp"

namespace insonify::bent_chains {

using bent_bounces::Bench;
using bent_bounces::thermoclines;
using Eigen::Vector3d;

/// Returns a wall that leans by 5 to 40 degrees, some metres beside a line of sight.
Mirror leaning_wall(const Vector3d& near, const Vector3d& side, double lean, double distance) {
  Mirror wall;
  wall.normal = std::cos(lean) * side + std::sin(lean) * Vector3d::UnitZ();
  wall.position = near - distance * wall.normal;
  return wall;
}

traced::Plane plane_from(const Vector3d& head, const Mirror& mirror) {
  const Vector3d normal = mirror.normal.normalized();
  return {normal, normal.dot(mirror.position - head)};
}

/// Expects delay, direction and level of an echo to agree with a ray that goes both ways.
void expect_glint(const Bench& b, const Echoes& glint, const traced::BouncedArrival& ray, const std::string& what) {
  ASSERT_EQ(glint.size(), 1u) << what;
  EXPECT_NEAR(glint.delay[0] * b.speed, ray.time * b.speed, 1e-3) << what;
  const Vector3d from = b.view.world_from_head.linear().transpose() * -ray.arrival;
  EXPECT_NEAR(glint.u[0], from.y(), radians(0.01)) << what;
  EXPECT_NEAR(glint.v[0], from.z(), radians(0.01)) << what;
  EXPECT_NEAR(
      db_from_amplitude(std::abs(glint.amplitude[0]) / (source_pressure(b.sent.pulse) * std::sqrt(ray.intensity))), 0,
      0.1)
      << what;
}

TEST(BentChains, legs_by_leaning_walls_are_rays_that_the_walls_reflect) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  int tried = 0;
  for (const SoundSpeedProfile& profile : thermoclines)
    for (int k = 0; k < 16; ++k) {
      Bench b(profile, 3 + 10 * unit(random), 6 * unit(random), 0.4 * unit(random) - 0.2, 0.6 * unit(random) - 0.3);
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const double to = std::atan2(ahead.y(), ahead.x()) + 0.6 * unit(random) - 0.3, out = 12 + 14 * unit(random);
      const Vector3d position =
          b.head() + Vector3d(out * std::cos(to), out * std::sin(to), b.head_depth - 1 - 20 * unit(random));
      const double port = unit(random) < 0.5 ? -1 : 1, up = unit(random) < 0.5 ? -1 : 1;
      const Vector3d side = port * Vector3d(-std::sin(to + 0.1), std::cos(to + 0.1), 0);
      const Mirror wall = leaning_wall(b.head(), side, up * radians(5 + 35 * unit(random)), 4);
      const traced::Plane plane = plane_from(b.head(), wall);
      if (plane.normal.dot(position - b.head()) - plane.offset < 1) continue;
      const auto direct = b.ray(b.water(), position);
      const auto bounced = traced::arrival_by_planes(b.water(), b.head_depth, {&plane, 1}, position - b.head());
      ASSERT_TRUE(bounced);

      SceneCloud scene;
      scene.origin = position;
      scene.materials = {Material{}};
      add_surfel(scene, position, ((b.head() - position).normalized() - bounced->arrival).normalized(), 1e-4);
      const Multipath found = mirror_echoes(scene, scatterers_at({b.view.world_from_head.inverse() * position}, 1e-4F),
                                            b.environment, {&wall, 1}, false, b.view, b.sent, {.refraction = true});
      const std::string what = printed("head %.3g m deep, wall %.3g %.3g %.3g", b.head_depth, wall.normal.x(),
                                       wall.normal.y(), wall.normal.z());
      ASSERT_EQ(found.one_bounce, 2u) << what;
      EXPECT_EQ(found.unreached, 0u);
      const Vector3d level = Vector3d((position - b.head()).x(), (position - b.head()).y(), 0).normalized();
      const Vector3d arrives = std::cos(direct.arrival) * level + std::sin(direct.arrival) * Vector3d::UnitZ();
      const Vector3d normal = scene.normal[0].cast<double>();
      const double cosines = normal.dot(arrives) * normal.dot(bounced->arrival);
      for (std::size_t e = 0; e < found.legs.size(); ++e) {
        if (found.legs[e].out != 0 || found.legs[e].back == 0) continue;
        EXPECT_NEAR(found.echoes.delay[e] * b.speed, (direct.time + bounced->time) * b.speed, 1e-3) << what;
        const Vector3d from = b.view.world_from_head.linear().transpose() * bounced->launch;
        EXPECT_NEAR(found.echoes.u[e], from.y(), radians(0.01)) << what;
        EXPECT_NEAR(found.echoes.v[e], from.z(), radians(0.01)) << what;
        const double power = Material{}.lambert_mu * 1e-4 * cosines * direct.intensity * bounced->intensity;
        EXPECT_NEAR(
            db_from_amplitude(std::abs(found.echoes.amplitude[e]) / (source_pressure(b.sent.pulse) * std::sqrt(power))),
            0, 0.1)
            << what;
        ++tried;
      }
    }
  EXPECT_GT(tried, 20);
}

TEST(BentChains, glints_of_leaning_walls_are_rays_that_the_walls_reflect) {
  SceneCloud none;
  none.materials = {Material{}};
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const SoundSpeedProfile& profile : thermoclines)
    for (int k = 0; k < 8; ++k) {
      Bench b(profile, 4 + 6 * unit(random), 6 * unit(random), 0, 0.6 * unit(random) - 0.3);
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const Mirror wall = leaning_wall(b.head(), -ahead, radians(40 * unit(random) - 20), 8 + 10 * unit(random));
      const traced::Plane plane = plane_from(b.head(), wall);
      const auto ray = traced::arrival_by_planes(b.water(), b.head_depth, {&plane, 1}, Vector3d::Zero());
      ASSERT_TRUE(ray);
      expect_glint(b, glint_echoes(none, {{wall}, {}}, b.environment, false, b.view, b.sent, {.refraction = true}),
                   *ray, printed("one wall, %d", k));
    }
}

TEST(BentChains, glints_by_way_of_the_surface_and_a_wall_too) {
  SceneCloud none;
  none.materials = {Material{}};
  for (const SoundSpeedProfile& profile : thermoclines)
    for (const double lean : {0.25, 0.4}) {
      Bench b(profile, 7, 0.7, 0.1, -0.2);
      b.environment.surface = SeaSurface{};
      b.environment.surface->height = 0, b.environment.surface->rms_height = 0;
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const Vector3d level = Vector3d(ahead.x(), ahead.y(), 0).normalized();
      const Mirror wall = leaning_wall(b.head(), -level, lean, 12);
      const traced::Plane planes[] = {plane_from(b.head(), wall), {-Vector3d::UnitZ(), -b.head_depth}};
      const auto ray = traced::arrival_by_planes(b.water(), b.head_depth, planes, Vector3d::Zero());
      ASSERT_TRUE(ray);
      const Echoes all = glint_echoes(none, {{wall}, {}}, b.environment, true, b.view, b.sent,
                                      {.most_bounces = 2, .refraction = true});
      // Among the direct glint and both orders of wall and surface: out by the wall, back from the surface.
      ASSERT_EQ(all.size(), 3u) << lean;
      const Vector3d from = b.view.world_from_head.linear().transpose() * -ray->arrival;
      std::size_t best = 0;
      for (std::size_t e = 0; e < all.size(); ++e)
        if (std::abs(all.v[e] - from.z()) + std::abs(all.delay[e] - ray->time) * b.speed <
            std::abs(all.v[best] - from.z()) + std::abs(all.delay[best] - ray->time) * b.speed)
          best = e;
      EXPECT_NEAR(all.delay[best] * b.speed, ray->time * b.speed, 1e-3) << lean;
      EXPECT_NEAR(all.v[best], from.z(), radians(0.01)) << lean;
      EXPECT_NEAR(db_from_amplitude(std::abs(all.amplitude[best]) /
                                    (source_pressure(b.sent.pulse) * std::sqrt(ray->intensity))),
                  0, 0.1)
          << lean;
    }
}

}  // namespace insonify::bent_chains
