// SPDX-License-Identifier: BSD-3-Clause
// Echoes by way of surface and bottom: images, formula, legs, and what must not change them.
#include "acoustics/bounced_target.hpp"
#include "acoustics/reflection.hpp"
#include "scene/built_in_scenes.hpp"

// Head 2 m and target 3 m deep, 20 m apart, in 10 m of water: apparent ranges and levels against the direct echo for
// equal cosines and without reflection factors, of an independent evaluation to two decimals.
TEST(MultipathEchoes, gives_the_textbook_images) {
  const Setting s = one_target();
  const Multipath m = s.compute();
  ASSERT_EQ(m.echoes.size(), 8u);
  EXPECT_EQ(m.one_bounce, 4u);
  EXPECT_EQ(m.two_bounces, 4u);
  EXPECT_EQ(m.blocked, 0u);
  const Echoes direct = direct_echoes(s.direct(), s.scene.materials, pulse_900k, s.sent.medium, s.sent.echo_options);
  const double direct_db = level_after_absorption(direct.amplitude[0], r_direct);

  const double bounce = std::abs(bottom_reflection(*s.environment.bottom, std::asin(15 / r_bottom)));
  struct {
    double out, back, apparent, level_db, reflections;
  } const expected[] = {{r_direct, r_surface, 20.3203, 5.59, 1},
                        {r_surface, r_surface, 20.6155, -0.86, 1},
                        {r_direct, r_bottom, 22.5125, 2.60, bounce},
                        {r_bottom, r_bottom, 25.0, -6.83, bounce * bounce}};
  for (const auto& e : expected) {
    const double range = 0.5 * (e.out + e.back),
                 cosines = (20 / e.out) * (20 / e.back) / ((20 / r_direct) * (20 / r_direct));
    EXPECT_NEAR(range, e.apparent, 6e-5);
    const double level = level_after_absorption(sum_at(m.echoes, range) / (e.reflections * std::sqrt(cosines)), range);
    EXPECT_NEAR(level - direct_db, e.level_db, 0.006) << range;
  }
  EXPECT_NEAR(*std::min_element(m.echoes.delay.begin(), m.echoes.delay.end()) - direct.delay[0], 393.7e-6, 5e-8);
}

// Every echo in full, phase and sign included.
TEST(MultipathEchoes, follows_its_formula_in_size_and_phase) {
  const Multipath m = one_target().compute();
  const double k = 2 * pi * pulse_900k.centre_frequency / 1500;
  const std::complex<double> r_b = bottom_reflection(FlatBottom{-10}, std::asin(15 / r_bottom));
  const auto path = [&](double out, double back, std::complex<double> reflections) {
    return source_pressure(pulse_900k) *
           std::sqrt(mu * (20 / out) * (20 / back) * static_cast<double>(float(target_area))) * reflections *
           std::polar(1.0, k * (out + back)) / (out * back);
  };
  const auto expect = [&](double out, double back, std::complex<double> wanted) {
    EXPECT_LT(std::abs(sum_at(m.echoes, 0.5 * (out + back)) - wanted), 1e-5 * std::abs(wanted)) << out + back;
  };
  expect(r_direct, r_surface, 2.0 * path(r_direct, r_surface, -1));
  expect(r_surface, r_surface, path(r_surface, r_surface, 1));
  expect(r_direct, r_bottom, 2.0 * path(r_direct, r_bottom, r_b));
  expect(r_bottom, r_bottom, path(r_bottom, r_bottom, r_b * r_b));
  expect(r_surface, r_bottom, 2.0 * path(r_surface, r_bottom, -r_b));
}

// The two senses of a mixed path have one delay and amplitude but come back from two directions.
TEST(MultipathEchoes, arrives_from_the_direction_of_the_leg_back) {
  Setting s = one_target({15, 5, -3});
  s.environment.bottom.reset();
  const Echoes e = s.compute().echoes;
  ASSERT_EQ(e.size(), 3u);  // SD, DS, SS, in the order in which legs out and back are taken
  EXPECT_EQ(e.delay[0], e.delay[1]);
  EXPECT_LT(std::abs(e.amplitude[0] - e.amplitude[1]), 1e-9 * std::abs(e.amplitude[0]));
  const double direct = std::hypot(15, 5, 1), image = std::hypot(15, 5, 5);
  EXPECT_THAT(
      (std::vector<double>{e.u[0], e.u[1]}),
      testing::UnorderedElementsAre(testing::DoubleNear(5 / direct, 1e-7), testing::DoubleNear(5 / image, 1e-7)));
  EXPECT_THAT(
      (std::vector<double>{e.v[0], e.v[1]}),
      testing::UnorderedElementsAre(testing::DoubleNear(-1 / direct, 1e-7), testing::DoubleNear(5 / image, 1e-7)));
}

// The mixed path of a target with a lobe: out at 3, back at 14 degrees from its normal, against Lambert's.
TEST(MultipathEchoes, scatter_by_the_angle_between_their_legs) {
  Setting s = one_target();
  const double range = 0.5 * (r_direct + r_surface), lambert = std::abs(sum_at(s.compute().echoes, range));
  s.scene.materials[0].law = RoughLaw{.slope = 0.15};
  const PathAngles path{20 / r_direct, 20 / r_surface, (20 * 20 + 1 * 5) / (r_direct * r_surface)};
  const auto surface = surface_table(s.scene.materials, pulse_900k.centre_frequency, 1500)[0];
  EXPECT_NEAR(std::pow(std::abs(sum_at(s.compute().echoes, range)) / lambert, 2),
              surface->cross_section(path) / (mu * path.cos_in * path.cos_out), 1e-4);
}

TEST(MultipathEchoes, by_the_surface_alone_is_the_direct_echo_of_the_mirrored_scene) {
  Setting s = one_target();
  s.environment.bottom.reset();
  for (int i = 0; i < 50; ++i)
    add_surfel(s.scene, {12.0 + 0.3 * i, -4 + 0.17 * i, -3 - 0.05 * i}, Vector3d(-1, 0.1, 0.3).normalized(), 0.001);
  s.sent.echo_options = {.elevation_width = radians(40)};  // with speckle, which goes by id
  s.view.world_from_head = pose_from_yaw_pitch_roll({0, 0, -2}, 0.1, -0.15, 0.2);
  SceneCloud mirrored = s.scene;
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    mirrored.point[i].z() *= -1;
    mirrored.normal[i].z() *= -1;
  }
  const Scatterers images =
      find_scatterers(mirrored, s.view.world_from_head, s.view.fan, s.view.gate, s.view.sampling).scatterers;
  const Echoes expected = direct_echoes(images, mirrored.materials, pulse_900k, s.sent.medium, s.sent.echo_options);
  ASSERT_GT(expected.size(), 40u);
  const Multipath computed = s.compute();
  EXPECT_EQ(computed.two_bounces, expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double nearest = 1;
    for (std::size_t j = 0; j < computed.echoes.size(); ++j)
      if (std::abs(computed.echoes.delay[j] - expected.delay[i]) < 1e-12)
        nearest = std::min(nearest, std::abs(computed.echoes.amplitude[j] / expected.amplitude[i] - 1.0) +
                                        std::abs(computed.echoes.u[j] - expected.u[i]) +
                                        std::abs(computed.echoes.v[j] - expected.v[i]));
    EXPECT_LT(nearest, 1e-5) << i;
  }
}

// The leg by the surface rises to it at x = 8 m and passes x = 4 m at z = -1 and x = 14 m at z = -1.5 m.
TEST(MultipathEchoes, a_wall_on_either_side_of_the_bounce_blocks_that_leg_alone) {
  for (const double x : {4.0, 14.0}) {
    Setting s = one_target();
    add_plate(s.scene, x, x < 8 ? -1.4 : -1.9, x < 8 ? -0.6 : -1.1);
    const Multipath m = s.compute();
    EXPECT_GT(m.blocked, 0u);
    EXPECT_EQ(sum_at(m.echoes, 0.5 * (r_direct + r_surface)), 0.0) << x;
    EXPECT_EQ(sum_at(m.echoes, r_surface), 0.0) << x;
    EXPECT_NE(sum_at(m.echoes, 0.5 * (r_direct + r_bottom)), 0.0) << x;
    EXPECT_NE(sum_at(m.echoes, r_bottom), 0.0) << x;
  }
}

TEST(MultipathEchoes, a_wall_on_the_direct_leg_leaves_the_two_bounce_paths) {
  Setting s = one_target();
  add_plate(s.scene, 10, -2.8, -2.2);
  const Multipath m = s.compute();
  EXPECT_EQ(sum_at(m.echoes, 0.5 * (r_direct + r_surface)), 0.0);
  EXPECT_NE(sum_at(m.echoes, r_surface), 0.0);
  EXPECT_NE(sum_at(m.echoes, r_bottom), 0.0);
  EXPECT_NE(sum_at(m.echoes, 0.5 * (r_surface + r_bottom)), 0.0);
}

// A shelf above the head faces away from it; its face is visible by way of the surface only.
TEST(MultipathEchoes, finds_patches_that_only_a_boundary_shows) {
  Setting s = one_target({20, 0, -1}, {0, 0, 1});
  s.environment.bottom.reset();
  s.view.sampling.scatterers_per_cell = 10;
  EXPECT_EQ(s.direct().size(), 0u);
  const Multipath m = s.compute();
  EXPECT_EQ(m.one_bounce, 0u);
  ASSERT_EQ(m.two_bounces, 1u);
  const double r = std::hypot(20, 3), sigma = mu * target_area * (3 / r) * (3 / r);
  EXPECT_NEAR(pressure_level_db(std::abs(m.echoes.amplitude[0])), 220 + db_from_power(sigma) - 40 * std::log10(r),
              1e-5);
}

// A mixed path may be strong although its direct leg is outside of the sampled elevations.
TEST(MultipathEchoes, finds_direct_legs_beyond_the_views_elevations) {
  Setting s = one_target({6, 0, -5}, Vector3d(-1, 0, 1).normalized());
  s.environment.bottom.reset();
  s.view.world_from_head = pose_from_yaw_pitch_roll({0, 0, -2}, 0, -radians(30), 0);
  s.sent.echo_options.elevation_width = radians(40);
  s.view.sampling.elevation_half_extent = radians(50);
  EXPECT_EQ(s.direct().size(), 0u);
  EXPECT_EQ(s.compute().one_bounce, 2u);
}

TEST(MultipathEchoes, mirrored_left_to_right_it_only_turns_u) {
  Setting s = one_target({15, 5, -3}), t = one_target({15, -5, -3});
  add_plate(s.scene, 9, -4, -1);
  add_plate(t.scene, 9, -4, -1);
  const Echoes a = s.compute().echoes, b = t.compute().echoes;
  ASSERT_EQ(a.size(), b.size());
  double power_a = 0, power_b = 0, u_a = 0, u_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    power_a += std::norm(a.amplitude[i]);
    power_b += std::norm(b.amplitude[i]);
    u_a += a.u[i] * std::norm(a.amplitude[i]);
    u_b += b.u[i] * std::norm(b.amplitude[i]);
  }
  EXPECT_NEAR(power_a / power_b, 1, 1e-5);
  EXPECT_NEAR(u_a / power_a, -u_b / power_b, 1e-5);
}

TEST(MultipathEchoes, world_head_and_boundaries_moved_together_change_nothing) {
  Setting s = one_target({15, 5, -3}), t = s;
  const Vector3d shift(1e5, -2e5, 37);
  t.scene.origin += shift;
  t.view.world_from_head.translation() += shift;
  t.environment.surface->height += 37;
  t.environment.bottom->height += 37;
  const Echoes a = s.compute().echoes, b = t.compute().echoes;
  ASSERT_EQ(a.size(), 8u);
  ASSERT_EQ(b.size(), 8u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a.delay[i], b.delay[i], 1e-12);
    EXPECT_NEAR(a.u[i], b.u[i], 1e-9);
    EXPECT_LT(std::abs(a.amplitude[i] / b.amplitude[i] - 1.0), 1e-5);
  }
}

TEST(MultipathEchoes, is_linear_in_the_reflection_of_each_bounce) {
  Setting s = one_target(), t = s;
  t.environment.bottom->density_ratio = 3;
  t.environment.bottom->sound_speed_ratio = 2;
  const double g = std::asin(15 / r_bottom);
  const auto ratio = bottom_reflection(*t.environment.bottom, g) / bottom_reflection(*s.environment.bottom, g);
  const Echoes a = s.compute().echoes, b = t.compute().echoes;
  const auto changed = [&](double range) { return sum_at(b, range) / sum_at(a, range); };
  EXPECT_LT(std::abs(changed(0.5 * (r_direct + r_bottom)) - ratio), 1e-6);
  EXPECT_LT(std::abs(changed(r_bottom) - ratio * ratio), 1e-6);
  EXPECT_LT(std::abs(changed(0.5 * (r_direct + r_surface)) - 1.0), 1e-12);
}

TEST(MultipathEchoes, applies_elevation_patterns_once_per_leg_and_the_transmitters_on_the_leg_out) {
  Setting s = one_target({15, 5, -3});
  s.environment.bottom.reset();
  const Echoes plain = s.compute().echoes;
  s.sent.echo_options.elevation_width = radians(30);
  s.sent.echo_options.transmit_width = radians(60);
  s.view.world_from_head = pose_from_yaw_pitch_roll({0, 0, -2}, 0, 0, 0);
  const Echoes shaped = s.compute().echoes;
  ASSERT_EQ(plain.size(), 3u);
  ASSERT_EQ(shaped.size(), 3u);
  const double direct = std::asin(-1 / std::hypot(15, 5, 1)), image = std::asin(5 / std::hypot(15, 5, 5));
  const auto two_way = [&](double e) { return elevation_response(ElevationShape::gaussian, radians(30), e); };
  const double transmit = gaussian_lobe(radians(60), std::atan2(5, 15));
  const double expected[] = {std::sqrt(two_way(direct) * two_way(image)), std::sqrt(two_way(direct) * two_way(image)),
                             two_way(image)};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(std::abs(shaped.amplitude[i] / plain.amplitude[i]), expected[i] * transmit, 1e-6) << i;
}

// For a rolled head the leg by the surface and the direct leg have different azimuths.
TEST(MultipathEchoes, pairs_the_transmitters_gain_on_the_leg_out_with_the_direction_of_the_leg_back) {
  Setting s = one_target({15, 5, -3});
  s.environment.bottom.reset();
  s.view.world_from_head = pose_from_yaw_pitch_roll({0, 0, -2}, 0, 0, radians(40));
  s.sent.echo_options.transmit_width = 0.5;
  const Eigen::Matrix3d to_head = s.view.world_from_head.linear().transpose();
  const Direction direct = direction_of(to_head * Vector3d(15, 5, -1)),
                  image = direction_of(to_head * Vector3d(15, 5, 5));
  const Echoes e = s.compute().echoes;
  ASSERT_EQ(e.size(), 3u);  // the first two are the mixed path in its two senses
  const std::size_t by_surface = e.v[0] > e.v[1] ? 0 : 1;
  EXPECT_NEAR(e.v[by_surface], std::sin(image.elevation), 1e-6);
  EXPECT_NEAR(std::abs(e.amplitude[by_surface]) / std::abs(e.amplitude[1 - by_surface]),
              gaussian_lobe(0.5, direct.azimuth) / gaussian_lobe(0.5, image.azimuth), 1e-5);
}

TEST(MultipathEchoes, append_keeps_the_doppler_shifts_of_both) {
  Echoes still{{1, 2}, {0, 0.1}, {1, 1}, {0, 0}}, moving{{3}, {0.2}, {1}, {0}, {40}};
  append(still, moving);
  EXPECT_EQ(still.doppler, (std::vector<double>{0, 0, 40}));
  EXPECT_EQ(still.delay, (std::vector<double>{1, 2, 3}));
  append(moving, {{4}, {0.3}, {1}, {0}});
  EXPECT_EQ(moving.doppler, (std::vector<double>{40, 0}));
}
