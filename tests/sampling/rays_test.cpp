// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/hit_rule_internal.hpp"
#include "sampling_scenes.hpp"
#include "support/test.hpp"

namespace {

SamplingOptions rays(int per_beam) {
  SamplingOptions options;
  options.kind = SamplingKind::rays;
  options.rays_per_beam = per_beam;
  return options;
}

double solid_angle(const Scatterers& s) {
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) sum += s.projected_area[i] / (s.range[i] * s.range[i]);
  return sum;
}

double solid_angle(const Sector& s) {
  constexpr int steps = 10000;
  const double step = (s.max_azimuth - s.min_azimuth) / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double cone = s.min_azimuth + (k + 0.5) * step;
    const auto [low, high] = turns_between(cone, s.min_elevation, s.max_elevation);
    sum += std::cos(cone) * step * (high - low);
  }
  return sum;
}

}  // namespace

TEST(Sampling, of_an_enclosing_sphere_fills_the_solid_angle_of_the_fan) {
  SceneCloud scene;
  add_sphere(scene, {0.4, -0.3, 0.2}, 3, 40000, -1);
  for (const double elevation : {0.0, -0.6}) {
    const BeamFan fan = make_fan(64, radians(70), radians(1), radians(20), elevation);
    const double expected = solid_angle(insonified_sector(fan, radians(20)));
    for (const SamplingOptions& options : {unsplit(), rays(64), SamplingOptions{}}) {
      const Sampling sampling = find_scatterers(scene, at(0, 0, 0, 33, 12), fan, long_gate(), options);
      EXPECT_NEAR(solid_angle(sampling.scatterers), expected, 0.02 * expected);
      EXPECT_EQ(sampling.report.rays_missed, 0u);
    }
  }
}

TEST(Rays, hit_a_plane_at_its_range_down_to_grazing_incidence) {
  SceneCloud scene;
  add_rectangle(scene, {0.5, -10, 0}, {40, 0, 0}, {0, 20, 0}, {0, 0, 1}, 0.08, 0.5);
  const Sampling sampling = find_scatterers(
      scene, at(0, 0, 2), make_fan(32, radians(40), radians(1), radians(16), radians(-12)), {0.1, 30, 0.05}, rays(128));
  std::vector<double> error;
  for (std::size_t i = 0; i < sampling.scatterers.size(); ++i)
    error.push_back(std::abs(sampling.scatterers.range[i] * std::sin(-sampling.scatterers.elevation[i]) / 2 - 1));
  ASSERT_GT(error.size(), 1000u);
  std::sort(error.begin(), error.end());
  EXPECT_LT(error[error.size() / 2], 1e-5);
  EXPECT_LT(error[error.size() * 99 / 100], 1e-4);
}

TEST(Rays, hit_only_the_nearer_of_two_walls) {
  SceneCloud scene;
  add_wall(scene, 4, 5, 3, 0.05, 0.3);
  add_wall(scene, 6, 5, 3, 0.05, 0.3);
  const BeamFan fan = make_fan(32, radians(40), radians(1), radians(20));
  const Sampling sampling = find_scatterers(scene, at(0, 0, 0), fan, long_gate(), rays(64));
  EXPECT_EQ(sampling.report.rays_missed, 0u);
  EXPECT_EQ(sampling.scatterers.size(), 32u * 64u);
  const Scatterers& s = sampling.scatterers;
  for (std::size_t i = 0; i < s.size(); ++i)
    ASSERT_NEAR(s.range[i] * std::cos(s.elevation[i]) * std::cos(s.azimuth[i]), 4, 1e-4);
}

TEST(Rays, that_meet_a_back_give_no_echo_and_are_not_missed) {
  SceneCloud scene;
  add_sphere(scene, {0, 0, 0}, 1, 4000);  // the head is inside, normals point away from it
  const Sampling sampling = find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), rays(16));
  EXPECT_EQ(sampling.scatterers.size(), 0u);
  EXPECT_EQ(sampling.report.rays_missed, 0u);
}

TEST(Rays, that_meet_a_back_just_before_a_face_are_blocked) {
  const auto surfel = [](float x, float y, bool facing) {
    const Eigen::Vector3f position(x, y, 0);
    return GatedSurfel{position, position.norm(), {1, 0, 0}, x, 0.2f, 0.065f, 0.1f, 0.1f, 0, 0, true, facing};
  };
  const auto fate = [](const GatedSurfels& surfels) {
    std::vector<std::uint32_t> both = {0, 1};
    RayHit hit;
    return hit_surface(surfels, {1, 0, 0}, true, both, hit);
  };
  EXPECT_EQ(fate({surfel(5, 0, false), surfel(5.1f, 0.05f, true)}), RayOutcome::blocked);
  EXPECT_EQ(fate({surfel(5, 0.05f, true), surfel(5.1f, 0, false)}), RayOutcome::hit);
}

TEST(Sampling, keeps_the_material_of_each_surfel) {
  SceneCloud scene;
  add_wall(scene, 4, 5, 3, 0.1);
  scene.materials = {{.name = "mud"}, {.name = "rock"}};
  for (std::size_t i = 0; i < scene.size(); i += 3) scene.material[i] = 1;
  const BeamFan fan = make_fan(16, radians(40), radians(1), radians(10));
  for (const SamplingOptions& options : {unsplit(), rays(64)}) {
    const Scatterers s = find_scatterers(scene, at(0, 0, 0), fan, long_gate(), options).scatterers;
    EXPECT_GT(std::count(s.material.begin(), s.material.end(), 1), 100);
    for (std::size_t i = 0; i < s.size(); ++i) ASSERT_EQ(s.material[i], scene.material[s.surfel[i]]);
  }
}

TEST(Rays, meet_the_facing_side_of_a_thin_plate) {
  SceneCloud scene;
  add_rectangle(scene, {4, -3, -3}, {0, 6, 0}, {0, 0, 6}, {-1, 0, 0}, 0.1, 0.5);
  add_rectangle(scene, {4.02, -3, -3}, {0, 6, 0}, {0, 0, 6}, {1, 0, 0}, 0.1, 0.5);
  const BeamFan fan = make_fan(16, radians(40), radians(1), radians(10));
  const Scatterers s = find_scatterers(scene, at(0, 0, 0), fan, long_gate(), rays(64)).scatterers;
  EXPECT_EQ(s.size(), 16u * 64u);
  for (std::size_t i = 0; i < s.size(); ++i)
    ASSERT_NEAR(s.range[i] * std::cos(s.elevation[i]) * std::cos(s.azimuth[i]), 4, 1e-4);
}

// A plate ends at y = 0, half a spacing beyond its outermost centres. Its discs of 1.2 spacings extend farther; echoes
// must not.
TEST(Rays, that_miss_a_surface_at_its_edge_hit_the_one_behind) {
  constexpr double spacing = 0.1;
  for (const double jitter : {0.0, 0.3}) {
    SceneCloud scene;
    add_rectangle(scene, {4, -3, -2}, {0, 3, 0}, {0, 0, 4}, {-1, 0, 0}, spacing, jitter);
    add_wall(scene, 8, 6, 4, spacing, jitter);
    const BeamFan fan = make_fan(64, radians(30), radians(0.5), radians(10));
    const Scatterers s = find_scatterers(scene, at(0, 0, 0), fan, long_gate(), rays(128)).scatterers;
    std::size_t close = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double beyond = 4 * std::tan(s.azimuth[i]) / spacing;
      const double x = s.range[i] * std::cos(s.elevation[i]) * std::cos(s.azimuth[i]);
      if (beyond < -0.3 - jitter) {
        ASSERT_NEAR(x, 4, 1e-3) << beyond;
      }
      if (beyond > 0.25 + jitter) {
        ASSERT_NEAR(x, 8, 1e-3) << beyond;
      }
      close += beyond > 0.25 + jitter && beyond < 0.7;
    }
    EXPECT_GT(close, 50u);
  }
}

TEST(Rays, have_ids_that_are_unique_in_a_ping_and_bound_to_their_surfel) {
  SceneCloud scene;
  add_wall(scene, 4, 3, 3, 0.5);
  const Scatterers s = find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), rays(32)).scatterers;
  EXPECT_EQ(std::set(s.id.begin(), s.id.end()).size(), s.size());
  for (std::size_t i = 0; i < s.size(); ++i) ASSERT_EQ(s.id[i] >> 32, scene.id[s.surfel[i]]);
}

TEST(Rays, give_the_mean_cross_section_that_surfels_give) {
  // Sum of projected area times cosine: the Lambert cross-section of the visible surface, without mu.
  SceneCloud scene;
  add_rectangle(scene, {2, -8, -2}, {14, 0, 0}, {0, 16, 0}, {0, 0, 1}, 0.06, 0.5);
  add_sphere(scene, {6, 0, -1}, 0.8, 4000);
  const BeamFan fan = make_fan(64, radians(40), radians(1), radians(15));
  const auto cross_section = [&](const SamplingOptions& options) {
    const Scatterers s = find_scatterers(scene, at(0, 0, 0, 0, 15), fan, {0.1, 12, 0.05}, options).scatterers;
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i) sum += s.projected_area[i] * s.cos_incidence[i];
    return sum;
  };
  const double surfels = cross_section(unsplit());
  EXPECT_NEAR(cross_section(rays(256)), surfels, 0.03 * surfels);
  EXPECT_NEAR(cross_section({}), surfels, 0.01 * surfels);
}
