// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/describe_file.hpp"
#include "scene_io/las_file.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

std::vector<Eigen::Vector3d> positions() {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 64; ++i)
    all.emplace_back(500123.25 + 0.1 * (i % 8), 5403061.5 + 0.1 * (i / 8), -7.125 + 0.01 * i);
  return all;
}

LoadedScene loaded_las(const LasFile& las) { return load_scene(own_file("cloud.las", las.bytes(positions()))); }

}  // namespace

TEST(Las, has_the_places_and_classes_of_all_point_formats) {
  for (int format = 0; format <= 10; ++format) {
    const LoadedScene scene = loaded_las({.minor = format >= 6 ? 4 : format > 3 ? 3 : 2, .format = format});
    ASSERT_EQ(scene.scene.size(), 64u) << format;
    for (std::size_t i = 0; i < 64; ++i) {
      EXPECT_LT((world(scene.scene, i) - positions()[i]).norm(), 1e-3) << format;
      EXPECT_EQ(scene.scene.material[i], i % 2 ? 2 : 0) << format;
    }
    const std::string minor = std::to_string(format >= 6 ? 4 : format > 3 ? 3 : 2);
    EXPECT_THAT(scene.report.format,
                testing::StartsWith("LAS 1." + minor + ", point format " + std::to_string(format)));
    const bool waves = format == 4 || format == 5 || format >= 9;
    EXPECT_EQ(has_note(scene.report, "the waveforms of its points are not read"), waves) << format;
  }
}

TEST(Las, extra_bytes_are_fields_with_their_scale) {
  const LoadedScene scene = loaded_las({.minor = 4, .format = 6, .extra = true});
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(scene.scene.area[i], 0.01 + 1e-4 * static_cast<double>(i), 1e-8);
    EXPECT_EQ(scene.scene.id[i], 1000 + i);
  }
}

// Whole, in tiles and in batches of rows; a scene has neither their positions nor their classes.
TEST(Las, leaves_out_points_that_are_withheld) {
  for (int format = 0; format <= 10; ++format) {
    const LasFile las{.minor = format >= 6 ? 4 : 2, .format = format, .withheld = 4};
    const LoadedScene scene = loaded_las(las);
    ASSERT_EQ(scene.scene.size(), 48u) << format;
    EXPECT_EQ(scene.report.dropped_withheld, 16u);
    EXPECT_EQ(scene.report.dropped_not_finite, 0u);
    for (std::size_t k = 0; k < 48; ++k) {
      const std::size_t i = 4 * (k / 3) + k % 3 + 1;
      EXPECT_LT((world(scene.scene, k) - positions()[i]).norm(), 1e-3) << format;
      EXPECT_EQ(scene.scene.material[k], i % 2 ? 2 : 0) << format;
      EXPECT_EQ(scene.scene.id[k], i) << format;
    }
  }
  const std::string path = own_file("cloud.las", LasFile{.withheld = 4}.bytes(positions()));
  const FileDescription file = describe_file(path);
  EXPECT_EQ(file.points, 64u);
  EXPECT_EQ(file.withheld, 16u);
  EXPECT_THAT(file.problems, testing::Contains("16 of 64 points (25 %) are marked as withheld: will be left out"));
  EXPECT_NEAR(file.min.z(), positions()[1].z(), 1e-3) << "the first is withheld";
  const std::string upright = own_file("up.las", LasFile{.withheld = 4, .normals = true}.bytes(positions()));
  for (const std::size_t whole_points : {std::size_t{0}, std::size_t{64}}) {
    PrepareTilesOptions options;
    options.whole_points = whole_points;
    const PreparedTiles tiles = prepare_tiles(upright, own_path("up.tiles"), options);
    EXPECT_EQ(tiles.streamed, whole_points == 0);
    EXPECT_EQ(tiles.report.dropped_withheld, 16u);
    EXPECT_EQ(TiledScene(own_path("up.tiles")).info().surfels, 48u);
  }
  expect_error(ErrorKind::content, {"all.las", "no usable point", "64 of 64 points are marked as withheld"},
               [] { load_scene(own_file("all.las", LasFile{.withheld = 1}.bytes(positions()))); });
}

TEST(Las, becomes_tiles_in_batches) {
  const std::string las = own_file("cloud.las", LasFile{.extra = true}.bytes(positions()));
  prepare_tiles(las, own_path("cloud.tiles"), {});
  EXPECT_EQ(TiledScene(own_path("cloud.tiles")).info().surfels, 64u);
}

TEST(Las, cut_off_anywhere_or_of_another_kind_is_refused) {
  const std::string whole = LasFile{.minor = 4, .format = 6, .extra = true}.bytes(positions());
  for (std::size_t length = 1; length < whole.size(); ++length)
    expect_error(ErrorKind::content, {"cut.las"}, [&] { load_scene(own_file("cut.las", whole.substr(0, length))); });
  const auto refused = [&](std::size_t at, const std::string& bytes, const std::vector<std::string>& parts) {
    std::string changed = whole;
    changed.replace(at, bytes.size(), bytes);
    expect_error(ErrorKind::content, parts, [&] { load_scene(own_file("bad.las", changed)); });
  };
  refused(0, "LASX", {"not a LAS file"});
  // Numbers in the order of other machines: sizes and counts become larger than any file.
  for (const auto& [at, size] : {std::pair<std::size_t, std::size_t>{96, 4}, {247, 8}}) {
    std::string turned = whole.substr(at, size);
    std::reverse(turned.begin(), turned.end());
    refused(at, turned, {"cut off"});
  }
  refused(25, std::string(1, '\5'), {"is LAS 1.5, expected 1.0 to 1.4"});
  if (scene_extensions().find(".laz") == std::string::npos)
    refused(104, std::string(1, '\x86'), {"compressed (LAZ)", "liblaszip-dev", "docs/scene-files.md has the commands"});
  else
    refused(104, std::string(1, '\x86'), {"bad.las: cannot be unpacked (", "copy or export it again"});
  refused(104, std::string(1, '\x0c'), {"point data record format 12"});
  refused(105, bytes_of(std::uint16_t{29}), {"a point has 29 bytes, format 6 needs 30"});
  refused(247, bytes_of(~std::uint64_t{0}), {"cut off", "announces 18446744073709551615 points"});
  refused(375 + 20, bytes_of(std::uint16_t{65535}), {"cut off"});
  refused(375 + 54 + 2 * 192 + 2, std::string(1, '\x0a'), {"extra bytes 'id' end beyond a point of 38 bytes"});
}

TEST(Las, normals_have_the_names_of_pdal_and_cloudcompare) {
  for (const char* name : {"Normal%", "n%"}) {
    std::string upper = name;
    LasFile las{.normals = true};
    las.normal_name = name;
    std::string bytes = las.bytes(positions());
    if (upper == "Normal%")
      for (const char axis : {'x', 'y', 'z'}) {
        const std::string was = std::string("Normal") + axis;
        bytes = replaced(bytes, was, std::string("Normal") + static_cast<char>(axis - 'a' + 'A'));
      }
    const LoadedScene scene = load_scene(own_file("cloud.las", bytes));
    EXPECT_FALSE(scene.report.normals_estimated) << name;
    for (const Eigen::Vector3f& normal : scene.scene.normal) EXPECT_EQ(normal, Eigen::Vector3f(0, 0, 1));
  }
}

// Whole, in batches and by `info`.
TEST(Las, noise_is_left_out_unless_the_caller_wants_it) {
  for (int format = 0; format <= 10; ++format) {
    LasFile las{.minor = format >= 6 ? 4 : 2, .format = format, .normals = true};
    las.class_of = [](std::size_t i) { return std::array{2, 7, 9, 18}[i % 4]; };
    const std::string path = own_file("noisy.las", las.bytes(positions()));
    const auto kept = [&](const char* classes) {
      LoadOptions options;
      options.meaning = meaning_override("classes", classes);
      PrepareTilesOptions tiles;
      tiles.load = options;
      tiles.whole_points = 0;
      const PreparedTiles prepared = prepare_tiles(path, own_path("noisy.tiles"), tiles);
      const LoadedScene scene = load_scene(path, options);
      EXPECT_EQ(TiledScene(own_path("noisy.tiles")).info().surfels, scene.scene.size());
      for (const LoadReport& report : {scene.report, prepared.report}) {
        EXPECT_EQ(report.dropped_classes, 64 - scene.scene.size());
        EXPECT_EQ(has_note(report, "32 of 64 points are of class 7 or 18, which is noise: left out; --classes all"),
                  std::string(classes).empty());
      }
      return scene.scene.size();
    };
    EXPECT_EQ(kept(""), 32u) << format;
    EXPECT_EQ(kept("all"), 64u) << format;
    EXPECT_EQ(kept("2"), 16u) << format;
    EXPECT_EQ(kept("7,9,18"), 48u) << format;
    LoadOptions none;
    none.meaning = meaning_override("classes", "5");
    expect_error(ErrorKind::content, {"noisy.las", "64 of 64 points are of classes that are not read", "--classes all"},
                 [&] { load_scene(path, none); });
  }
  LasFile las;
  las.class_of = [](std::size_t i) { return i < 10 ? 7 : 2; };
  const FileDescription file = describe_file(own_file("noisy.las", las.bytes(positions())));
  EXPECT_TRUE(std::any_of(file.meaning.begin(), file.meaning.end(), [](const MeaningItem& item) {
    return item.name == "classes" && item.value == "all but 7,18" && item.sentence.starts_with("10 of 64 points");
  }));
  EXPECT_NEAR(file.min.z(), positions()[10].z(), 1e-3) << "bounds are without noise";
}

TEST(Las, extra_bytes_of_deprecated_types_are_columns_and_unknown_ones_are_skipped) {
  for (int type = 11; type <= 30; ++type) {
    LasFile las{.normals = true};
    las.pair_type = type;
    const std::string path = own_file("pair.las", las.bytes(positions()));
    const LoadedScene scene = load_scene(path);
    EXPECT_FALSE(scene.report.normals_estimated) << type;
    EXPECT_EQ(scene.scene.normal[0], Eigen::Vector3f(0, 0, 1)) << type << ": the columns behind are in their places";
    const std::vector<std::string>& others = scene.report.other_columns;
    EXPECT_EQ(std::count(others.begin(), others.end(), "pair_y"), 1) << type;
    EXPECT_EQ(std::count(others.begin(), others.end(), "pair_z"), type > 20 ? 1 : 0) << type;
  }
  LasFile las{.normals = true};
  las.pair_type = 31;
  const LoadedScene scene = load_scene(own_file("odd.las", las.bytes(positions())));
  EXPECT_EQ(scene.scene.size(), 64u);
  EXPECT_TRUE(has_note(scene.report, "extra bytes 'pair' are of the unknown type 31"));
}
