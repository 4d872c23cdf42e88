// SPDX-License-Identifier: BSD-3-Clause
// Patches that are made chunk by chunk give the same ping as those that are stored, to the byte.
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

const SonarHead head_at_rest = small_head({.max_range = 20});

void expect_same_stored(const SceneCloud& scene, SimulationOptions options, const Pose& pose,
                        const SonarHead& head = head_at_rest, std::size_t least = 100000, const Motion& motion = {}) {
  const PingEvent event{pose, motion};
  const SimulatedPing streamed = simulate_event(scene, head, event, {}, options);
  options.outputs.scatterers = true;
  const SimulatedPing stored = simulate_event(scene, head, event, {}, options);
  EXPECT_EQ(streamed.outputs.scatterers.size(), 0U);
  EXPECT_EQ(stored.outputs.scatterers.size(), streamed.report.sampling.scatterers);
  EXPECT_GT(streamed.report.sampling.scatterers, least);
  EXPECT_GT(streamed.ping.pressure.abs().maxCoeff(), 0);
  EXPECT_TRUE((streamed.ping.pressure == stored.ping.pressure).all());
  EXPECT_GT(streamed.soundings.size(), 10U);
  EXPECT_EQ(streamed.soundings.bin, stored.soundings.bin);
  EXPECT_EQ(streamed.soundings.position, stored.soundings.position);
  EXPECT_EQ(streamed.soundings.true_surfel, stored.soundings.true_surfel);
}

}  // namespace

TEST(StreamedPing, is_the_stored_one_for_each_shape_of_pulse_and_any_threads) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  for (const int order : {0, 2})
    for (const int threads : {1, 3})
      expect_same_stored(scene,
                         {.sampling = {.scatterers_per_cell = 40},
                          .synthesis = {.true_delays = Choice::never},
                          .effects = {.absorption_order = order},
                          .threads = threads},
                         pose);
}

TEST(StreamedPing, is_the_stored_one_with_relief_detections_everywhere_and_in_double) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 20000, .size = {30, 30}});
  for (Material& material : scene.materials) material.relief_slope = 0.2;
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0);
  SimulationOptions options{.sampling = {.scatterers_per_cell = 60},
                            .synthesis = {.true_delays = Choice::never},
                            .detection = {.all_bins = true}};
  expect_same_stored(scene, options, pose);
  options.synthesis.tolerance = 1e-7;
  expect_same_stored(scene, options, pose);
}

TEST(StreamedPing, of_true_delays_is_the_stored_one_for_each_shape_of_pulse_and_any_threads) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  for (const int order : {0, 2})
    expect_same_stored(scene,
                       {.sampling = {.scatterers_per_cell = 10},
                        .synthesis = {SynthesisMethod::true_delays},
                        .effects = {.absorption_order = order},
                        .threads = order + 1},
                       pose, head_at_rest, 30000);
}

// Echoes nearer than blocks reach are summed element by element; those beside the fan lie on a wider grid.
TEST(StreamedPing, of_true_delays_is_the_stored_one_close_by_and_beside_the_fan) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 20000, .size = {6, 6}});
  const Pose pose = pose_from_yaw_pitch_roll({2, 0, 0.35}, 0, radians(30), 0);
  const SonarHead close = small_head({.field_of_view_deg = 40, .min_range = 0.3, .max_range = 3});
  expect_same_stored(scene,
                     {.sampling = {.scatterers_per_cell = 1, .outer_azimuths = Choice::always},
                      .synthesis = {SynthesisMethod::true_delays, 1e-3}},
                     pose, close, 5000);
}

TEST(StreamedPing, is_the_stored_one_of_a_head_that_moves_and_turns) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  SimulationOptions options{.sampling = {.scatterers_per_cell = 60}, .threads = 3};
  options.effects.moving = Choice::always;
  for (const Choice true_delays : {Choice::never, Choice::always}) {
    options.synthesis.true_delays = true_delays;
    expect_same_stored(scene, options, pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0), head_at_rest, 100000,
                       {{13, -4, 1}, {0.1, 0.2, -0.9}});
  }
}

// Tables for beams are made at the first ping and kept; pings that follow have the bytes of single ones.
TEST(StreamedPing, of_many_pings_that_share_what_forms_their_beams_are_single_pings) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  const PreparedScene prepared(scene);
  const SimulationOptions options{.synthesis = {.tolerance = 1e-3}, .outputs = {.split_phase = true}};
  const PingSimulator simulator(head_at_rest, {}, options);
  for (const double yaw : {0.0, 20.0, -40.0}) {
    const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, radians(yaw), radians(10), 0);
    const SimulatedPing single = simulate_ping(prepared, head_at_rest, pose, {}, options);
    const SimulatedPing shared = simulator.ping(prepared, {pose});
    EXPECT_GT(single.ping.pressure.abs().maxCoeff(), 0);
    EXPECT_TRUE((single.ping.pressure == shared.ping.pressure).all()) << yaw;
    EXPECT_TRUE((single.ping.split_phase == shared.ping.split_phase).all()) << yaw;
    EXPECT_EQ(single.soundings.position, shared.soundings.position) << yaw;
  }
}
