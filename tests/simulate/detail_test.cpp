// SPDX-License-Identifier: BSD-3-Clause
// Compares pings of scenes whose surfels are merged up to the detail_head's resolution (E137) with those of all
// surfels.
#include <numeric>
#include <random>

#include "../benchmarks/compared_levels.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/plan_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/shadow_edges.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

const Pose over_the_scene = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
const SonarHead detail_head = small_head({.min_range = 1, .max_range = 25});

SimulationOptions mean_level(bool detail) {
  return {.sampling = {.detail_width = detail ? usual_detail_width : 0},
          .synthesis = {.method = SynthesisMethod::incoherent}};
}

SimulatedPing detail_ping(const SceneCloud& scene, SimulationOptions options, const Pose& pose = over_the_scene) {
  return simulate_event(scene, detail_head, {pose}, {}, options);
}

SceneCloud detail_harbour(std::size_t points) { return make_built_in_scene("harbour", {.points = points}); }

double decibels(double ratio) { return 10 * std::log10(ratio); }

/// Compares the expected levels with and without merging: in total, and in ten bands of range.
void expect_same_levels(const SceneCloud& scene, double total_db, double band_db, const Pose& pose = over_the_scene,
                        double fewer = 1.5) {
  const SimulatedPing all = detail_ping(scene, mean_level(false), pose),
                      cut = detail_ping(scene, mean_level(true), pose);
  EXPECT_EQ(all.report.sampling.merged_to, 0U);
  EXPECT_GT(cut.report.sampling.merged_to, 0U);
  EXPECT_LT(fewer * static_cast<double>(cut.report.sampling.in_gate), static_cast<double>(all.report.sampling.in_gate));
  const auto a = all.ping.pressure.abs2().eval(), b = cut.ping.pressure.abs2().eval();
  EXPECT_NEAR(decibels(b.sum() / a.sum()), 0, total_db);
  const auto bins = a.cols();
  for (int k = 0; k < 10; ++k) {
    const auto first = k * bins / 10, n = (k + 1) * bins / 10 - first;
    const double loud = a.middleCols(first, n).sum();
    if (loud > 1e-3 * a.sum()) {
      EXPECT_NEAR(decibels(b.middleCols(first, n).sum() / loud), 0, band_db) << k;
    }
  }
}

}  // namespace

TEST(Detail, keeps_the_level_of_a_harbour) { expect_same_levels(detail_harbour(400000), 0.03, 0.15); }

TEST(Detail, keeps_the_level_of_a_reef_and_of_a_wall) {
  expect_same_levels(make_built_in_scene("reef", {.points = 400000}), 0.03, 0.15,
                     pose_from_yaw_pitch_roll({-8, 0, -2}, 0, radians(10), 0), 1);
  expect_same_levels(make_built_in_scene("wall", {.points = 400000, .size = {20, 6}}), 0.02, 0.1,
                     Pose(Eigen::Translation3d(-12, 0, 1)));
}

// From 2.5 m the nodes of crests lie above the troughs behind them, but do not hide them. From below, waves hide one
// another: with nodes half a wave wide, bands would lose 0.5 to 2 dB (E225).
TEST(Detail, keeps_the_level_of_waves) {
  SceneCloud waves = make_built_in_scene("plane", {.points = 1000000, .size = {20, 10}});
  const float height = 0.02F, number = static_cast<float>(2 * pi / 1.2);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    Eigen::Vector3f& p = waves.point[i];
    waves.normal[i] = Eigen::Vector3f(-height * number * std::cos(number * p.x()), 0, 1).normalized();
    p.z() += height * std::sin(number * p.x());
  }
  for (const double above : {0.5, 1.0, 1.5, 2.5})
    expect_same_levels(waves, 0.03, 0.1, Pose(Eigen::Translation3d(-11, 0, above)), 1.3);
}

TEST(Detail, keeps_shadows_dark_and_their_edges_in_place) {
  const SceneCloud scene = make_built_in_scene("poles", {.points = 400000});
  const SimulatedPing all = detail_ping(scene, mean_level(false)), cut = detail_ping(scene, mean_level(true));
  const auto a = all.ping.pressure.abs2().eval(), b = cut.ping.pressure.abs2().eval();
  const double dark = 1e-6 * a.maxCoeff();
  std::size_t differ = 0, both = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    both += a.data()[i] < dark && b.data()[i] < dark;
    differ += (a.data()[i] < dark) != (b.data()[i] < dark);
  }
  EXPECT_GT(both, 1000U);
  EXPECT_LT(50 * differ, both);
}

// Nodes are four cells of range wide there, and a node is seen whole or not at all. If nodes hid as widely as surfels
// do, shadows would be 1.1 cells longer.
TEST(Detail, leaves_edges_of_shadows_where_they_are) {
  const std::vector<double> off = shadow_edge_errors({.detail_width = usual_detail_width}, true);
  ASSERT_GT(off.size(), 100U);
  EXPECT_NEAR(std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size()), 0, 0.3);
  EXPECT_LT(std::abs(off[off.size() / 2]), 1.8);
  EXPECT_LT(std::abs(off[off.size() * 95 / 100]), 3);
}

// There all surfels make shadows 0.4 cells longer.
TEST(Detail, has_the_shadows_of_all_surfels_where_silhouettes_are_sharp) {
  const std::vector<double> off = shadow_edge_errors({.detail_width = usual_detail_width});
  ASSERT_GT(off.size(), 100U);
  EXPECT_NEAR(std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size()), 0.4, 0.1);
  EXPECT_LT(std::abs(off[off.size() / 2]), 0.6);
  EXPECT_LT(std::abs(off[off.size() * 95 / 100]), 1);
}

// Strips as wide as a node, in any direction: half of what the head sees are edges. If nodes were not divided at
// silhouettes, one cell in a hundred would be off by 10 dB.
TEST(Detail, keeps_the_levels_behind_a_fence) {
  SceneCloud scene;
  add_rectangle(scene, {9, -8, -2}, {0, 16, 0}, {0, 0, 4}, {-1, 0, 0}, 0.02);
  std::mt19937 random(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int k = 0; k < 80; ++k) {
    const double turn = between(-0.6, 0.6), lean = between(-0.3, 0.3);
    const Eigen::Vector3d across = 0.2 * Eigen::Vector3d(std::sin(turn), std::cos(turn), 0);
    const Eigen::Vector3d up = 2.5 * Eigen::Vector3d(0, std::sin(lean), std::cos(lean));
    add_rectangle(scene, {between(4, 8), between(-5, 5), -1.25}, across, up, up.cross(across).normalized(), 0.02);
  }
  const auto levels = [&](const SceneCloud& pinged, bool detail) {
    return detail_ping(pinged, mean_level(detail), Pose::Identity()).ping.pressure.abs2().cast<double>().eval();
  };
  const Grid<double> exact = levels(scene, false), sharp = levels(scene, true);
  EXPECT_LT(difference(sharp, exact).second, 0.001);
  EXPECT_LT(std::abs(worst_band(sharp, exact)), 0.1);
  // In a large scene without noise, silhouettes stay coarse.
  scene.part_of = whole_of(scene);
  scene.part_of->surfels = 1 << 20;
  EXPECT_GT(difference(levels(scene, true), exact).second, 0.004);
}

TEST(Detail, hides_nothing_of_a_scan_from_its_own_viewpoint) {
  const SceneCloud wall = make_built_in_scene("wall", {.points = 300000, .size = {20, 6}});
  const SamplingReport seen =
      detail_ping(wall, mean_level(true), Pose(Eigen::Translation3d(-12, 0, 1))).report.sampling;
  EXPECT_LT(seen.hidden, seen.in_gate / 200);
}

TEST(Detail, gives_the_same_bytes_for_any_threads) {
  const SceneCloud scene = detail_harbour(100000);
  SimulationOptions one{.sampling = {.detail_width = usual_detail_width}, .threads = 1},
      three{.sampling = {.detail_width = usual_detail_width}, .threads = 3};
  const SimulatedPing a = detail_ping(scene, one), b = detail_ping(scene, three);
  EXPECT_TRUE((a.ping.pressure == b.ping.pressure).all());
  EXPECT_EQ(a.soundings.true_surfel, b.soundings.true_surfel);
}

TEST(Detail, names_surfels_of_the_scene_and_its_labels) {
  const SceneCloud scene = detail_harbour(300000);
  SimulationOptions options{.outputs = {.contributors = 1}};
  const SimulatedPing all = detail_ping(scene, options);
  options.sampling.detail_width = usual_detail_width;
  const SimulatedPing cut = detail_ping(scene, options);
  const Contributors& named = cut.outputs.contributors;
  std::size_t known = 0;
  for (std::size_t k = 0; k < named.surfel.size(); ++k)
    if (named.surfel[k] != Contributors::none) {
      ++known;
      ASSERT_LT(named.surfel[k], scene.size());
      ASSERT_EQ(named.id[k], scene.id[named.surfel[k]]);
      ASSERT_EQ(named.material[k], scene.material[named.surfel[k]]);
    }
  EXPECT_GT(known, 10000U);
  const auto& before = all.ping.labels.material;
  const auto& after = cut.ping.labels.material;
  EXPECT_LT(static_cast<double>((before != after).count()), 0.01 * static_cast<double>(before.size()));
}

TEST(Detail, is_counted_as_it_is_pinged) {
  const PreparedScene scene(detail_harbour(100000));
  const PingSimulator simulator(detail_head, {}, {.sampling = {.detail_width = usual_detail_width}});
  const SamplingReport counted = simulator.count(scene, {over_the_scene}),
                       pinged = simulator.ping(scene, {over_the_scene}).report.sampling;
  EXPECT_EQ(counted.surfels, scene.scene().size());
  EXPECT_EQ(counted.merged_to, pinged.merged_to);
  EXPECT_EQ(counted.scatterers, pinged.scatterers);
}

TEST(Detail, is_off_where_nothing_can_be_merged) {
  SimulationOptions options{.sampling = {.detail_width = usual_detail_width}};
  EXPECT_EQ(detail_ping({}, options).report.sampling.merged_to, 0U);
  options.outputs.scatterers = true;
  const SimulatedPing named = detail_ping(detail_harbour(20000), options);
  EXPECT_EQ(named.report.sampling.merged_to, 0U);
  options.outputs = {.mask = true};
  EXPECT_EQ(detail_ping(detail_harbour(20000), options).report.sampling.merged_to, 0U);
}

TEST(Detail, is_a_row_of_the_plan) {
  const auto row = [](bool detail) {
    for (const PlannedStage& stage : plan_ping(detail_harbour(20000), detail_head, {over_the_scene}, {},
                                               {.sampling = {.detail_width = detail ? usual_detail_width : 0}})
                                         .stages)
      if (stage.name == "detail") return stage.included;
    throw std::runtime_error("no row");
  };
  EXPECT_TRUE(row(true));
  EXPECT_FALSE(row(false));
}
