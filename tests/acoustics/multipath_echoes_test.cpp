#include "acoustics/multipath_echoes.hpp"

#include "acoustics/reflection.hpp"
#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

/// A head at depth 2 m, level, under a flat surface at 0 and above a bottom at -10 m.
struct Setting {
  SceneCloud scene;
  Environment environment;
  View view{Pose::Identity(), make_fan(91, radians(90), radians(1), radians(90)), {0.5, 60, 0.01}, {}};
  Transmission sent{pulse_900k, {1500, {0.2994626 * nepers_per_db, 0, 0}}, {.amplitude = SurfaceAmplitude::coherent}};

  Setting() {
    environment.surface = SeaSurface{};
    environment.bottom = FlatBottom{-10};
    view.world_from_head.translation() = Vector3d(0, 0, -2);
    view.sampling.scatterers_per_cell = 0;
    view.sampling.elevation_half_extent = pi / 2;
  }

  Scatterers direct() const {
    return find_scatterers(scene, view.world_from_head, view.fan, view.gate, view.sampling).scatterers;
  }
  Multipath compute(const MultipathOptions& options = {}) const {
    return multipath_echoes(scene, direct(), environment, view, sent, options);
  }
};

const Vector3d target(20, 0, -3);
constexpr double mu = 0.1, area = 1e-4;

Setting one_target(const Vector3d& place = target, const Vector3d& normal = {-1, 0, 0}) {
  Setting s;
  s.scene.materials = {{"m", mu}};
  add_surfel(s.scene, place, normal, area);
  return s;
}

/// A plate of 2 m that faces the head, from z = low to high.
void add_plate(SceneCloud& scene, double x, double low, double high) {
  for (int j = -20; j <= 20; ++j)
    for (int k = 0; k <= std::lround((high - low) / 0.05); ++k)
      add_surfel(scene, {x, 0.05 * j, low + 0.05 * k}, {-1, 0, 0}, 0.0025);
}

/// Sum of the echoes within half a millimetre of an apparent range.
std::complex<double> sum_at(const Echoes& e, double range) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i)
    if (std::abs(750 * e.delay[i] - range) < 5e-4) sum += e.amplitude[i];
  return sum;
}

const double r_direct = std::hypot(20, 1), r_surface = std::hypot(20, 5), r_bottom = std::hypot(20, 15);

double level_after_absorption(std::complex<double> amplitude, double range) {
  return pressure_level_db(std::abs(amplitude)) - 2 * 0.2994626 * range;
}

}  // namespace

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
    return source_pressure(pulse_900k) * std::sqrt(mu * (20 / out) * (20 / back) * static_cast<double>(float(area))) *
           reflections * std::polar(1.0, k * (out + back)) / (out * back);
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
  const double r = std::hypot(20, 3), sigma = mu * area * (3 / r) * (3 / r);
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
  add_surfel(s.scene, {40, 0, -3}, {-1, 0, 0}, area);
  add_surfel(s.scene, target, {-1, 0, 0}, area);
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
