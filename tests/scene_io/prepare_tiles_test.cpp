// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/prepare_tiles.hpp"

#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "support/tile_parts.hpp"
#include "test_files.hpp"
#include "tile_batches.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

/// Prepares `cloud` in batches. Expects in the tiles what load_scene makes of the file.
PreparedTiles expect_as_loaded(const std::string& cloud, PrepareTilesOptions options = in_batches()) {
  const PreparedTiles prepared = prepare_tiles(cloud, own_path("out.tiles"), options);
  EXPECT_TRUE(prepared.streamed);
  const LoadedScene loaded = load_scene(cloud, options.load);
  expect_same_surfels(load_all(own_path("out.tiles")), loaded.scene);
  EXPECT_EQ(prepared.report.points_read, loaded.report.points_read);
  EXPECT_EQ(prepared.report.dropped_not_finite, loaded.report.dropped_not_finite);
  EXPECT_EQ(prepared.report.dropped_duplicates, loaded.report.dropped_duplicates);
  EXPECT_EQ(prepared.report.outside_intervals, loaded.report.outside_intervals);
  return prepared;
}

/// Rows x y z nx ny nz area label of a PLY; coordinates double.
struct Row {
  double x, y, z;
  float nx = 0, ny = 0, nz = 1, area = 0.01F;
  std::uint8_t label = 0;
};

std::string ply_of(const std::vector<Row>& rows, bool big, bool with_area = true, const std::string& name = "in.ply") {
  std::string text = "ply\nformat binary_" + std::string(big ? "big" : "little") + "_endian 1.0\n";
  text += "element extra 2\nproperty short a\nelement vertex " + std::to_string(rows.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += std::string("property double ") + axis + "\n";
  for (const char* axis : {"nx", "ny", "nz"}) text += std::string("property float ") + axis + "\n";
  if (with_area) text += "property float area\n";
  text += "property uchar classification\nend_header\n";
  text += bytes_of<std::int16_t>(1, big) + bytes_of<std::int16_t>(2, big);
  for (const Row& r : rows) {
    text += bytes_of(r.x, big) + bytes_of(r.y, big) + bytes_of(r.z, big);
    text += bytes_of(r.nx, big) + bytes_of(r.ny, big) + bytes_of(r.nz, big);
    if (with_area) text += bytes_of(r.area, big);
    text += bytes_of(r.label, big);
  }
  return own_file(name, text);
}

std::vector<Row> plate(int side) {
  std::vector<Row> rows;
  for (int i = 0; i < side * side; ++i)
    rows.push_back({431000.0 + 0.1 * (i % side), 5412000.0 + 0.1 * (i / side) + 0.013 * (i % 7), 3.5});
  return rows;
}

}  // namespace

TEST(PrepareTiles, a_prepared_ply_or_pcd_comes_back_bit_by_bit) {
  SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  save_scene(own_path("a.pcd"), scene);
  expect_as_loaded(own_path("a.pcd"));
  scene.origin = {431000, 5412000, 0};
  save_scene(own_path("a.ply"), scene);
  const PreparedTiles prepared = expect_as_loaded(own_path("a.ply"));
  EXPECT_EQ(prepared.report.format, "PLY binary_little_endian");
  EXPECT_EQ(prepared.tiles.surfels, scene.size());
}

// Every column that changes a ping is found by pinging.
TEST(PrepareTiles, a_ping_of_the_tiles_has_the_bytes_of_that_of_the_cloud_for_every_column) {
  const SonarHead head = small_head({.max_range = 40});
  const auto samples = [&](const SceneCloud& scene) {
    return simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0), {Water{}}).ping.pressure;
  };
  const SceneCloud base = make_built_in_scene("harbour", {.points = 20000});
  const std::vector<std::pair<std::string, std::function<void(SceneCloud&)>>> columns = {
      {"point",
       [](SceneCloud& s) {
         for (auto& p : s.point) p.z() += 0.25F;
       }},
      {"normal",
       [](SceneCloud& s) {
         for (auto& n : s.normal) n = (n + Eigen::Vector3f(0.2F, 0, 0)).normalized();
       }},
      {"area",
       [](SceneCloud& s) {
         for (auto& a : s.area) a *= 2;
       }},
      {"material",
       [](SceneCloud& s) {
         for (auto& m : s.material) m = 0;
       }},
      {"id",
       [](SceneCloud& s) {
         for (auto& id : s.id) id = 2 * id + 1;
       }},
      {"noise",
       [](SceneCloud& s) {
         for (std::size_t i = 0; i < s.size(); ++i) s.noise.push_back(i % 3 ? 3 : 0);
       }},
  };
  const ComplexGridF before = samples(base);
  for (const auto& [name, change] : columns) {
    SceneCloud scene = base;
    change(scene);
    save_scene(own_path("column.ply"), scene);
    const ComplexGridF of_cloud = samples(load_scene(own_path("column.ply")).scene);
    EXPECT_FALSE((of_cloud == before).all()) << name;
    for (const bool streamed : {true, false}) {
      prepare_tiles(own_path("column.ply"), own_path("column.tiles"), streamed ? in_batches() : PrepareTilesOptions{});
      EXPECT_TRUE((samples(load_all(own_path("column.tiles"))) == of_cloud).all()) << name << " " << streamed;
    }
  }
}

TEST(PrepareTiles, noise_of_no_number_is_taken_as_none_and_said) {
  const std::string cloud = own_path("noise.ply");
  SceneCloud scene = make_built_in_scene("plane", {.points = 100});
  scene.noise.assign(scene.size(), 0.125F);
  save_scene(cloud, scene);
  std::string bytes = file_bytes(cloud);
  bytes.replace(bytes.size() - 4, 4, bytes_of(-1.0F));  // noise is the last column
  std::ofstream(cloud, std::ios::binary) << bytes;
  const PreparedTiles prepared = prepare_tiles(cloud, own_path("noise.tiles"), in_batches());
  EXPECT_THAT(prepared.report.notes, testing::Contains(HasSubstr("were negative or NaN: taken as 0")));
  const SceneCloud kept = load_all(own_path("noise.tiles"));
  EXPECT_EQ(std::count(kept.noise.begin(), kept.noise.end(), 0.125F), 99);
  EXPECT_EQ(std::count(kept.noise.begin(), kept.noise.end(), 0.0F), 1);
}

// From file to prepared cloud, to tiles, and back.
TEST(PrepareTiles, the_coordinate_system_is_kept_by_all_prepared_files) {
  const std::string system = "EPSG:32632 (WGS 84 / UTM zone 32N)";
  SceneCloud scene = make_built_in_scene("plane", {.points = 100});
  for (const std::string name : {"system.ply", "system.pcd"}) {
    SceneColumns columns;
    columns.system = system;
    save_scene(own_path(name), scene, columns);
    const LoadedScene loaded = load_scene(own_path(name));
    EXPECT_EQ(loaded.report.meaning.system.value, system) << name;
    save_scene(own_path("again.ply"), loaded);
    EXPECT_EQ(load_scene(own_path("again.ply")).report.meaning.system.value, system);
    for (const bool streamed : {true, false}) {
      prepare_tiles(own_path(name), own_path("system.tiles"), streamed ? in_batches() : PrepareTilesOptions{});
      EXPECT_EQ(TiledScene(own_path("system.tiles")).info().system, system) << name << " " << streamed;
      const LoadedScene back = load_scene(own_path("system.tiles"));
      EXPECT_EQ(back.report.meaning.system.value, system);
      save_scene(own_path("back.ply"), back);
      EXPECT_EQ(load_scene(own_path("back.ply")).report.meaning.system.value, system);
    }
  }
}

TEST(PrepareTiles, triangles_of_a_prepared_height_field_are_passed_over_and_those_of_a_mesh_sampled) {
  std::string points = "-0.5 0.5 0\n";
  for (int i = 0; i < 400; ++i)
    points += std::to_string(i % 20 + 0.3 * std::sin(i)) + " " + std::to_string(i / 20 + 0.3 * std::cos(2 * i)) + " " +
              std::to_string(std::sin(0.3 * i / 20)) + "\n";
  LoadOptions from_above;
  from_above.viewpoint = Eigen::Vector3d(0, 0, 1000);
  const LoadedScene heights = load_scene(own_file("bed.xyz", points), from_above);
  save_scene(own_path("bed.ply"), heights);
  ASSERT_NE(file_bytes(own_path("bed.ply")).find("element face"), std::string::npos);
  EXPECT_EQ(expect_as_loaded(own_path("bed.ply")).tiles.surfels, heights.scene.size());

  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n";
  save_scene(own_path("mesh.ply"), load_scene(own_file("text.ply", text)));
  const PreparedTiles prepared = prepare_tiles(own_path("mesh.ply"), own_path("mesh.tiles"), in_batches());
  EXPECT_FALSE(prepared.streamed);
  EXPECT_NEAR(prepared.tiles.total_area, 0.5, 1e-6);
}

TEST(PrepareTiles, both_byte_orders_doubles_and_labels_are_read_as_load_scene_reads_them) {
  std::vector<Row> rows = plate(60);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].label = static_cast<std::uint8_t>(i % 3);
  rows[5].nz = 4;  // to be scaled
  for (const bool big : {false, true}) {
    const PreparedTiles prepared = expect_as_loaded(ply_of(rows, big));
    EXPECT_EQ(prepared.report.material_field, "classification");
  }
  PrepareTilesOptions options = in_batches();
  options.load.meaning.unit = 0.001;
  expect_as_loaded(ply_of(rows, true), options);
  options.load.meaning.unit.reset();
  options.load.materials = {{"mud", 0.01}, {"rock", 0.1}};
  options.load.material_field.intervals = {{0, 1, 1}, {1, 2, 0}};  // 2 lies in none
  EXPECT_EQ(expect_as_loaded(ply_of(rows, false), options).report.outside_intervals, rows.size() / 3);
  options.load.material_field.intervals.clear();
  options.load.material = std::uint16_t{1};
  expect_as_loaded(ply_of(rows, false), options);
}

TEST(PrepareTiles, points_that_cannot_be_used_are_dropped_and_counted) {
  std::vector<Row> rows = plate(50);
  rows[7].x = NAN;
  rows[8].z = 1e12;
  rows.push_back(rows[3]);
  rows.push_back(rows[4]);
  rows.push_back(rows[4]);
  expect_as_loaded(ply_of(rows, false));
  // Without a normal: load_scene would repair these.
  rows[20].nz = 0;
  rows[21].nx = NAN;
  const PreparedTiles prepared = prepare_tiles(ply_of(rows, false), own_path("b.tiles"), in_batches());
  EXPECT_EQ(prepared.report.dropped_not_finite, 2U);
  EXPECT_EQ(prepared.report.dropped_duplicates, 3U);
  EXPECT_EQ(prepared.report.dropped_without_normal, 2U);
  EXPECT_EQ(prepared.tiles.surfels, 2500U - 4);
  // Dropping renumbers nobody.
  const SceneCloud scene = load_all(own_path("b.tiles"));
  EXPECT_EQ(std::count(scene.id.begin(), scene.id.end(), 20U), 0);
  EXPECT_EQ(scene.id.back(), 2499U);
}

TEST(PrepareTiles, missing_areas_are_found) {
  const PreparedTiles prepared = prepare_tiles(ply_of(plate(80), false, false), own_path("a.tiles"), in_batches());
  EXPECT_TRUE(prepared.report.areas_estimated);
  EXPECT_NEAR(prepared.tiles.total_area, 64, 0.03 * 64);  // 80 x 80 cells of 0.1 m
  std::vector<Row> rows = plate(80);
  rows[100].area = -1;
  const PreparedTiles again = prepare_tiles(ply_of(rows, false), own_path("a.tiles"), in_batches());
  EXPECT_TRUE(again.report.areas_estimated);
  EXPECT_THAT(again.report.notes.front(), HasSubstr("1 of 6400 areas"));
  EXPECT_NEAR(again.tiles.total_area, prepared.tiles.total_area, 1e-6);
}

TEST(PrepareTiles, small_files_are_completed_as_a_whole) {
  const std::string path = own_file("a.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 1 0\n2 0 0\n");
  const PreparedTiles prepared = prepare_tiles(path, own_path("a.tiles"));
  EXPECT_FALSE(prepared.streamed);
  EXPECT_TRUE(prepared.report.normals_estimated);
  expect_same_surfels(load_all(own_path("a.tiles")), load_scene(path).scene);
}

TEST(PrepareTiles, what_cannot_be_prepared_is_refused) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n";
  for (const char* axis : {"x", "y", "z"}) text += std::string("property float ") + axis + "\n";
  text += "end_header\n" + std::string(12, '\0');
  // Clouds without normals are completed now; a single point has no plane.
  expect_error(ErrorKind::content, {"bare.ply", "give no normal"},
               [&] { prepare_tiles(own_file("bare.ply", text), own_path("a.tiles"), in_batches()); });
  expect_error(ErrorKind::content, {"cut off"}, [&] {
    prepare_tiles(own_file("cut.ply", text.substr(0, text.size() - 1)), own_path("a.tiles"), in_batches());
  });
  std::vector<Row> rows = plate(3);
  for (Row& r : rows) r.y = NAN;
  expect_error(ErrorKind::content, {"no usable point"},
               [&] { prepare_tiles(ply_of(rows, false), own_path("a.tiles"), in_batches()); });
  EXPECT_FALSE(std::filesystem::exists(own_path("a.tiles")));
}

TEST(PrepareTiles, giving_up_leaves_nothing) {
  struct Stop {};
  PrepareTilesOptions options = in_batches();
  options.progress = [](double part) {
    if (part > 0.6) throw Stop{};
  };
  const std::string cloud = ply_of(plate(50), false);
  const auto files = [] {
    const auto all = std::filesystem::directory_iterator(own_folder());
    return std::distance(begin(all), end(all));
  };
  const auto before = files();
  EXPECT_THROW(prepare_tiles(cloud, own_path("a.tiles"), options), Stop);
  EXPECT_EQ(files(), before);
}

TEST(PrepareTiles, a_damaged_row_is_named_when_tiles_are_loaded_as_a_scene) {
  save_tiles(own_path("good.tiles"), harbour(2000));
  TileParts parts = load_tile_parts(own_path("good.tiles"));
  parts.rows.area[1234] = -2;
  save_tile_parts(parts, own_path("bad.tiles"));
  expect_error(ErrorKind::content, {"bad.tiles: row 1234: area = -2 m^2, must be"},
               [] { load_scene(own_path("bad.tiles")); });
}
