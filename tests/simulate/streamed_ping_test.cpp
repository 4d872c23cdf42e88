// Patches that are made chunk by chunk give the same ping as those that are stored, to the byte.
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

const SonarHead streamed_head = small_head({.max_range = 20});

void expect_same_stored(const SceneCloud& scene, SimulationOptions options, const Pose& pose) {
  const SimulatedPing streamed = simulate_ping(scene, streamed_head, pose, {}, options);
  options.outputs.scatterers = true;
  const SimulatedPing stored = simulate_ping(scene, streamed_head, pose, {}, options);
  EXPECT_EQ(streamed.scatterers.size(), 0U);
  EXPECT_EQ(stored.scatterers.size(), streamed.sampling.scatterers);
  EXPECT_GT(streamed.sampling.scatterers, 100000U);
  EXPECT_GT(streamed.ping.pressure.abs().maxCoeff(), 0);
  EXPECT_TRUE((streamed.ping.pressure == stored.ping.pressure).all());
  EXPECT_GT(streamed.soundings.size(), 10U);
  EXPECT_EQ(streamed.soundings.bin, stored.soundings.bin);
  EXPECT_EQ(streamed.soundings.position, stored.soundings.position);
  EXPECT_EQ(streamed.soundings.material, stored.soundings.material);
}

}  // namespace

TEST(StreamedPing, is_the_stored_one_for_each_shape_of_pulse_and_any_threads) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  for (const int order : {0, 2})
    for (const int threads : {1, 3})
      expect_same_stored(
          scene, {.sampling = {.scatterers_per_cell = 40}, .effects = {.absorption_order = order}, .threads = threads},
          pose);
}

TEST(StreamedPing, is_the_stored_one_with_relief_detections_everywhere_and_in_double) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 20000, .size = {30, 30}});
  for (Material& material : scene.materials) material.relief_slope = 0.2;
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0);
  SimulationOptions options{.sampling = {.scatterers_per_cell = 60}, .detection = {.all_bins = true}};
  expect_same_stored(scene, options, pose);
  options.synthesis.tolerance = 1e-7;
  expect_same_stored(scene, options, pose);
}

TEST(StreamedPing, is_the_stored_one_of_a_head_that_moves_and_turns) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  SimulationOptions options{.sampling = {.scatterers_per_cell = 60}, .threads = 3};
  options.effects.moving = Choice::always;
  options.effects.motion = {{13, -4, 1}, {0.1, 0.2, -0.9}};
  expect_same_stored(scene, options, pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0));
}
