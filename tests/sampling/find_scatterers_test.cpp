// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/find_scatterers.hpp"

#include "sampling_scenes.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

SceneCloud mixed_scene() {
  SceneCloud scene;
  add_rectangle(scene, {1, -5, -2}, {12, 0, 0}, {0, 10, 0}, {0, 0, 1}, 0.1, 0.5);
  add_sphere(scene, {5, 1, -1}, 0.7, 2000);
  add_wall(scene, 11, 4, 2, 0.1, 0.5);
  return scene;
}

SamplingOptions with_threads(SamplingKind kind, int threads) {
  SamplingOptions options;
  options.kind = kind;
  options.threads = threads;
  return options;
}

}  // namespace

TEST(FindScatterers, does_not_change_when_world_and_head_move_together) {
  SceneCloud scene = mixed_scene();
  const Vector3d far(1e6, -2e6, 500);
  Pose moved = at(0.3, 0, 0, 5, 5);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    scene.origin.setZero();
    const Sampling here = find_scatterers(scene, at(0.3, 0, 0, 5, 5), wide_fan(), long_gate(), with_threads(kind, 0));
    scene.origin = far;
    moved.translation() = far + Vector3d(0.3, 0, 0);
    const Sampling there = find_scatterers(scene, moved, wide_fan(), long_gate(), with_threads(kind, 0));
    ASSERT_EQ(there.scatterers.id, here.scatterers.id);
    for (std::size_t i = 0; i < here.scatterers.size(); ++i)
      ASSERT_NEAR(there.scatterers.range[i], here.scatterers.range[i], kind == SamplingKind::rays ? 1e-5 : 1e-8);
  }
}

TEST(FindScatterers, does_not_change_when_world_and_head_turn_together) {
  const SceneCloud scene = mixed_scene();
  const Pose pose = at(0.3, 0, 0, 5, 5);
  const Pose turn = pose_from_yaw_pitch_roll({3, -2, 7}, 1.1, -0.4, 2.2);
  SceneCloud turned = scene;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    turned.point[i] = (turn * scene.point[i].cast<double>()).cast<float>();
    turned.normal[i] = (turn.linear() * scene.normal[i].cast<double>()).cast<float>();
  }
  const Scatterers a = find_scatterers(scene, pose, wide_fan(), long_gate(), unsplit()).scatterers;
  const Scatterers b = find_scatterers(turned, turn * pose, wide_fan(), long_gate(), unsplit()).scatterers;
  // Rounding of the rotated points may change a few borderline cases.
  std::vector<double> range(scene.size(), 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) range[a.surfel[i]] = a.range[i];
  std::size_t both = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (range[b.surfel[i]] == 0) continue;
    ++both;
    ASSERT_NEAR(b.range[i], range[b.surfel[i]], 1e-5);
  }
  EXPECT_GE(both + 5, a.size());
  EXPECT_GE(both + 5, b.size());
}

TEST(FindScatterers, keeps_to_sector_and_gate) {
  SceneCloud scene;
  add_sphere(scene, {0, 0, 0}, 3, 20000, -1);
  add_sphere(scene, {0, 0, 0}, 6, 20000, -1);
  const BeamFan fan = make_fan(8, radians(40), radians(2), radians(10), radians(-15));
  SamplingOptions options = unsplit();
  options.occlusion = false;
  options.elevation_half_extent = radians(4);
  const Sampling sampling = find_scatterers(scene, at(0, 0, 0), fan, {4, 8, 0.1}, options);
  const Scatterers& s = sampling.scatterers;
  ASSERT_GT(s.size(), 100u);
  for (std::size_t i = 0; i < s.size(); ++i) {
    ASSERT_NEAR(s.range[i], 6, 1e-4);
    // Outermost beams at 17.5 degrees, 1.5 beam widths more on either side.
    const double u = std::cos(s.elevation[i]) * std::sin(s.azimuth[i]);
    ASSERT_LE(std::abs(u), std::cos(radians(15)) * std::sin(radians(17.5)) + radians(3) + 1e-9);
    ASSERT_NEAR(s.elevation[i], radians(-15), radians(4) + 1e-9);
  }
  EXPECT_EQ(sampling.report.surfels, scene.size());
  EXPECT_EQ(sampling.report.in_gate, s.size());
}

TEST(FindScatterers, looks_astern_as_it_looks_ahead) {
  SceneCloud scene;
  add_sphere(scene, {0, 0, 0}, 3, 20000, -1);
  const BeamFan ahead = make_fan(20, radians(40), radians(2), radians(10));
  BeamFan astern = ahead;
  for (double& a : astern.azimuth) a = std::remainder(a + pi, 2 * pi);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    const auto count = [&](const BeamFan& fan) {
      return static_cast<double>(
          find_scatterers(scene, at(0, 0, 0), fan, long_gate(), with_threads(kind, 0)).scatterers.size());
    };
    EXPECT_NEAR(count(astern), count(ahead), 0.03 * count(ahead));
  }
}

TEST(FindScatterers, gives_cosine_and_area_of_a_single_patch) {
  SceneCloud scene;
  const Vector3d normal = Vector3d(-1, 0, 1).normalized();
  add_surfel(scene, {5, 0, 0}, normal, 0.04);
  const Scatterers s = find_scatterers(scene, at(1, 0, 0), wide_fan(), long_gate(), unsplit()).scatterers;
  ASSERT_EQ(s.size(), 1u);
  EXPECT_NEAR(s.range[0], 4, 1e-12);
  EXPECT_NEAR(s.azimuth[0], 0, 1e-12);
  EXPECT_NEAR(s.cos_incidence[0], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(s.projected_area[0], 0.04 * std::sqrt(0.5), 1e-8);
}

TEST(FindScatterers, with_nothing_in_view_gives_none) {
  SceneCloud behind;
  add_wall(behind, -4, 1, 1, 0.1);
  for (const SceneCloud& scene : {SceneCloud{}, behind})
    for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
      const Sampling sampling = find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), with_threads(kind, 0));
      EXPECT_EQ(sampling.scatterers.size(), 0u);
      EXPECT_EQ(sampling.report.in_gate, 0u);
      EXPECT_EQ(sampling.report.rays_missed, kind == SamplingKind::rays ? 91u * 64u : 0u);
    }
}

TEST(FindScatterers, says_what_is_wrong_with_its_arguments) {
  const auto message = [](const std::function<void(SceneCloud&, Pose&, RangeGate&, SamplingOptions&)>& damage) {
    SceneCloud scene;
    add_surfel(scene, {5, 0, 0}, {-1, 0, 0}, 0.01);
    Pose pose = Pose::Identity();
    RangeGate gate = long_gate();
    SamplingOptions options;
    damage(scene, pose, gate, options);
    return error_with_kind([&] { find_scatterers(scene, pose, wide_fan(), gate, options); });
  };
  using O = SamplingOptions;
  EXPECT_EQ(message([](auto&, auto&, auto&, O&) {}), "no error");
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.footprint = 0; }),
              HasSubstr("find_scatterers: options.footprint = 0, must be > 0"));
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.lobe_margin = -0.1; }),
              HasSubstr("find_scatterers: options.lobe_margin = -0.1, must be >= 0"));
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.scatterers_per_cell = -1; }),
              HasSubstr("scatterers_per_cell = -1"));
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.rays_per_beam = 0; }),
              HasSubstr("rays_per_beam = 0, must be at least 1"));
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.range_resolution = std::nan(""); }),
              HasSubstr("range_resolution"));
  EXPECT_THAT(message([](auto&, auto&, auto&, O& o) { o.elevation_half_extent = -0.1; }),
              HasSubstr("elevation_half_extent = -0.1"));
  EXPECT_THAT(message([](auto&, auto&, RangeGate& g, O&) { g.max_range = 0.05; }),
              HasSubstr("find_scatterers: gate.max_range = 0.05 m"));
  EXPECT_THAT(message([](SceneCloud& s, auto&, auto&, O&) { s.normal[0].setZero(); }),
              HasSubstr("content: find_scatterers: scene.normal[0]"));
  EXPECT_THAT(message([](auto&, Pose& p, auto&, O&) { p.linear() *= 2; }), HasSubstr("must be a rotation"));
  EXPECT_THAT(message([](auto&, Pose& p, auto&, O&) { p.translation().x() = std::nan(""); }),
              HasSubstr("must be finite"));
}

// At 10 m the main lobes of 2 degrees x 2 degrees hold four surfels 0.175 m apart.
TEST(SparseBeams, are_those_whose_main_lobe_holds_fewer_than_four_surfels) {
  const BeamFan fan = make_fan(9, radians(36), radians(2), radians(2));
  const auto wall = [](double starboard, double port) {
    SceneCloud scene;
    add_rectangle(scene, {10, -6, -2}, {0, 6, 0}, {0, 0, 4}, {-1, 0, 0}, starboard);
    add_rectangle(scene, {10, 0, -2}, {0, 6, 0}, {0, 0, 4}, {-1, 0, 0}, port);
    return scene;
  };
  const auto sparse = [&](const SceneCloud& scene, double min_range = 1) {
    return find_scatterers(scene, Pose::Identity(), fan, {min_range, 15, 0.1}).report.sparse_beams;
  };
  EXPECT_EQ(sparse(wall(0.16, 0.16)), 0U);
  EXPECT_EQ(sparse(wall(0.2, 0.2)), 9U);
  EXPECT_EQ(sparse(wall(2, 2)), 9U);  // most fall between surfels
  const std::size_t half = sparse(wall(0.1, 0.25));
  EXPECT_GE(half, 4U);
  EXPECT_LE(half, 5U);
  EXPECT_EQ(sparse(wall(0.2, 0.2), 12), 0U);  // before the gate
  EXPECT_EQ(sparse({}), 0U);
}
