// SPDX-License-Identifier: BSD-3-Clause
// Tests which pings of one scene merge its surfels (E185): many of a large scene, and not a few.
#include <random>

#include "scene/built_in_scenes.hpp"
#include "simulate/ping_simulator.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

const Pose over_many = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);

PingSimulator simulator_for_many(SimulationOptions options = {}, int display_bins = 100) {
  options.outputs.display_bins = display_bins;
  return PingSimulator(small_head({.min_range = 1, .max_range = 25}), {}, options);
}

const PreparedScene& large_harbour() {
  static const PreparedScene scene(make_built_in_scene("harbour", {.points = 600000}));
  return scene;
}

Choice detail_for(std::size_t pings, const PreparedScene& scene, const SimulationOptions& options = {},
                  int display_bins = 100) {
  return simulator_for_many(options, display_bins).for_many(pings, scene, {over_many}).options().sampling.detail;
}

/// A wall behind a fence, in a large scene, whose silhouettes stay coarse.
PreparedScene wall_behind_a_fence() {
  SceneCloud scene;
  add_rectangle(scene, {9, -8, -2}, {0, 16, 0}, {0, 0, 4}, {-1, 0, 0}, 0.02);
  std::mt19937 random(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int k = 0; k < 120; ++k)
    add_rectangle(scene, {between(4, 8), between(-5, 5), -1.5}, {0, 0.15, 0}, {0, 0, 3}, {-1, 0, 0}, 0.02);
  scene.part_of = whole_of(scene);
  scene.part_of->surfels = 1 << 20;
  return PreparedScene(std::move(scene));
}

}  // namespace

TEST(ForMany, merges_surfels_where_it_pays) { EXPECT_EQ(detail_for(100, large_harbour()), Choice::always); }

TEST(ForMany, leaves_a_few_pings_and_small_scenes_as_they_are) {
  EXPECT_EQ(detail_for(8, large_harbour()), Choice::as_needed);
  EXPECT_EQ(detail_for(100, PreparedScene(make_built_in_scene("harbour", {.points = 100000}))), Choice::as_needed);
}

TEST(ForMany, leaves_what_is_asked_for_and_outputs_that_list_surfels) {
  EXPECT_EQ(detail_for(100, large_harbour(), {.sampling = {.detail = Choice::never}}), Choice::never);
  EXPECT_EQ(detail_for(100, large_harbour(), {.sampling = {.detail_spacing = 0.1}}), Choice::as_needed);
  EXPECT_EQ(detail_for(100, large_harbour(), {.outputs = {.scatterers = true}}), Choice::as_needed);
}

// Repeated passes need the same scatterers.
TEST(ForMany, leaves_pressures_as_they_are) {
  EXPECT_EQ(detail_for(100, large_harbour(), {}, 0), Choice::as_needed);
  EXPECT_EQ(detail_for(100, large_harbour(), {.synthesis = {.phases = true}}), Choice::as_needed);
}

TEST(ForMany, follows_from_neither_threads_nor_the_display) {
  for (const int threads : {1, 3}) EXPECT_EQ(detail_for(100, large_harbour(), {.threads = threads}), Choice::always);
  EXPECT_EQ(detail_for(100, large_harbour(), {}, 50), Choice::always);
}

// Nodes as wide as the strips of a fence are received as a whole or not at all.
TEST(ForMany, leaves_surfels_where_nodes_are_off_in_a_band) {
  const PingSimulator decided = simulator_for_many().for_many(100, wall_behind_a_fence(), {Pose::Identity()});
  EXPECT_EQ(decided.options().sampling.detail, Choice::never);
}

TEST(ForMany, merges_as_where_it_is_asked_for) {
  const PingSimulator decided = simulator_for_many().for_many(100, large_harbour(), {over_many}),
                      requested = simulator_for_many({.sampling = {.detail_width = usual_detail_width}});
  const SimulatedPing a = decided.ping(large_harbour(), {over_many}), b = requested.ping(large_harbour(), {over_many});
  EXPECT_GT(a.report.sampling.merged_to, 0U);
  EXPECT_TRUE((a.ping.pressure == b.ping.pressure).all());
}

// A ping alone is that of all surfels, whatever a decision would be.
TEST(ForMany, keeps_the_bytes_of_a_single_ping) {
  const PingEvent event{over_many};
  const SimulatedPing alone = simulator_for_many().ping(large_harbour(), event),
                      all = simulator_for_many({.sampling = {.detail = Choice::never}}).ping(large_harbour(), event);
  EXPECT_EQ(alone.report.sampling.merged_to, 0U);
  EXPECT_TRUE((alone.ping.pressure == all.ping.pressure).all());
}
