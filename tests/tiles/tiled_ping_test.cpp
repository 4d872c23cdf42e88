// SPDX-License-Identifier: BSD-3-Clause
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"
#include "tiles/tile_writer.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

const Pose& harbour_pose() {
  static const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  return pose;
}

/// Returns options for small tiles, so that small scenes have many.
TileWriterOptions few_tiles() { return {.tile_surfels = 200}; }

/// Pings the whole scene and the part loaded from a .tiles file, and expects identical bits.
void expect_same_ping(const SceneCloud& whole, const Pose& pose, const Environment& environment,
                      SimulationOptions options, double most_of_the_scene) {
  options.outputs.scatterers = true;
  const std::string path = own_path("part.tiles");
  save_tiles(path, whole, few_tiles());
  const TiledScene tiled(path);
  const SonarHead head = small_head({});
  const TileSelection selection =
      tiled.select(resolve_ping(tiled.info().whole, head, {pose}, environment, options).region);
  EXPECT_LT(static_cast<double>(selection.surfels), most_of_the_scene * static_cast<double>(whole.size()));
  const SimulatedPing all = simulate_ping(whole, head, pose, environment, options);
  const SimulatedPing part = simulate_ping(tiled.load(selection), head, pose, environment, options);
  EXPECT_GT(all.outputs.scatterers.size(), 100U);
  EXPECT_EQ(part.outputs.scatterers.id, all.outputs.scatterers.id);
  EXPECT_EQ(part.outputs.scatterers.range, all.outputs.scatterers.range);
  EXPECT_EQ(part.outputs.scatterers.azimuth, all.outputs.scatterers.azimuth);
  EXPECT_TRUE((part.ping.pressure == all.ping.pressure).all());
  EXPECT_EQ(part.soundings.position, all.soundings.position);
  EXPECT_EQ(part.report.layers.back().echoes, all.report.layers.back().echoes);
}

}  // namespace

TEST(TiledPing, ping_of_the_part_is_the_ping_of_the_whole) {
  expect_same_ping(harbour(), harbour_pose(), {Water{}}, {}, 0.4);
}

TEST(TiledPing, of_a_noisy_scan_is_the_same) {
  SceneCloud scene = harbour();
  for (std::size_t i = 0; i < scene.size(); ++i) scene.noise.push_back(i % 3 == 0 ? 0.3F : 0.01F);
  expect_same_ping(scene, harbour_pose(), {Water{}}, {}, 0.4);
}

TEST(TiledPing, ping_from_within_the_scene_is_the_same) {
  expect_same_ping(harbour(), pose_from_yaw_pitch_roll({30, 2, -5}, radians(150), radians(20), radians(5)), {Water{}},
                   {.sampling = {.scatterers_per_cell = 3}}, 0.6);
}

TEST(TiledPing, rays_meet_the_same_surfels) {
  expect_same_ping(harbour(), harbour_pose(), {Water{}},
                   {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 32}}, 0.4);
}

TEST(TiledPing, relief_and_gate_are_those_of_the_whole_scene) {
  SceneCloud scene = harbour();
  for (Material& m : scene.materials) m.relief_slope = 0.2;
  // The largest surfel, though far away, determines how far beyond the gate parts of surfels may lie.
  add_surfel(scene, {500, 0, 0}, Eigen::Vector3d::UnitZ(), 25.0);
  expect_same_ping(scene, harbour_pose(), {Water{}}, {}, 0.6);
}

TEST(TiledPing, multipath_is_the_same_from_all_sides) {
  Environment environment{Water{}};
  environment.surface = SeaSurface{.rms_height = 0.0};
  environment.bottom = FlatBottom{.height = -8.5};
  expect_same_ping(harbour(), harbour_pose(), environment,
                   {.sampling = {.scatterers_per_cell = 2}, .effects = {.multipath = Choice::always}}, 0.9);
}

TEST(TiledPing, utm_coordinates_keep_their_millimetres) {
  SceneCloud scene = harbour();
  scene.origin = {431234, 5412345, 12};
  Pose pose = harbour_pose();
  pose.translation() += scene.origin;
  expect_same_ping(scene, pose, {Water{}}, {.sampling = {.scatterers_per_cell = 2}}, 0.4);
}
