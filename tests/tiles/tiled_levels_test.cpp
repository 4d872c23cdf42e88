// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail in a .tiles file.
#include "sampling/scene_cut.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"
#include "support/tile_parts.hpp"
#include "tiles/tile_writer.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

const Pose nose_down = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);

/// The region that a head of 64 beams of two degrees reaches.
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

/// Cuts the whole scene and its tiles, and expects the same within reach. Returns the fraction of the file that was
/// read.
double expect_same_cut(const SceneCloud& scene, const FanReach& reach, const TileWriterOptions& writing = {}) {
  save_tiles(own_path("levels.tiles"), scene, writing);
  const TiledScene tiled(own_path("levels.tiles"));
  const float largest = whole_of(scene).largest_area;
  const SceneCut whole = cut_scene(PreparedScene(scene), reach.region, reach.fan, reach.gate, reach.options);
  const TiledCut part = tiled.cut(reach.region, reach.fan, reach.gate, reach.options);
  const SceneCloud a = within(whole.scene.scene(), reach, largest), b = within(part.scene, reach, largest);
  EXPECT_TRUE(a.point == b.point && a.normal == b.normal && a.area == b.area && a.id == b.id &&
              a.unevenness == b.unevenness && a.material == b.material && a.noise == b.noise)
      << a.size() << " " << b.size();
  EXPECT_GT(a.size(), 300U);
  EXPECT_EQ(part.scene.part_of->surfels, scene.size());
  return static_cast<double>(part.bytes) / static_cast<double>(tiled.info().bytes);
}

/// Returns all nodes and rows of a file.
SceneCloud finest_cut(const std::string& path) {
  return TiledScene(path).cut(region_around({0, 0, 0}, 1e6), {}, {0.1, 1e6, 1}, {1e-9, 0, 1, 1}).scene;
}

/// Returns a plane of one forest, whose roots are nodes.
TileParts plane_in_parts() {
  save_tiles(own_path("plane.tiles"), make_built_in_scene("plane", {.points = 2000, .size = {4, 4}}));
  return load_tile_parts(own_path("plane.tiles"));
}

/// Returns a forest of one node in each group, `times` a child of the one before. The last node has one row.
TileParts chain_of_nodes(std::uint32_t times) {
  TileParts parts = plane_in_parts();
  const auto rows = static_cast<std::uint32_t>(parts.rows.size());
  TileNode node = parts.node.at(0);
  parts.node.clear(), parts.child.clear();
  TileForest& forest = parts.directory.forests.at(0);
  forest.loose = 0;
  for (std::uint32_t g = 0; g < level_groups; ++g) {
    const bool last = g + 1 == level_groups;
    node.first_child = static_cast<std::uint32_t>(parts.child.size());
    node.children = static_cast<std::uint16_t>(last ? 1 : times);
    for (std::uint32_t k = 0; k < node.children; ++k) parts.child.push_back(last ? 0 : rows + g + 1);
    parts.node.push_back(node);
    forest.node_end[g] = g + 1, forest.child_end[g] = static_cast<std::uint32_t>(parts.child.size());
  }
  return parts;
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
  small.tile_surfels = 20;  // nodes are of several tiles
  expect_same_cut(harbour(50000), one_spacing, small);
}

TEST(TiledLevels, of_a_noisy_scan_keep_the_noise_of_nodes_and_surfels) {
  SceneCloud scene = harbour(100000);
  for (std::size_t i = 0; i < scene.size(); ++i)
    scene.noise.push_back(scene.point[i].x() > 12 ? 0.04F : 0.02F + 1e-4F * static_cast<float>(i % 5));
  expect_same_cut(scene, FanReach());
  const TiledScene tiled(own_path("levels.tiles"));
  EXPECT_TRUE(tiled.info().noisy);
  const FanReach reach;
  const SceneCloud cut = tiled.cut(reach.region, reach.fan, reach.gate, reach.options).scene;
  ASSERT_EQ(cut.noise.size(), cut.size());
  EXPECT_LT(cut.size(), scene.size() / 2);
  const auto [least, most] = std::minmax_element(cut.noise.begin(), cut.noise.end());
  EXPECT_TRUE(*least >= 0.02F && *least < 0.021F && *most == 0.04F) << *least << " " << *most;
}

TEST(TiledLevels, with_values_of_no_noise_are_refused_by_node) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 2000, .size = {4, 4}});
  scene.noise.assign(scene.size(), 0.01F);
  save_tiles(own_path("plane.tiles"), scene);
  for (const float bad : {-1.0F, NAN, 1e31F}) {
    TileParts parts = load_tile_parts(own_path("plane.tiles"));
    parts.noise.at(3) = bad;
    save_tile_parts(parts, own_path("bad.tiles"));
    expect_error(ErrorKind::content, {"bad.tiles: node 3: noise = ", "must be >= 0"},
                 [] { finest_cut(own_path("bad.tiles")); });
  }
}

TEST(TiledLevels, of_rough_ground_whose_surfels_stay_single_are_the_same) {
  expect_same_cut(make_built_in_scene("reef", {.points = 100000}), FanReach(Pose(Eigen::Translation3d(-8, 0, 0))));
  SceneCloud scene = harbour(50000);
  add_surfel(scene, {1500, 3, 0}, Eigen::Vector3d::UnitZ(), 4);
  add_surfel(scene, {5, 3, -700}, Eigen::Vector3d::UnitZ(), 9);
  scene.normals_oriented = false;
  expect_same_cut(scene, FanReach());
}

// There nodes are narrow in some tenths of the ranges (E225).
TEST(TiledLevels, of_waves_that_hide_one_another_are_the_same) {
  SceneCloud waves = make_built_in_scene("plane", {.points = 100000, .size = {20, 10}});
  for (std::size_t i = 0; i < waves.size(); ++i) {
    Eigen::Vector3f& p = waves.point[i];
    waves.normal[i] = Eigen::Vector3f(-0.1F * std::cos(5 * p.x()), 0, 1).normalized();
    p.z() += 0.02F * std::sin(5 * p.x());
  }
  const auto size = [&](double above) {
    const FanReach reach(Pose(Eigen::Translation3d(-2, 0, above)));
    expect_same_cut(waves, reach);
    return cut_scene(PreparedScene(waves), reach.region, reach.fan, reach.gate, reach.options).scene.scene().size();
  };
  EXPECT_GT(size(0.8), 3 * size(6));
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
  std::vector<Eigen::Vector3d> positions;
  for (const Eigen::Vector3f& p : plane.point) positions.push_back(p.cast<double>() + far);
  positions.push_back(-far);
  SceneCloud batch = plane;
  add_surfel(batch, {0, 0, 0}, Eigen::Vector3d::UnitZ(), 0.004);
  TileWriterOptions options;
  options.materials = plane.materials;
  TileWriter writer(own_path("wide.tiles"), options);
  writer.add(batch, positions);
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

TEST(TiledLevels, whose_nodes_or_rows_have_two_parents_are_refused) {
  save_tile_parts(chain_of_nodes(1), own_path("chain.tiles"));
  EXPECT_EQ(finest_cut(own_path("chain.tiles")).size(), 1U);
  // Each row would be walked 8^11 times.
  for (const std::uint32_t times : {2U, 3U, 8U}) {
    save_tile_parts(chain_of_nodes(times), own_path("bad.tiles"));
    expect_error(ErrorKind::content, {"bad.tiles: node 0: its child, node 1, has another parent"},
                 [] { finest_cut(own_path("bad.tiles")); });
  }
  const auto refuse = [](const TileParts& parts, const std::vector<std::string>& said) {
    save_tile_parts(parts, own_path("bad.tiles"));
    expect_error(ErrorKind::content, said, [] { finest_cut(own_path("bad.tiles")); });
  };
  TileParts parts = chain_of_nodes(1);
  parts.child[3] = static_cast<std::uint32_t>(parts.rows.size()) + 5;  // node 4 is passed over
  refuse(parts, {"bad.tiles: node 4: no coarser node has it as a child"});
  parts = chain_of_nodes(1);
  parts.directory.forests[0].loose = 1;  // the child of the first node, a node, would be a root too
  refuse(parts, {"bad.tiles: the roots of the tiles from 0 on are not different rows"});
  parts = chain_of_nodes(1);
  parts.child[3] = static_cast<std::uint32_t>(parts.rows.size()) + 2;
  refuse(parts, {"bad.tiles: node 3: its child", "is neither a row nor a finer node"});

  // Two nodes of the levels as they are written, of which the second takes the children of the first.
  parts = plane_in_parts();
  const auto with_rows = [&](const TileNode& n) {
    return n.children > 0 && parts.child[n.first_child] < parts.rows.size();
  };
  const auto first = std::find_if(parts.node.begin(), parts.node.end(), with_rows);
  ASSERT_NE(first, parts.node.end());
  const auto second = std::find_if(first + 1, parts.node.end(), with_rows);
  ASSERT_NE(second, parts.node.end());
  second->first_child = first->first_child, second->children = 1;
  refuse(parts, {"bad.tiles: node " + std::to_string(second - parts.node.begin()) + ": its child, row " +
                 std::to_string(parts.child[first->first_child]) + ", has another parent"});
}

TEST(TiledLevels, whose_nodes_have_values_of_no_surfel_are_refused) {
  const TileParts good = plane_in_parts();
  save_tile_parts(good, own_path("again.tiles"));
  expect_same_surfels(finest_cut(own_path("again.tiles")), finest_cut(own_path("plane.tiles")));
  const std::vector<std::pair<std::string, std::function<void(TileNode&)>>> damages = {
      {"point = (nan, ", [](TileNode& n) { n.point[0] = NAN; }},
      {"place = (", [](TileNode& n) { n.position[2] = INFINITY; }},
      {"normal = (0, 0, 0), must be a unit vector", [](TileNode& n) { std::fill_n(n.normal, 3, 0.0F); }},
      {"area = -1, must be", [](TileNode& n) { n.area = -1; }},
      {"own_area = 1e+38, must be", [](TileNode& n) { n.own_area = 1e38F; }},
      {"extent = nan, must be", [](TileNode& n) { n.extent = NAN; }},
      {"thickness = inf, must be", [](TileNode& n) { n.thickness = INFINITY; }},
      {"cell = 0, must be", [](TileNode& n) { n.cell = 0; }},
      {"normals = (2, ", [](TileNode& n) { n.normals[0] = 2; }},
      {"material = 9, must be below the number of materials", [](TileNode& n) { n.material = 9; }},
  };
  for (const auto& [said, damage] : damages) {
    TileParts parts = good;
    damage(parts.node.at(7));
    save_tile_parts(parts, own_path("bad.tiles"));
    expect_error(ErrorKind::content, {"bad.tiles: node 7: " + said, "copy or make the file again"},
                 [] { finest_cut(own_path("bad.tiles")); });
  }
}
