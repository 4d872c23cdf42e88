// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/tiled_scene.hpp"

#include "core/random.hpp"
#include "sampling/scene_cut.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"
#include "support/tile_parts.hpp"
#include "tiles/tile_sort_internal.hpp"
#include "tiles/tile_writer.hpp"

namespace {

/// Returns options for small tiles, so that small scenes have many.
TileWriterOptions small_tiles() { return {.tile_surfels = 200}; }

std::size_t files_in_folder() {
  const auto all = std::filesystem::directory_iterator(own_folder());
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

SceneCloud one_point(std::size_t copies = 1) {
  SceneCloud scene;
  for (std::size_t i = 0; i < copies; ++i) add_surfel(scene, {1, 2, -3}, Eigen::Vector3d::UnitZ(), 0.01);
  return scene;
}

}  // namespace

TEST(TiledScene, loading_all_tiles_gives_the_scene_back_bit_by_bit) {
  SceneCloud scene = harbour();
  scene.materials[2] = {"old timber", 0.01, 0.25, 0.125};
  scene.materials[3].law = TableLaw{{0, 1.4}, {}, {-10, -30.1}, true};
  scene.normals_oriented = false;
  const TileReport report = save_tiles(own_path("a.tiles"), scene, small_tiles());
  const TiledScene tiled(own_path("a.tiles"));
  expect_same_surfels(tiled.load(tiled.select_all()), scene);
  EXPECT_EQ(report.surfels, scene.size());
  EXPECT_EQ(tiled.info().surfels, scene.size());
  EXPECT_EQ(tiled.info().tiles, report.tiles);
  EXPECT_GE(report.tiles, scene.size() / 200);
  EXPECT_EQ(tiled.info().box.min, bounds(scene).min);
  EXPECT_EQ(tiled.info().box.max, bounds(scene).max);
  const double area = std::accumulate(scene.area.begin(), scene.area.end(), 0.0);
  EXPECT_EQ(tiled.info().total_area, area);
  EXPECT_EQ(tiled.info().whole.mean_spacing, std::sqrt(area / static_cast<double>(scene.size())));
}

TEST(TiledScene, a_surfel_takes_34_bytes_and_a_little_of_a_tile_entry_and_levels_twice_as_much) {
  const SceneCloud scene = harbour();
  const TileReport report = save_tiles(own_path("a.tiles"), scene);
  EXPECT_EQ(report.bytes, std::filesystem::file_size(own_path("a.tiles")));
  const double levels = 70 * static_cast<double>(scene.size());
  EXPECT_LT(static_cast<double>(report.bytes), 34.1 * static_cast<double>(scene.size()) + 16384 + levels);
}

TEST(TiledScene, file_depends_neither_on_batches_nor_on_threads) {
  const SceneCloud scene = harbour();
  save_tiles(own_path("a.tiles"), scene, small_tiles());
  TileWriterOptions options = small_tiles();
  options.materials = scene.materials;
  options.threads = 3;
  TileWriter writer(own_path("b.tiles"), options);
  for (std::uint32_t first = 0; first < scene.size(); first += 7777) {
    std::vector<std::uint32_t> keep(std::min<std::size_t>(7777, scene.size() - first));
    std::iota(keep.begin(), keep.end(), first);
    writer.add(subset(scene, keep));
  }
  writer.finish();
  EXPECT_EQ(file_bytes(own_path("a.tiles")), file_bytes(own_path("b.tiles")));
}

TEST(TiledScene, little_memory_changes_the_tiles_and_nothing_else) {
  const SceneCloud scene = harbour(100000);  // 15 MB while sorting, which exceeds 1 MiB even after one subdivision
  TileWriterOptions options = small_tiles();
  options.memory = 0;
  save_tiles(own_path("a.tiles"), scene, options);
  const TiledScene tiled(own_path("a.tiles"));
  expect_same_surfels(tiled.load(tiled.select_all()), scene);
}

TEST(TiledScene, tiles_near_a_place_hold_every_surfel_near_it) {
  const SceneCloud scene = harbour();
  save_tiles(own_path("a.tiles"), scene, small_tiles());
  const TiledScene tiled(own_path("a.tiles"));
  const Eigen::Vector3d centre(20, 3, -7);
  const TileSelection selection = tiled.select(region_around(centre, 5));
  EXPECT_LT(selection.surfels, scene.size() / 4);
  const SceneCloud part = tiled.load(selection);
  EXPECT_TRUE(std::is_sorted(part.id.begin(), part.id.end()));
  std::vector<std::uint32_t> wanted, found;
  for (std::size_t i = 0; i < scene.size(); ++i)
    if ((scene.point[i].cast<double>() - centre).norm() <= 5) wanted.push_back(scene.id[i]);
  for (std::size_t i = 0; i < part.size(); ++i)
    if ((part.point[i].cast<double>() - centre).norm() <= 5) found.push_back(part.id[i]);
  EXPECT_GT(wanted.size(), 1000U);
  EXPECT_EQ(found, wanted);
}

TEST(TiledScene, a_scene_100_km_wide_keeps_its_millimetres) {
  // Two plates 100 km apart in double coordinates; float32 has steps of 8 mm at that distance.
  std::vector<Eigen::Vector3d> positions;
  SceneCloud batch;
  for (int i = 0; i < 20000; ++i) {
    const auto u = random_uniform(7, RandomStage::scene_points, {static_cast<std::uint64_t>(i), 0, 0});
    positions.push_back({(i % 2 ? 1 : -1) * 50e3 + 5 * u[0], 5 * u[1], u[2]});
    add_surfel(batch, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0.001);
  }
  TileWriterOptions options = small_tiles();
  options.origin = {400000, 5400000, 0};
  TileWriter writer(own_path("a.tiles"), options);
  writer.add(batch, positions);
  writer.finish();
  const TiledScene tiled(own_path("a.tiles"));
  const Eigen::Vector3d near = options.origin + Eigen::Vector3d(50e3, 0, 0);
  const SceneCloud part = tiled.load(tiled.select(region_around(near, 100)));
  ASSERT_EQ(part.size(), 10000U);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Eigen::Vector3d world = part.origin + part.point[i].cast<double>();
    EXPECT_LT((world - options.origin - positions[part.id[i]]).norm(), 1e-4);
  }
}

TEST(TiledScene, tiles_of_two_clouds_100_km_apart_are_small_in_both) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 20000, .size = {20, 20}});
  const std::size_t one = scene.size();
  for (std::size_t i = 0; i < one; ++i)
    add_surfel(scene, scene.point[i].cast<double>() + Eigen::Vector3d(1e5, 0, 0), Eigen::Vector3d::UnitZ(), 0.02);
  save_tiles(own_path("a.tiles"), scene, small_tiles());
  const TiledScene tiled(own_path("a.tiles"));
  for (const double x : {10.0, 1e5 + 10}) EXPECT_LT(tiled.select(region_around({x, 0, 0}, 1)).surfels, one / 10);
}

TEST(TiledScene, strays_far_away_do_not_make_tiles_large) {
  SceneCloud scene = harbour(20000);
  add_surfel(scene, {1e5, 0, 0}, Eigen::Vector3d::UnitZ(), 0.01);
  add_surfel(scene, {0, -3e6, 0}, Eigen::Vector3d::UnitZ(), 0.01);
  TileWriterOptions options = small_tiles();
  options.memory = 0;
  save_tiles(own_path("a.tiles"), scene, options);
  const TiledScene tiled(own_path("a.tiles"));
  EXPECT_LT(tiled.select(region_around({20, 3, -7}, 5)).surfels, scene.size() / 4);
}

TEST(TiledScene, scenes_without_extent_are_scenes) {
  EXPECT_EQ(save_tiles(own_path("none.tiles"), SceneCloud{}).surfels, 0U);
  const TiledScene none(own_path("none.tiles"));
  EXPECT_EQ(none.load(none.select_all()).size(), 0U);
  EXPECT_EQ(none.select(region_around({0, 0, 0}, 1e9)).surfels, 0U);

  save_tiles(own_path("one.tiles"), one_point());
  const TiledScene one(own_path("one.tiles"));
  expect_same_surfels(one.load(one.select(region_around({0, 0, 0}, 10))), one_point());
  EXPECT_EQ(one.select(region_around({50, 0, 0}, 10)).surfels, 0U);

  // More surfels at one position than the memory for sorting can hold.
  TileWriterOptions little;
  little.memory = 0;
  save_tiles(own_path("pile.tiles"), one_point(20000), little);
  const TiledScene pile(own_path("pile.tiles"));
  expect_same_surfels(pile.load(pile.select_all()), one_point(20000));
}

TEST(TiledScene, duplicates_are_dropped_on_request_and_the_first_is_kept) {
  SceneCloud scene = harbour(5000);
  const std::size_t before = scene.size();
  for (std::size_t i = 0; i < before; i += 3) {
    add_surfel(scene, scene.point[i].cast<double>(), Eigen::Vector3d::UnitZ(), 7.0);
  }
  TileWriterOptions options = small_tiles();
  options.drop_duplicates = true;
  const TileReport report = save_tiles(own_path("a.tiles"), scene, options);
  EXPECT_EQ(report.dropped_duplicates, scene.size() - before);
  const TiledScene tiled(own_path("a.tiles"));
  const SceneCloud kept = tiled.load(tiled.select_all());
  ASSERT_EQ(kept.size(), before);
  EXPECT_EQ(kept.id.back(), before - 1);
  const double area = std::accumulate(kept.area.begin(), kept.area.end(), 0.0);
  EXPECT_NEAR(tiled.info().total_area, area, 1e-9 * area);
}

TEST(TiledScene, areas_found_tile_by_tile_add_up_to_the_plate) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 40000, .size = {40, 40}});
  TileWriterOptions options{.tile_surfels = 50};  // seven groups of tiles
  options.complete = [](SceneCloud& neighbours) {
    neighbours.area = estimate_surfel_areas(neighbours.point, neighbours.normal);
  };
  const TileReport report = save_tiles(own_path("a.tiles"), scene, options);
  EXPECT_NEAR(report.total_area, 1600, 0.02 * 1600);  // the promise of estimate_surfel_areas
  const TiledScene tiled(own_path("a.tiles"));
  const SceneCloud found = tiled.load(tiled.select_all());
  EXPECT_NEAR(std::accumulate(found.area.begin(), found.area.end(), 0.0), report.total_area, 1e-6 * 1600);
  // No seams between tiles: each area is that of the whole cloud.
  const auto whole = estimate_surfel_areas(scene.point, scene.normal);
  std::size_t different = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) different += std::abs(found.area[i] - whole[i]) > 1e-5F * whole[i];
  EXPECT_LT(different, whole.size() / 1000);
}

TEST(TiledScene, what_does_not_fit_into_memory_is_refused_before_it_is_read) {
  save_tiles(own_path("a.tiles"), harbour(), small_tiles());
  const TiledScene tiled(own_path("a.tiles"));
  expect_error(ErrorKind::memory, {"a.tiles", "surfels within reach need about", "GiB", "raise the limit"},
               [&] { tiled.load(tiled.select_all(), 1e6); });
  EXPECT_GT(tiled.load(tiled.select(region_around({20, 3, -7}, 1)), 1e6).size(), 0U);
}

TEST(TiledScene, a_file_that_is_not_whole_or_not_ours_is_refused) {
  save_tiles(own_path("good.tiles"), harbour(5000), small_tiles());
  const std::string good = file_bytes(own_path("good.tiles"));
  const auto refuse = [&](const std::string& bytes, const std::vector<std::string>& parts) {
    const std::string path = own_file("bad.tiles", bytes);
    testing::internal::CaptureStderr();
    expect_error(ErrorKind::content, parts, [&] {
      const TiledScene tiled(path);
      tiled.load(tiled.select_all());
    });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  };
  refuse("", {"bad.tiles", "empty"});
  refuse("ply\nformat ascii 1.0\n",
         {"bad.tiles", "not a .tiles file", "text beginning with 'ply'", "insonify prepare SCENE -o"});
  for (const std::size_t kept : {std::size_t{100}, std::size_t{3000}, good.size() / 2, good.size() - 1})
    refuse(good.substr(0, kept), {"bad.tiles", "damaged or cut short"});
  const auto with = [&](const std::string& at, char change) {
    std::string bytes = good;
    const std::size_t where = bytes.find(at);
    EXPECT_NE(where, std::string::npos);
    bytes[where] = static_cast<char>(bytes[where] ^ change);
    return bytes;
  };
  refuse(with("insonify tiles", 1),
         {"bad.tiles", "is an HDF5 file, but not a .tiles file", "insonify prepare SCENE -o"});
  refuse(with("insonify scene", 1), {"directory is damaged", "checksum"});
  const TiledScene whole(own_path("good.tiles"));
  const auto bytes_of_number = [](auto number) {
    return std::string(reinterpret_cast<char*>(&number), sizeof(number));
  };
  refuse(with(bytes_of_number(whole.info().box.max.x()), 1), {"directory is damaged", "checksum"});
  const SceneCloud scene = whole.load(whole.select_all());
  refuse(with(bytes_of_number(scene.point[1234].x()), 1), {" of ", "is damaged: its checksum is wrong"});
  refuse(with(bytes_of_number(scene.normal[321].z()), 1), {" of ", "is damaged: its checksum is wrong"});
  expect_error(ErrorKind::file, {"none.tiles", "no such file"}, [] { TiledScene(own_path("none.tiles")); });
}

// Written by the program when the newest version was 2: without noise and coordinate system.
TEST(TiledScene, files_of_version_2_are_read) {
  const TiledScene tiled(INSONIFY_OLD_TILES);
  EXPECT_FALSE(tiled.info().noisy);
  EXPECT_EQ(tiled.info().system, "");
  const SceneCloud scene = tiled.load(tiled.select_all());
  ASSERT_EQ(scene.size(), 200U);
  EXPECT_TRUE(scene.noise.empty());
  EXPECT_NEAR(total_area(scene), 1600, 0.01);
  EXPECT_EQ(scene.materials[0].name, "plane");
  const TiledCut cut = tiled.cut(region_around({20, 0, 0}, 100), {}, {0.1, 200, 1}, {0, 5, 10});
  EXPECT_LT(cut.scene.size(), 150U);
  EXPECT_NEAR(total_area(cut.scene), 1600, 1);
}

TEST(TiledScene, a_coordinate_system_is_kept) {
  SceneCloud scene = harbour(2000);
  save_tiles(own_path("with.tiles"), scene, {.system = "EPSG:32632 (WGS 84 / UTM zone 32N)"});
  EXPECT_EQ(TiledScene(own_path("with.tiles")).info().system, "EPSG:32632 (WGS 84 / UTM zone 32N)");
  save_tiles(own_path("without.tiles"), scene);
  EXPECT_EQ(TiledScene(own_path("without.tiles")).info().system, "");
}

TEST(TiledScene, a_row_with_values_of_no_surfel_is_named_by_its_number) {
  SceneCloud scene = harbour(2000);
  scene.noise.assign(scene.size(), 0.01F);
  save_tiles(own_path("good.tiles"), scene, small_tiles());
  const TileParts good = load_tile_parts(own_path("good.tiles"));
  const std::size_t row = 1234;
  const std::vector<std::pair<std::string, std::function<void(SceneCloud&)>>> damages = {
      {"material = 99, must be below the number of materials", [](SceneCloud& s) { s.material[row] = 99; }},
      {"area = -2 m^2, must be", [](SceneCloud& s) { s.area[row] = -2; }},
      {"area = nan m^2, must be", [](SceneCloud& s) { s.area[row] = NAN; }},
      {"normal = (0, 0, 2), must be a unit vector",
       [](SceneCloud& s) {
         s.normal[row] = {0, 0, 2};
       }},
      {"noise = -1 m, must be", [](SceneCloud& s) { s.noise[row] = -1; }},
      {"point = (inf, 0, 0) m, must be finite",
       [](SceneCloud& s) {
         s.point[row] = {INFINITY, 0, 0};
       }},
  };
  for (const auto& [said, damage] : damages) {
    TileParts parts = good;
    damage(parts.rows);
    save_tile_parts(parts, own_path("bad.tiles"));
    const TiledScene tiled(own_path("bad.tiles"));
    expect_error(ErrorKind::content, {"bad.tiles: row 1234: " + said, "copy or make the file again"},
                 [&] { tiled.load(tiled.select_all()); });
  }
}

TEST(TiledScene, a_directory_of_no_numbers_is_refused) {
  save_tiles(own_path("good.tiles"), harbour(2000), small_tiles());
  const TileParts good = load_tile_parts(own_path("good.tiles"));
  const auto refuse = [&](const std::string& said, const std::function<void(TileDirectory&)>& damage) {
    TileParts parts = good;
    damage(parts.directory);
    save_tile_parts(parts, own_path("bad.tiles"));
    expect_error(ErrorKind::content, {"bad.tiles: the directory is damaged: " + said},
                 [] { TiledScene(own_path("bad.tiles")); });
  };
  refuse("its origin, box or area", [](TileDirectory& d) { d.info.origin.x() = NAN; });
  refuse("its origin, box or area", [](TileDirectory& d) { d.info.box.max.z() = INFINITY; });
  refuse("its origin, box or area", [](TileDirectory& d) { d.info.total_area = -1; });
  refuse("it has no material", [](TileDirectory& d) { d.info.materials.clear(); });
  refuse("a tile has no ball", [](TileDirectory& d) { d.tiles[3].radius = NAN; });
  refuse("a tile has no ball", [](TileDirectory& d) { d.tiles[3].reference[1] = NAN; });
  refuse("a forest has no ball", [](TileDirectory& d) { d.forests[0].largest_area = INFINITY; });
  refuse("its tiles are not consecutive", [](TileDirectory& d) { d.tiles[3].count = 1ull << 60; });
  refuse("its forests are not consecutive", [](TileDirectory& d) { d.forests[0].tiles = 1ull << 60; });
}

TEST(TiledScene, any_byte_that_changes_is_found_or_changes_nothing) {
  const SceneCloud scene = harbour(300);
  save_tiles(own_path("good.tiles"), scene, small_tiles());
  const std::string good = file_bytes(own_path("good.tiles"));
  int found = 0;
  for (std::size_t at = 0; at < good.size(); at += 151) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    const std::string path = own_file("bad.tiles", bytes);
    try {
      const TiledScene tiled(path);
      expect_same_surfels(tiled.load(tiled.select_all()), scene);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::content) << error.what();
      ++found;
    }
  }
  EXPECT_GT(found, 60);
}

TEST(TiledScene, rows_follow_the_curve_and_tiles_are_aligned_with_the_origin) {
  save_tiles(own_path("a.tiles"), harbour(), {.tile_surfels = 1});
  const TiledScene tiled(own_path("a.tiles"));
  const MortonCurve curve(100, true);
  std::optional<CurvePosition> before;
  for (const Eigen::Vector3d& position : tiled.positions()) {
    const CurvePosition at = curve.at({position.x(), position.y(), position.z()});
    EXPECT_FALSE(before && MortonCurve::before(at, *before));
    before = at;
  }
}

TEST(TileWriter, an_unfinished_or_interrupted_file_leaves_nothing) {
  const std::size_t before = files_in_folder();
  {
    TileWriter writer(own_path("a.tiles"));
    writer.add(one_point());
    EXPECT_EQ(files_in_folder(), before);  // temporary files are unnamed
  }
  EXPECT_EQ(files_in_folder(), before);
  struct Stop {};
  TileWriterOptions options = small_tiles();
  options.progress = [](double part) {
    if (part > 0.5) throw Stop{};
  };
  EXPECT_THROW(save_tiles(own_path("a.tiles"), harbour(), options), Stop);
  EXPECT_EQ(files_in_folder(), before);
}

TEST(TileWriter, an_existing_file_stays_until_the_new_one_is_whole) {
  save_tiles(own_path("a.tiles"), one_point());
  const std::string old = file_bytes(own_path("a.tiles"));
  {
    TileWriter writer(own_path("a.tiles"));
    writer.add(one_point(5));
    EXPECT_EQ(file_bytes(own_path("a.tiles")), old);
    writer.finish();
  }
  EXPECT_EQ(TiledScene(own_path("a.tiles")).info().surfels, 5U);
}

TEST(TileWriter, bad_input_is_refused) {
  SceneCloud scene = one_point();
  scene.materials.push_back({"other"});
  scene.material[0] = 1;
  TileWriter writer(own_path("a.tiles"));
  expect_error(ErrorKind::content, {"material", "= 1"}, [&] { writer.add(scene); });
  scene.material[0] = 0;
  scene.point[0].x() = NAN;
  expect_error(ErrorKind::content, {"finite"}, [&] { writer.add(scene); });
  expect_error(ErrorKind::argument, {"places"}, [&] { writer.add(one_point(), {}); });
  expect_error(ErrorKind::file, {"nowhere"}, [] { TileWriter("/nowhere/at/all.tiles"); });
  expect_error(ErrorKind::argument, {"tile_surfels"}, [] { TileWriter(own_path("b.tiles"), {.tile_surfels = 0}); });
  writer.finish();
  expect_error(ErrorKind::argument, {"after finish"}, [&] { writer.add(one_point()); });
}
