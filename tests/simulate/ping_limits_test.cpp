// SPDX-License-Identifier: BSD-3-Clause
// Tests surfaces, points and directions at the limits of what a ping can see.
#include "acoustics/surface_scattering.hpp"
#include "support/checked_ping.hpp"
#include "support/point_targets.hpp"

namespace insonify::ping_limits {

SceneCloud one_surfel(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, double area = 0.01) {
  SceneCloud scene;
  add_surfel(scene, position, normal, area);
  return scene;
}

const SimulationOptions coherent{.amplitude = SurfaceAmplitude::coherent, .sampling = {.scatterers_per_cell = 0}};

double peak(const SimulatedPing& p) { return image(p).abs().maxCoeff(); }

TEST(PingLimits, grazing_patch_has_no_cross_section_and_divides_by_nothing) {
  EXPECT_EQ(lambert_cross_section(0.1, 0, 0), 0);
  for (const bool oriented : {true, false}) {
    SceneCloud scene = one_surfel({5, 0, 0}, {0, 0, 1});
    scene.normals_oriented = oriented;
    const SimulatedPing p = ping_of(scene);
    EXPECT_TRUE(all_finite(p));
    EXPECT_EQ(peak(p), 0);
  }
  // A hundred-thousandth of a radian off grazing: sigma falls as cos^2, 100 dB below normal incidence in pressure.
  const double grazing = 1e-5;
  const SimulatedPing tilted = ping_of(one_surfel({5, 0, 0}, {-std::sin(grazing), 0, std::cos(grazing)}), coherent);
  const SimulatedPing upright = ping_of(one_surfel({5, 0, 0}, {-1, 0, 0}), coherent);
  EXPECT_NEAR(db_from_amplitude(peak(tilted) / peak(upright)), -100, 0.01);
}

TEST(PingLimits, back_of_an_oriented_patch_is_silent_and_of_an_unoriented_one_is_not) {
  SceneCloud scene = one_surfel({5, 0, 0}, {1, 0, 0});
  const SimulatedPing oriented = ping_of(scene, coherent);
  EXPECT_EQ(peak(oriented), 0);
  EXPECT_EQ(oriented.report.sampling.back_facing, 1U);
  scene.normals_oriented = false;
  EXPECT_EQ(peak(ping_of(scene, coherent)), peak(ping_of(one_surfel({5, 0, 0}, {-1, 0, 0}), coherent)));
}

TEST(PingLimits, point_at_the_head_itself_gives_no_echo_and_hides_nothing) {
  SceneCloud scene = plate(5, 2, 20);
  const ComplexGrid alone = image(ping_of(scene));
  add_surfel(scene, {0, 0, 0}, {-1, 0, 0}, 0.01);
  const SimulatedPing p = ping_of(scene);
  EXPECT_TRUE(all_finite(p));
  EXPECT_TRUE(same(image(p), alone));
}

// The gate begins at 1 m, and a pulse is 5 cm long at most.
TEST(PingLimits, points_nearer_than_the_gate_give_no_echo_and_overflow_nothing) {
  for (const double r : {1e-30, 1e-7, 1e-6, 1e-3, 0.5, 0.95}) {
    const SimulatedPing p = ping_of(one_surfel({r, 0, 0}, {-1, 0, 0}, 1e-6));
    EXPECT_TRUE(all_finite(p)) << r;
    EXPECT_EQ(peak(p), 0) << r;
  }
  // A target given by hand has no gate before it: 1 um away it is loud, and finite.
  const Echoes near = echoes_of(targets_at({1e-6}), nine_beam_head().pulse, clear_water());
  EXPECT_NEAR(pressure_level_db(std::abs(near.amplitude[0])), 220 + 240, 1e-9);
  expect_error(ErrorKind::argument, {"range[0] = 0 m", "must be > 0"},
               [] { echoes_of(targets_at({0}), nine_beam_head().pulse, clear_water()); });
  expect_error(ErrorKind::argument, {"range[1] = -3 m", "must be > 0"}, [] {
    echoes_of(targets_at({1, -3}), nine_beam_head().pulse, clear_water());
  });
}

TEST(PingLimits, points_exactly_at_the_edges_of_the_gate_are_received_and_detected) {
  for (const double r : {1.0, 12.0}) {
    SceneCloud scene;
    add_surfel(scene, {r, 0, 0}, {-1, 0, 0}, 0.01);
    SonarSpec s = nine_beams();
    s.beams = 1;
    s.bin_size = 0.011;  // 1000 bins fill the gate exactly
    const SimulatedPing p =
        ping_of(scene, {.amplitude = SurfaceAmplitude::coherent, .sampling = {.scatterers_per_cell = 0}}, s);
    EXPECT_TRUE(all_finite(p));
    ASSERT_EQ(p.report.sampling.scatterers, 1U) << r << " m";
    ASSERT_EQ(p.soundings.size(), 1U) << r << " m";
    EXPECT_NEAR(p.soundings.range[0], r, 0.011);
    // Just outside: the end of its pulse_900k is still received; farther away nothing is.
    scene.point[0].x() = static_cast<float>(r < 2 ? r - 0.02 : r + 0.02);
    const double tail = image(ping_of(scene, {.amplitude = SurfaceAmplitude::coherent}, s)).abs().maxCoeff();
    EXPECT_GT(tail, 0) << r << " m";
    EXPECT_LT(tail, 0.5 * image(p).abs().maxCoeff()) << r << " m";
    scene.point[0].x() = static_cast<float>(r < 2 ? r - 0.15 : r + 0.15);
    EXPECT_EQ(ping_of(scene, {}, s).report.sampling.scatterers, 0U) << r << " m";
  }
}

TEST(PingLimits, scene_without_points_is_silent) {
  const SimulatedPing p = ping_of(SceneCloud{});
  EXPECT_TRUE(all_finite(p));
  EXPECT_GT(p.ping.pressure.size(), 0);
  EXPECT_EQ(peak(p), 0);
  EXPECT_EQ(p.soundings.size(), 0U);
  EXPECT_EQ(level_db(p.ping).maxCoeff(), -200);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays})
    EXPECT_EQ(ping_of(SceneCloud{}, {.sampling = {.kind = kind}}).report.sampling.scatterers, 0U);
}

TEST(PingLimits, one_beam_and_one_ray_meet_the_wall_before_them) {
  SonarSpec s = nine_beams();
  s.beams = 1;
  s.field_of_view = 0;  // one beam looks straight ahead, whatever the field of view
  const SimulatedPing p =
      ping_of(plate(5, 12, 60),
              {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 1}, .outputs = {.scatterers = true}}, s);
  EXPECT_TRUE(all_finite(p));
  ASSERT_EQ(p.outputs.scatterers.size(), 1U);
  const double x = p.outputs.scatterers.range[0] * std::cos(p.outputs.scatterers.azimuth[0]) *
                   std::cos(p.outputs.scatterers.elevation[0]);
  EXPECT_NEAR(x, 5, 1e-5);
  EXPECT_GT(peak(p), 0);
}

TEST(PingLimits, copies_of_a_point_add_amplitudes_if_coherent_and_powers_if_not) {
  const auto copies = [](int k) {
    SceneCloud scene;
    for (int i = 0; i < k; ++i) add_surfel(scene, {5, 0, 0}, {-1, 0, 0}, 0.01);
    return scene;
  };
  EXPECT_NEAR(peak(ping_of(copies(7), coherent)) / peak(ping_of(copies(1), coherent)), 7, 7e-4);
  // Power over 400 seeds: k times that of one point, with a standard deviation of 5 %.
  double power = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const SimulationOptions seeded{
        .seed = seed, .sampling = {.scatterers_per_cell = 0}, .synthesis = {.true_delays = Choice::never}};
    power += std::pow(peak(ping_of(copies(7), seeded)), 2) / 400;
  }
  EXPECT_NEAR(power / std::pow(peak(ping_of(copies(1), coherent)), 2), 7, 7 * 0.15);
}

TEST(PingLimits, abeam_is_received_and_astern_is_behind_the_baffle) {
  SonarSpec s = nine_beams();
  s.beams = 5;
  s.azimuths = {-pi / 2, -pi / 4, 0, pi / 4, pi / 2};
  const auto ping_from = [&](double azimuth) {
    const Eigen::Vector3d u = unit_vector({azimuth, 0});
    return ping_of(one_surfel(5 * u, -u), coherent, s);
  };
  for (const double side : {-1.0, 1.0}) {
    const SimulatedPing abeam = ping_from(side * pi / 2);
    EXPECT_TRUE(all_finite(abeam));
    Eigen::Index beam, bin;
    image(abeam).abs().maxCoeff(&beam, &bin);
    EXPECT_EQ(beam, side > 0 ? 4 : 0);
    EXPECT_NEAR(peak(abeam), peak(ping_from(0)), 1e-3 * peak(abeam));
    EXPECT_EQ(peak(ping_from(side * 0.75 * pi)), 0);  // its mirror image at 45 degrees would be received
  }
  EXPECT_EQ(peak(ping_from(pi)), 0);
  s.azimuths[0] = -3.2;
  expect_error(ErrorKind::argument, {"azimuth[0] = -3.2 rad", "within +-pi"}, [&] { make_head(s, 1500); });
}

TEST(PingLimits, straight_up_and_down_have_no_azimuth_and_a_level) {
  SonarSpec s = nine_beams();
  for (const double elevation : {-pi / 2, pi / 2}) {
    s.elevation = elevation;
    const Eigen::Vector3d zenith(0, 0, elevation > 0 ? 1 : -1);
    SimulationOptions options = coherent;
    options.outputs.scatterers = true;
    const SimulatedPing p = ping_of(one_surfel(5 * zenith, -zenith), options, s);
    EXPECT_TRUE(all_finite(p));
    ASSERT_EQ(p.outputs.scatterers.size(), 1U);
    EXPECT_EQ(p.outputs.scatterers.azimuth[0], 0);
    EXPECT_NEAR(peak(p), peak(ping_of(one_surfel({5, 0, 0}, {-1, 0, 0}), coherent)), 1e-3 * peak(p));
  }
  s.elevation = 1.6;
  expect_error(ErrorKind::argument, {"elevation_deg = 91.67", "within -90 and 90"}, [&] { make_head(s, 1500); });
}

TEST(PingLimits, cloud_of_identical_points_is_indexed_and_received) {
  SceneCloud scene;
  for (int i = 0; i < 5000; ++i) add_surfel(scene, {5, 0.5, 0.1}, Eigen::Vector3d(-5, -0.5, -0.1).normalized(), 1e-2);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    const SimulatedPing p = ping_of(scene, {.sampling = {.kind = kind, .rays_per_beam = 2000}});
    EXPECT_TRUE(all_finite(p));
    EXPECT_GT(p.report.sampling.scatterers, 0U);
    EXPECT_GT(p.ping.pressure.abs().maxCoeff(), 0);
  }
}

TEST(PingLimits, behind_a_plate_that_fills_the_fan_there_is_nothing) {
  const int n = 60;
  SceneCloud scene = plate(3, 6, n);
  const SceneCloud wall = plate(9, 4, n);
  const auto beyond = [](const SimulatedPing& p) {
    // The plate's far corner is at 5.2 m; its pulse has ended before 7 m.
    const auto first = static_cast<Eigen::Index>((7 - p.ping.gate.min_range) / p.ping.gate.bin_size);
    return image(p).rightCols(p.ping.pressure.cols() - first).abs().maxCoeff();
  };
  EXPECT_GT(beyond(ping_of(wall)), 0);
  for (std::size_t i = 0; i < wall.size(); ++i)
    add_surfel(scene, wall.point[i].cast<double>(), wall.normal[i].cast<double>(), wall.area[i]);
  EXPECT_GT(peak(ping_of(scene)), 0);
  EXPECT_EQ(beyond(ping_of(scene)), 0);
  EXPECT_GT(beyond(ping_of(scene, {.sampling = {.occlusion = false}})), 0);
}

// A bottom 3 m below, at 10 to 12 m: r^2 dphi / h sets how far apart rays meet it. 64 rays over 40 degrees and more
// leave most cells empty, and the ping says so with the number it takes; surfels leave none.
TEST(PingLimits, rays_too_few_for_a_grazing_plane_are_noted_with_the_number_it_takes) {
  SceneCloud scene;
  for (int i = 0; i < 240; ++i)
    for (int j = 0; j < 200; ++j) add_surfel(scene, {4 + 0.04 * i, 0.04 * j - 4, -3}, {0, 0, 1}, 0.0016);
  const SimulatedPing few = ping_of(scene, {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 64}});
  ASSERT_EQ(few.report.notes.size(), 1U);
  EXPECT_THAT(few.report.notes[0].text, HasSubstr("rays are too few"));
  EXPECT_THAT(few.report.notes[0].text, HasSubstr("rays per beam"));
  // 20 000 rays leave 1.2 % of the cells empty, 46 of 3850; above 1 % the ping says so.
  const SimulatedPing enough = ping_of(scene, {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 30000}});
  EXPECT_TRUE(enough.report.notes.empty()) << enough.report.notes[0].text;
  EXPECT_TRUE(ping_of(scene).report.notes.empty());
  EXPECT_TRUE(all_finite(few));
}

TEST(PingLimits, ping_at_1_ghz_is_absorbed_to_silence) {
  SonarSpec s = nine_beams();
  s.centre_frequency = 1e9;
  const SimulatedPing p = ping_of(plate(5, 1, 5), {}, s);
  EXPECT_TRUE(all_finite(p));
  EXPECT_GT(p.report.sampling.scatterers, 0U);
  EXPECT_EQ(p.ping.pressure.abs().maxCoeff(), 0);
  EXPECT_EQ(p.soundings.size(), 0U);
}

}  // namespace insonify::ping_limits
