// SPDX-License-Identifier: BSD-3-Clause
// Compares echoes by boundaries, mirrors and targets in a profile with rays that are integrated over distance.
#include "acoustics/refracted_bench.hpp"
#include "core/text.hpp"
#include "support/bounced_ray.hpp"
#include "support/scenes.hpp"

namespace insonify::bent_bounces {

using Eigen::Vector3d;

SceneCloud patch_at(const Vector3d& position, const Vector3d& normal) {
  SceneCloud scene;
  scene.origin = position;
  scene.materials = {Material{}};
  add_surfel(scene, position, normal, 1e-4);
  return scene;
}

/// Expects the echo that went out directly and came back by an image to agree with the rays.
void expect_mixed(const Bench& b, const Multipath& found, const SceneCloud& scene, const traced::Water& to_image,
                  const Vector3d& image, const Vector3d& image_normal, const std::string& what) {
  const Vector3d position = scene.origin;
  const traced::Arrival direct = b.ray(b.water(), position), bounced = b.ray(to_image, image);
  ASSERT_EQ(found.one_bounce, 2u) << what;
  for (std::size_t k = 0; k < found.legs.size(); ++k) {
    if (found.legs[k].out != 0 || found.legs[k].back == 0) continue;
    EXPECT_NEAR(found.echoes.delay[k], direct.time + bounced.time, 0.01 / b.speed) << what;
    const Vector3d from = b.beam_azimuth(image, bounced.launch);
    EXPECT_NEAR(found.echoes.u[k], from.y(), radians(0.1)) << what;
    EXPECT_NEAR(found.echoes.v[k], from.z(), radians(0.1)) << what;
    const auto along = [&](const Vector3d& to, double arrival) -> Vector3d {
      const Vector3d way = to - b.head();
      const Vector3d level = Vector3d(way.x(), way.y(), 0).normalized();
      return std::cos(arrival) * level + std::sin(arrival) * Vector3d::UnitZ();
    };
    const double cosines = scene.normal[0].cast<double>().dot(along(position, direct.arrival)) *
                           image_normal.dot(along(image, bounced.arrival));
    const double expected = source_pressure(b.sent.pulse) *
                            std::sqrt(Material{}.lambert_mu * 1e-4 * cosines * direct.intensity * bounced.intensity);
    EXPECT_NEAR(db_from_amplitude(std::abs(found.echoes.amplitude[k]) / expected), 0, 0.1) << what;
  }
}

TEST(BentBounces, ghosts_in_a_wall_and_echoes_by_the_surface_are_where_rays_put_them) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const SoundSpeedProfile& profile : thermoclines)
    for (int k = 0; k < 12; ++k) {
      Bench b(profile, 2 + 12 * unit(random), 6 * unit(random), 0.4 * unit(random) - 0.2, 0.6 * unit(random) - 0.3);
      const double bearing = 1.2 * unit(random) - 0.6, out = 12 + 14 * unit(random), depth = 1 + 20 * unit(random);
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const double to = std::atan2(ahead.y(), ahead.x()) + bearing;
      const Vector3d position = b.head() + Vector3d(out * std::cos(to), out * std::sin(to), b.head_depth - depth);
      const SceneCloud scene = patch_at(position, (b.head() - position).normalized());
      const Scatterers direct = scatterers_at({b.view.world_from_head.inverse() * position}, 1e-4F);
      const std::string what = printed("head %.3g m deep, place %.3g m deep and %.3g m off", b.head_depth, depth, out);
      const Vector3d normal = scene.normal[0].cast<double>();

      // A wall to one side stands upright but turned.
      const Vector3d side(-std::sin(to + 0.2), std::cos(to + 0.2), 0);
      Mirror wall;
      wall.position = b.head() - 5 * side, wall.normal = side;
      const MirrorPlane plane(side, wall.position);
      const auto mirrored = [&](const Vector3d& p) -> Vector3d { return p - 2 * plane.signedDistance(p) * side; };
      if (plane.signedDistance(position) > 1)
        expect_mixed(
            b, mirror_echoes(scene, direct, b.environment, {&wall, 1}, false, b.view, b.sent, {.refraction = true}),
            scene, b.water(), mirrored(position), normal - 2 * normal.dot(side) * side, "wall, " + what);

      Environment sea = b.environment;
      sea.surface = SeaSurface{};
      sea.surface->height = 0, sea.surface->rms_height = 0;
      const Vector3d image(position.x(), position.y(), -position.z()),
          image_normal(normal.x(), normal.y(), -normal.z());
      expect_mixed(b, multipath_echoes(scene, direct, sea, b.view, b.sent, {.refraction = true}), scene,
                   b.with_surface(), image, image_normal, "surface, " + what);
    }
}

TEST(BentBounces, targets_and_glints_are_where_rays_put_them) {
  for (const SoundSpeedProfile& profile : thermoclines)
    for (const double depth : {3.0, 8.0}) {
      Bench b(profile, depth, 0.3, 0.1, -0.2);
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const Vector3d middle = b.head() + 35 * Vector3d(ahead.x(), ahead.y(), 0).normalized() + Vector3d(1, 2, -6);
      SceneCloud scene;
      scene.materials = {Material{"steel"}};
      scene.materials[0].coherent = 1;
      add_sphere(scene, middle, 0.3, 4000);
      const Echoes straight =
          glint_echoes(scene, fit_shapes(scene, b.head(), 100), b.environment, false, b.view, b.sent);
      const Echoes sphere = glint_echoes(scene, fit_shapes(scene, b.head(), 100), b.environment, false, b.view, b.sent,
                                         {.refraction = true});
      ASSERT_EQ(sphere.size(), 1u);
      const traced::Arrival ray = b.ray(b.water(), middle);
      const double at = 0.5 * b.speed * sphere.delay[0],
                   expected = b.speed * (ray.time - 0.3 / sound_speed_at(profile, -middle.z()));
      EXPECT_NEAR(at, expected, 0.01);
      const Vector3d from = b.beam_azimuth(middle, ray.launch);
      EXPECT_NEAR(sphere.u[0], from.y(), radians(0.1));
      EXPECT_NEAR(sphere.v[0], from.z(), radians(0.1));
      const double change_db = db_from_amplitude(std::abs(sphere.amplitude[0] / straight.amplitude[0]));
      EXPECT_NEAR(change_db, db_from_amplitude(ray.intensity * (middle - b.head()).squaredNorm()), 0.15);  // both ways

      // A wall ahead shows the head's own image, at its depth.
      Mirror wall;
      const Vector3d level = Vector3d(ahead.x(), ahead.y(), 0).normalized();
      wall.position = b.head() + 15 * level, wall.normal = -level;
      SceneCloud none;
      none.materials = {Material{}};
      const Echoes glint = glint_echoes(none, {{wall}, {}}, b.environment, false, b.view, b.sent, {.refraction = true});
      ASSERT_EQ(glint.size(), 1u);
      const Vector3d image = b.head() + 30 * level;
      const traced::Arrival there = b.ray(b.water(), image);
      EXPECT_NEAR(glint.delay[0], there.time, 0.01 / b.speed);
      EXPECT_NEAR(glint.v[0], b.beam_azimuth(image, there.launch).z(), radians(0.1));
    }
}

}  // namespace insonify::bent_bounces
