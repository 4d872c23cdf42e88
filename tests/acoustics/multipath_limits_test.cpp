// SPDX-License-Identifier: BSD-3-Clause
// Tests the limits of bounced echoes: boundaries, rough water, the gate; and refusals.
#include "acoustics/bounced_target.hpp"
#include "acoustics/reflection.hpp"
#include "scene/built_in_scenes.hpp"

// The captured seabed coincides with the flat bottom: it must not hide bounced legs.
TEST(MultipathEchoes, treats_captured_points_at_a_boundary_as_the_boundary) {
  Setting s = one_target();
  for (double x = 1; x < 25; x += 0.1)
    for (double y = -2; y <= 2; y += 0.1) add_surfel(s.scene, {x, y, -10 + 0.1 * std::sin(3 * x)}, {0, 0, 1}, 0.01);
  s.environment.surface.reset();
  EXPECT_EQ(s.compute().echoes.size(), 3u);                           // of the target alone
  EXPECT_EQ(s.compute({.boundary_tolerance = 0}).echoes.size(), 0u);  // crests before and behind the bounce
}

TEST(MultipathEchoes, gives_no_echo_from_beyond_a_boundary) {
  Setting above = one_target({20, 0, 1}), below = one_target({20, 0, -11});
  EXPECT_EQ(above.compute().echoes.size(), 0u);
  EXPECT_EQ(below.compute().one_bounce, 2u);  // by the surface: the scene may go deeper than the flat bottom
}

TEST(MultipathEchoes, surfels_buried_in_the_bottom_hide_nothing) {
  Setting s = one_target();
  const auto bounce = sum_at(s.compute().echoes, r_bottom);
  add_plate(s.scene, 15, -16, -11);  // where the leg to the image below the bottom passes
  EXPECT_LT(std::abs(sum_at(s.compute().echoes, r_bottom) - bounce), 1e-9 * std::abs(bounce));
}

TEST(MultipathEchoes, keeps_the_power_of_a_patch_that_is_split) {
  const auto power = [](const Echoes& e) {
    double sum = 0;
    for (const std::complex<double>& a : e.amplitude) sum += std::norm(a);
    return sum;
  };
  Setting s = one_target();
  const Echoes whole = s.compute().echoes;
  s.view.sampling.scatterers_per_cell = 20000;
  const Echoes split = s.compute().echoes;
  EXPECT_GT(split.size(), 3 * whole.size());
  EXPECT_NEAR(power(split) / power(whole), 1, 1e-3);
}

TEST(MultipathEchoes, keeps_the_gate_by_apparent_range) {
  Setting s = one_target();
  s.view.gate.max_range = 22;
  const Echoes e = s.compute().echoes;
  EXPECT_NE(sum_at(e, r_surface), 0.0);
  for (const double delay : e.delay) EXPECT_LT(750 * delay, 22.1);
  // The bottom's leg is 25 m long, but its mean with the direct one lies inside.
  s.view.gate.max_range = 22.6;
  EXPECT_NE(sum_at(s.compute().echoes, 0.5 * (r_direct + r_bottom)), 0.0);
}

TEST(MultipathEchoes, rough_water_removes_the_bounce_and_reports_it) {
  Setting s = one_target();
  s.environment.bottom.reset();
  EXPECT_EQ(strongest_bounce(s.environment, s.view, s.sent), 1);
  s.environment.wind_speed = 8;
  EXPECT_LT(strongest_bounce(s.environment, s.view, s.sent), 1e-4);
  EXPECT_EQ(s.compute().echoes.size(), 0u);
  s.environment.surface->rms_height = 1e-4;
  const double k = 2 * pi * 900e3 / 1500, left = coherent_reflection_loss(k, 1e-4, std::asin(5 / r_surface));
  EXPECT_LE(left, strongest_bounce(s.environment, s.view, s.sent));
  const double rough = std::abs(sum_at(s.compute().echoes, r_surface));
  s.environment.surface->rms_height = 0;
  EXPECT_NEAR(rough / std::abs(sum_at(s.compute().echoes, r_surface)), left * left, 1e-6);
}

TEST(MultipathEchoes, rough_bottom_sends_back_its_coherent_part_alone) {
  Setting s = one_target();
  s.environment.surface.reset();
  const double smooth = std::abs(sum_at(s.compute().echoes, r_bottom));
  s.environment.bottom->rms_height = 1e-4;
  const double left = coherent_reflection_loss(2 * pi * 900e3 / 1500, 1e-4, std::asin(15 / r_bottom));
  EXPECT_NEAR(std::abs(sum_at(s.compute().echoes, r_bottom)) / smooth, left * left, 1e-6);
  EXPECT_LT(left, 0.91);
}

TEST(MultipathEchoes, of_rays_takes_whole_surfels) {
  Setting s = one_target();
  const Echoes surfels = s.compute().echoes;
  s.view.sampling.kind = SamplingKind::rays;
  const Echoes rays = s.compute().echoes;
  ASSERT_EQ(rays.size(), 8u);
  for (const double range : {0.5 * (r_direct + r_surface), r_bottom})
    EXPECT_LT(std::abs(sum_at(rays, range) / sum_at(surfels, range) - 1.0), 1e-6);
}

TEST(MultipathEchoes, does_not_depend_on_the_thread_count) {
  Setting s;
  s.scene = make_built_in_scene("harbour", {.points = 20000});
  s.environment.bottom->height = -8;
  s.view.world_from_head = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  s.view.sampling.scatterers_per_cell = 1;
  s.sent.echo_options = {.elevation_width = radians(20)};
  Multipath first;
  for (const int threads : {1, 2, 7}) {
    s.view.sampling.threads = s.sent.echo_options.threads = threads;
    const Multipath m = s.compute();
    if (threads == 1) {
      first = m;
      EXPECT_GT(m.one_bounce, 1000u);
      EXPECT_GT(m.two_bounces, 1000u);
      EXPECT_GT(m.blocked, 100u);
    }
    EXPECT_EQ(m.echoes.delay, first.echoes.delay);
    EXPECT_EQ(m.echoes.amplitude, first.echoes.amplitude);
    EXPECT_EQ(m.echoes.u, first.echoes.u);
    EXPECT_EQ(m.two_bounces, first.two_bounces);
    EXPECT_EQ(m.blocked, first.blocked);
  }
}

TEST(MultipathEchoes, refuses_invalid_arguments) {
  Setting s = one_target();
  const auto refused = [](Setting changed) { return error_of([&] { changed.compute(); }); };
  Setting none = s;
  none.environment.surface.reset();
  none.environment.bottom.reset();
  EXPECT_EQ(refused(none), "multipath_echoes: environment has neither surface nor bottom, must have one of them");
  Setting flying = s;
  flying.view.world_from_head.translation().z() = 1;
  EXPECT_EQ(refused(flying), "multipath_echoes: the head stands at height 1 m, must be below surface.height = 0 m");
  Setting buried = s;
  buried.view.world_from_head.translation().z() = -10;
  EXPECT_EQ(refused(buried), "multipath_echoes: the head stands at height -10 m, must be above bottom.height = -10 m");
  EXPECT_THAT(error_of([&] { s.compute({.boundary_tolerance = -1}); }),
              HasSubstr("options.boundary_tolerance = -1 m, must be finite and >= 0"));
  Scatterers wrong = s.direct();
  wrong.surfel[0] = 5;
  EXPECT_THAT(error_of([&] { multipath_echoes(s.scene, wrong, s.environment, s.view, s.sent); }),
              HasSubstr("direct.surfel = 5, but the scene has 1 surfels"));
}

// Two targets far apart, the farther one first in the scene.
TEST(MultipathEchoes, reports_surfel_and_legs_of_every_echo) {
  Setting s;
  s.scene.materials = {{"m", mu}};
  add_surfel(s.scene, {40, 0, -3}, {-1, 0, 0}, target_area);
  add_surfel(s.scene, target, {-1, 0, 0}, target_area);
  const Multipath m = s.compute();
  ASSERT_EQ(m.echoes.size(), 16u);
  ASSERT_EQ(m.surfel.size(), 16u);
  ASSERT_EQ(m.legs.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(m.surfel[i], 750 * m.echoes.delay[i] > 30 ? 0u : 1u);
    if (m.surfel[i] != 1) continue;
    const double length[] = {r_direct, r_surface, r_bottom}, height[] = {-1, 5, -15};
    EXPECT_NEAR(1500 * m.echoes.delay[i], length[m.legs[i].out] + length[m.legs[i].back], 1e-9);
    EXPECT_NEAR(m.echoes.v[i], height[m.legs[i].back] / length[m.legs[i].back], 1e-9);
  }
  EXPECT_EQ(std::count_if(m.legs.begin(), m.legs.end(), [](LegPair w) { return w.bounces() == 1; }),
            static_cast<std::ptrdiff_t>(m.one_bounce));
  EXPECT_EQ(std::count_if(m.legs.begin(), m.legs.end(), [](LegPair w) { return w.bounces() == 2; }),
            static_cast<std::ptrdiff_t>(m.two_bounces));
}
