// Surfaces, points and directions at the limits of what can be seen.
#include "acoustics/scattering.hpp"
#include "extreme_cases.hpp"

using namespace insonify::extreme;

namespace {

SceneCloud one_surfel(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, double area = 0.01) {
  SceneCloud scene;
  add_surfel(scene, place, normal, area);
  return scene;
}

const SimulationOptions coherent{.amplitude = SurfaceAmplitude::coherent, .sampling = {.scatterers_per_cell = 0}};

double peak(const SimulatedPing& p) { return image(p).abs().maxCoeff(); }

}  // namespace

TEST(ExtremeGeometry, n01_grazing_patch_has_no_cross_section_and_divides_by_nothing) {
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

TEST(ExtremeGeometry, n02_back_of_an_oriented_patch_is_silent_and_of_an_unoriented_one_is_not) {
  SceneCloud scene = one_surfel({5, 0, 0}, {1, 0, 0});
  const SimulatedPing oriented = ping_of(scene, coherent);
  EXPECT_EQ(peak(oriented), 0);
  EXPECT_EQ(oriented.report.sampling.back_facing, 1U);
  scene.normals_oriented = false;
  EXPECT_EQ(peak(ping_of(scene, coherent)), peak(ping_of(one_surfel({5, 0, 0}, {-1, 0, 0}), coherent)));
}

TEST(ExtremeGeometry, n03_flipped_normals_without_sides_give_the_image_of_oriented_ones) {
  const ComplexGrid oriented = image(ping_of(plate(5, 2, 20)));
  SceneCloud mixed = plate(5, 2, 20);
  mixed.normals_oriented = false;
  for (std::size_t i = 0; i < mixed.size(); i += 3) mixed.normal[i] = -mixed.normal[i];
  EXPECT_LT(relative_l2(image(ping_of(mixed, {.sampling = {.scatterers_per_cell = 0}})),
                        image(ping_of(plate(5, 2, 20), {.sampling = {.scatterers_per_cell = 0}}))),
            1e-12);
  EXPECT_GT(oriented.abs().maxCoeff(), 0);
}

TEST(ExtremeGeometry, n04_n05_n06_scene_in_memory_with_unusable_points_or_normals_is_refused) {
  const auto refused = [](auto&& damage, const std::vector<std::string>& parts) {
    SceneCloud scene = plate(5, 2, 3);
    damage(scene);
    expect_error(ErrorKind::content, parts, [&] { ping_of(scene); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  refused([&](SceneCloud& s) { s.point[4].x() = nan; }, {"scene.point[4]", "nan", "must be finite"});
  refused([&](SceneCloud& s) { s.point[2].y() = -inf; }, {"scene.point[2]", "-inf", "must be finite"});
  refused([&](SceneCloud& s) { s.normal[1].z() = nan; }, {"scene.normal[1]", "must be a unit vector"});
  refused([&](SceneCloud& s) { s.normal[3].setZero(); }, {"scene.normal[3]", "(0, 0, 0)", "must be a unit vector"});
  refused([&](SceneCloud& s) { s.normal[5] *= 2; }, {"scene.normal[5]", "must be a unit vector"});
  refused([&](SceneCloud& s) { s.area[0] = -1; }, {"scene.area[0] = -1 m^2", ">= 0"});
  refused([&](SceneCloud& s) { s.area[8] = nan; }, {"scene.area[8] = nan m^2", "finite"});
}

TEST(ExtremeGeometry, n07_point_at_the_head_itself_gives_no_echo_and_hides_nothing) {
  SceneCloud scene = plate(5, 2, 20);
  const ComplexGrid alone = image(ping_of(scene));
  add_surfel(scene, {0, 0, 0}, {-1, 0, 0}, 0.01);
  const SimulatedPing p = ping_of(scene);
  EXPECT_TRUE(all_finite(p));
  EXPECT_TRUE(same(image(p), alone));
}

// The gate begins at 1 m, and a pulse is 5 cm long at most.
TEST(ExtremeGeometry, n08_points_nearer_than_the_gate_give_no_echo_and_overflow_nothing) {
  for (const double r : {1e-30, 1e-7, 1e-6, 1e-3, 0.5, 0.95}) {
    const SimulatedPing p = ping_of(one_surfel({r, 0, 0}, {-1, 0, 0}, 1e-6));
    EXPECT_TRUE(all_finite(p)) << r;
    EXPECT_EQ(peak(p), 0) << r;
  }
  // A target given by hand has no gate before it: 1 um away it is loud, and finite.
  const Echoes near = echoes_of(targets_at({1e-6}), small_head().pulse, clear_water());
  EXPECT_NEAR(pressure_level_db(std::abs(near.amplitude[0])), 220 + 240, 1e-9);
  expect_error(ErrorKind::argument, {"range[0] = 0 m", "must be > 0"},
               [] { echoes_of(targets_at({0}), small_head().pulse, clear_water()); });
  expect_error(ErrorKind::argument, {"range[1] = -3 m", "must be > 0"}, [] {
    echoes_of(targets_at({1, -3}), small_head().pulse, clear_water());
  });
}

TEST(ExtremeGeometry, n12_scene_without_points_is_silent) {
  const SimulatedPing p = ping_of(SceneCloud{});
  EXPECT_TRUE(all_finite(p));
  EXPECT_GT(p.ping.pressure.size(), 0);
  EXPECT_EQ(peak(p), 0);
  EXPECT_EQ(p.soundings.size(), 0U);
  EXPECT_EQ(level_db(p.ping).maxCoeff(), -200);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays})
    EXPECT_EQ(ping_of(SceneCloud{}, {.sampling = {.kind = kind}}).report.sampling.scatterers, 0U);
}

// SL 220 dB, 10 m, 0.2994626 dB/m, target strength -20 dB: 220 - 2 (20 + 2.994626) - 20 dB.
TEST(ExtremeGeometry, n13_one_point_has_the_level_of_the_sonar_equation) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const Medium medium{1500, {0.2994626 * nepers_per_db, 0, 0}};
  const SonarHead head = single_beam(pulse, 9, 11);
  const Echoes echoes = echoes_of(targets_at({10}), pulse, medium, 0.01);
  for (const ComplexGrid& p :
       {synthesize_direct(echoes, head, medium), synthesize_gridded(echoes, head, medium, {1e-12})}) {
    Eigen::Index beam, bin;
    EXPECT_NEAR(pressure_level_db(p.abs().maxCoeff(&beam, &bin)), 154.010748, 1e-10);
    EXPECT_NEAR(head.gate.centre(static_cast<std::size_t>(bin)), 10, 1e-12);
  }
}

TEST(ExtremeGeometry, n14_one_beam_and_one_ray_meet_the_wall_before_them) {
  SonarSpec s = small_sonar();
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

TEST(ExtremeGeometry, n16_copies_of_a_point_add_amplitudes_if_coherent_and_powers_if_not) {
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

TEST(ExtremeGeometry, n30_abeam_is_received_and_astern_is_behind_the_baffle) {
  SonarSpec s = small_sonar();
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

TEST(ExtremeGeometry, n31_straight_up_and_down_have_no_azimuth_and_a_level) {
  SonarSpec s = small_sonar();
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

TEST(ExtremeGeometry, n54_behind_a_plate_that_fills_the_fan_there_is_nothing) {
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
