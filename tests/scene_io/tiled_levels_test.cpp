// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail in a .tiles file.
#include "sampling/scene_cut.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/tile_writer.hpp"
#include "scene_io/tiled_scene.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "test_files.hpp"

namespace {

const Pose nose_down = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);

/// What a head of 64 beams of two degrees reaches.
struct FanReach {
  BeamFan fan = small_head({}).fan;
  RangeGate gate{0.5, 20, 0.05};
  InsonifiedRegion region;
  CutOptions options{0.5, 0, 0.1};
  explicit FanReach(const Pose& pose = nose_down, double max_range = 20) {
    gate.max_range = max_range;
    fan.beam_width = radians(2);
    region.world_from_head = pose;
    region.sector = insonified_sector(fan, radians(20));
    region.gate = gate;
  }
};

SceneCloud within(const SceneCloud& scene, const FanReach& reach, float largest_area) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < scene.size(); ++i)
    if (may_intersect(reach.region, scene.origin + scene.point[i].cast<double>(), 0, largest_area)) near.push_back(i);
  return subset(scene, near);
}

/// Cuts the whole scene and its tiles, and expects the same within reach; returns the share of the file that was read.
double expect_same_cut(const SceneCloud& scene, const FanReach& reach, const TileWriterOptions& writing = {}) {
  save_tiles(own_path("levels.tiles"), scene, writing);
  const TiledScene tiled(own_path("levels.tiles"));
  const float largest = whole_of(scene).largest_area;
  const SceneCut whole = cut_scene(PreparedScene(scene), reach.region, reach.fan, reach.gate, reach.options);
  const TiledCut part = tiled.cut(reach.region, reach.fan, reach.gate, reach.options);
  const SceneCloud a = within(whole.scene.scene(), reach, largest), b = within(part.scene, reach, largest);
  EXPECT_TRUE(a.point == b.point && a.normal == b.normal && a.area == b.area && a.id == b.id &&
              a.unevenness == b.unevenness && a.material == b.material)
      << a.size() << " " << b.size();
  EXPECT_GT(a.size(), 300U);
  EXPECT_EQ(part.scene.part_of->surfels, scene.size());
  return static_cast<double>(part.bytes) / static_cast<double>(tiled.info().bytes);
}

}  // namespace

TEST(TiledLevels, give_the_cut_of_the_whole_scene_and_read_what_it_needs) {
  const SceneCloud scene = harbour(200000);
  EXPECT_LT(expect_same_cut(scene, FanReach()), 0.4);
  EXPECT_LT(expect_same_cut(scene, FanReach(nose_down, 10)), 0.2);
  TileWriterOptions small;
  small.tile_surfels = 200;
  small.memory = 0;  // groups end within cubes
  expect_same_cut(scene, FanReach(pose_from_yaw_pitch_roll({30, 2, -5}, radians(150), radians(20), radians(5))), small);
  FanReach one_spacing;
  one_spacing.options = {0, 0.6, 0.1};
  expect_same_cut(scene, one_spacing);
}

TEST(TiledLevels, of_rough_ground_whose_surfels_stay_single_are_the_same) {
  expect_same_cut(make_built_in_scene("reef", {.points = 100000}), FanReach(Pose(Eigen::Translation3d(-8, 0, 0))));
  SceneCloud scene = harbour(50000);
  add_surfel(scene, {1500, 3, 0}, Eigen::Vector3d::UnitZ(), 4);
  add_surfel(scene, {5, 3, -700}, Eigen::Vector3d::UnitZ(), 9);
  scene.normals_oriented = false;
  expect_same_cut(scene, FanReach());
}

TEST(TiledLevels, of_what_is_far_are_read_from_coarse_to_fine) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 400000, .size = {30, 30}});
  save_tiles(own_path("plane.tiles"), plane);
  const TiledScene tiled(own_path("plane.tiles"));
  const FanReach reach(pose_from_yaw_pitch_roll({-40, 15, 20}, 0, radians(25), 0), 100);
  const TiledCut coarse = tiled.cut(reach.region, reach.fan, reach.gate, {0.5, 0, 1});
  const TiledCut all = tiled.cut(reach.region, reach.fan, reach.gate, {1e-6, 0, 1});
  EXPECT_LT(20 * coarse.bytes, all.bytes);
  EXPECT_LT(30 * coarse.scene.size(), all.scene.size());
  EXPECT_GT(all.bytes, tiled.info().bytes / 2);
}

TEST(TiledLevels, a_ping_of_them_is_the_ping_of_the_whole_scene) {
  const SceneCloud scene = harbour(100000);
  save_tiles(own_path("a.tiles"), scene);
  const TiledScene tiled(own_path("a.tiles"));
  SimulationOptions options;
  options.sampling.detail_width = 0.5;
  options.outputs.contributors = 3;
  const SonarHead head = small_head({});
  const ResolvedPing ping = resolve_ping(tiled.info().whole, head, {nose_down}, {Water{}}, options);
  const TiledCut cut =
      tiled.cut(ping.region, ping.view.fan, ping.view.gate, {0.5, 0, ping.view.sampling.range_resolution});
  const SimulatedPing all = simulate_ping(scene, head, nose_down, {Water{}}, options);
  const SimulatedPing part = simulate_ping(cut.scene, head, nose_down, {Water{}}, options);
  EXPECT_LT(cut.scene.size(), scene.size() / 2);
  EXPECT_TRUE((part.ping.pressure == all.ping.pressure).all());
  EXPECT_EQ(part.soundings.position, all.soundings.position);
  EXPECT_EQ(part.outputs.contributors.id, all.outputs.contributors.id);
  EXPECT_EQ(part.outputs.contributors.share, all.outputs.contributors.share);
}

TEST(TiledLevels, of_a_scene_100_km_wide_are_those_of_a_small_one) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 100000, .size = {20, 20}});
  const Eigen::Vector3d far(51200, 0, 0);
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector3f& p : plane.point) places.push_back(p.cast<double>() + far);
  places.push_back(-far);
  SceneCloud batch = plane;
  add_surfel(batch, {0, 0, 0}, Eigen::Vector3d::UnitZ(), 0.004);
  TileWriterOptions options;
  options.materials = plane.materials;
  TileWriter writer(own_path("wide.tiles"), options);
  writer.add(batch, places);
  writer.finish();
  save_tiles(own_path("small.tiles"), plane);
  const TiledScene wide(own_path("wide.tiles")), small(own_path("small.tiles"));
  Pose pose = pose_from_yaw_pitch_roll({0, 10, 3}, 0, radians(15), 0);
  const FanReach here(pose);
  pose.pretranslate(far);
  const FanReach there(pose);
  const SceneCloud a = small.cut(here.region, here.fan, here.gate, here.options).scene;
  const SceneCloud b = wide.cut(there.region, there.fan, there.gate, there.options).scene;
  EXPECT_LT(a.size(), plane.size() / 2);
  EXPECT_NEAR(static_cast<double>(b.size()), static_cast<double>(a.size()), 0.02 * static_cast<double>(a.size()));
  EXPECT_NEAR(std::accumulate(b.area.begin(), b.area.end(), 0.0), std::accumulate(a.area.begin(), a.area.end(), 0.0),
              0.5);
  for (const Eigen::Vector3f& p : b.point) EXPECT_LT(std::abs((b.origin.cast<double>() + p.cast<double>()).z()), 1e-3);
}

TEST(TiledLevels, that_are_damaged_or_too_many_are_refused) {
  const SceneCloud scene = harbour(20000);
  save_tiles(own_path("good.tiles"), scene);
  const FanReach reach;
  const auto cut = [&](const std::string& path, double most = 1e9) {
    return TiledScene(path).cut(reach.region, reach.fan, reach.gate, reach.options, most);
  };
  expect_error(ErrorKind::memory, {"good.tiles", "surfels and nodes", "raise the limit"},
               [&] { cut(own_path("good.tiles"), 10); });
  // The area of a node that is pinged stands in the file.
  const SceneCloud found = cut(own_path("good.tiles")).scene;
  std::string bytes = file_bytes(own_path("good.tiles"));
  std::size_t damaged = 0;
  for (std::size_t i = 0; i < found.size() && damaged == 0; ++i) {
    if (std::count(scene.point.begin(), scene.point.end(), found.point[i]) > 0) continue;
    const std::string point(reinterpret_cast<const char*>(found.point[i].data()), 12);
    damaged = bytes.find(point);
  }
  ASSERT_LT(damaged, bytes.size());
  bytes[damaged] = static_cast<char>(bytes[damaged] ^ 1);
  expect_error(ErrorKind::content, {"bad.tiles", "level", "is damaged: its checksum is wrong"},
               [&] { cut(own_file("bad.tiles", bytes)); });
}
