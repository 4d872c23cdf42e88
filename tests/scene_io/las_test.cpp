// SPDX-License-Identifier: BSD-3-Clause
// LAS files, written here byte by byte from the specification.
#include "scene_io/describe_file.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "scene_io/test_files.hpp"
#include "scene_io/tiled_scene.hpp"

namespace {

struct LasFile {
  int minor = 2, format = 0;
  double scale = 0.001;
  Eigen::Vector3d offset = {500000, 5400000, -20};
  bool extra =
      false;       ///< an 'area' of uint16 in units of 1 cm2, after two bytes without a meaning, and an 'id' of uint32
  int points = 0;  ///< announced beyond those there are
  std::size_t withheld = 0;  ///< of each so many points the first is withheld; 0: none
  bool normals = false;      ///< upright ones, after the others

  std::size_t stride() const {
    return std::array{20u, 28u, 26u, 34u, 57u, 63u, 30u, 36u, 38u, 59u, 67u}[format] + (extra ? 8u : 0u) +
           (normals ? 12u : 0u);
  }

  std::string extra_record() const {
    if (!extra && !normals) return "";
    const auto described = [](int type, int options, const std::string& name, double factor) {
      std::string d(192, '\0');
      d[2] = static_cast<char>(type);
      d[3] = static_cast<char>(options);
      d.replace(4, name.size(), name);
      d.replace(112, 8, bytes_of(factor));
      return d;
    };
    std::string body;
    if (extra) body = described(0, 2, "", 0) + described(3, 8, "area", 1e-4) + described(5, 0, "id", 0);
    if (normals) body += described(9, 0, "nx", 0) + described(9, 0, "ny", 0) + described(9, 0, "nz", 0);
    std::string head(54, '\0');
    head.replace(2, 9, "LASF_Spec");
    head.replace(18, 2, bytes_of(std::uint16_t{4}));
    head.replace(20, 2, bytes_of(static_cast<std::uint16_t>(body.size())));
    return head + body;
  }

  std::string bytes(const std::vector<Eigen::Vector3d>& places) const {
    const std::size_t header_size = minor == 4 ? 375 : 227;
    const std::string records = extra_record();
    std::string h(header_size, '\0');
    const auto put = [&](std::size_t at, const std::string& value) { h.replace(at, value.size(), value); };
    put(0, "LASF");
    put(24, {1, static_cast<char>(minor)});
    put(94, bytes_of(static_cast<std::uint16_t>(header_size)));
    put(96, bytes_of(static_cast<std::uint32_t>(header_size + records.size())));
    put(100, bytes_of(extra || normals ? 1u : 0u));
    put(104, std::string(1, static_cast<char>(format)));
    put(105, bytes_of(static_cast<std::uint16_t>(stride())));
    const auto count = static_cast<std::uint32_t>(places.size() + static_cast<std::size_t>(points));
    if (minor == 4)
      put(247, bytes_of(std::uint64_t{count}));
    else
      put(107, bytes_of(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(131 + 8 * axis, bytes_of(scale));
      put(155 + 8 * axis, bytes_of(offset[static_cast<int>(axis)]));
    }
    std::string rows;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::string row(stride(), '\0');
      for (int axis = 0; axis < 3; ++axis)
        row.replace(4 * static_cast<std::size_t>(axis), 4,
                    bytes_of(static_cast<std::int32_t>(std::lround((places[i] - offset)[axis] / scale))));
      // Classes 0 and 2; up to format 5 their upper bits are flags.
      row[format < 6 ? 15 : 16] = static_cast<char>((i % 2 ? 2 : 0) | (format < 6 ? 0x20 : 0));
      // A synthetic one, as above, is none that is withheld.
      if (format >= 6) row[15] = 1;
      if (withheld > 0 && i % withheld == 0) row[15] = static_cast<char>(row[15] | (format < 6 ? 0x80 : 4));
      if (extra) {
        row.replace(stride() - 6, 2, bytes_of(static_cast<std::uint16_t>(100 + i)));
        row.replace(stride() - 4, 4, bytes_of(static_cast<std::uint32_t>(1000 + i)));
      }
      if (normals) row.replace(stride() - 4, 4, bytes_of(1.0F));
      rows += row;
    }
    return h + records + rows;
  }
};

std::vector<Eigen::Vector3d> places() {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 64; ++i)
    all.emplace_back(500123.25 + 0.1 * (i % 8), 5403061.5 + 0.1 * (i / 8), -7.125 + 0.01 * i);
  return all;
}

LoadedScene loaded_las(const LasFile& las) { return load_scene(own_file("cloud.las", las.bytes(places()))); }

}  // namespace

TEST(Las, has_the_places_and_classes_of_all_point_formats) {
  for (int format = 0; format <= 10; ++format) {
    const LoadedScene scene = loaded_las({.minor = format >= 6 ? 4 : format > 3 ? 3 : 2, .format = format});
    ASSERT_EQ(scene.scene.size(), 64u) << format;
    for (std::size_t i = 0; i < 64; ++i) {
      EXPECT_LT((world(scene.scene, i) - places()[i]).norm(), 1e-3) << format;
      EXPECT_EQ(scene.scene.material[i], i % 2 ? 2 : 0) << format;
    }
    const std::string minor = std::to_string(format >= 6 ? 4 : format > 3 ? 3 : 2);
    EXPECT_THAT(scene.report.format,
                testing::StartsWith("LAS 1." + minor + ", point format " + std::to_string(format)));
  }
}

TEST(Las, extra_bytes_are_fields_with_their_scale) {
  const LoadedScene scene = loaded_las({.minor = 4, .format = 6, .extra = true});
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(scene.scene.area[i], 0.01 + 1e-4 * static_cast<double>(i), 1e-8);
    EXPECT_EQ(scene.scene.id[i], 1000 + i);
  }
}

// Whole, in tiles and in batches of rows; a scene has neither their places nor their classes.
TEST(Las, leaves_out_points_that_are_withheld) {
  for (int format = 0; format <= 10; ++format) {
    const LasFile las{.minor = format >= 6 ? 4 : 2, .format = format, .withheld = 4};
    const LoadedScene scene = loaded_las(las);
    ASSERT_EQ(scene.scene.size(), 48u) << format;
    EXPECT_EQ(scene.report.dropped_withheld, 16u);
    EXPECT_EQ(scene.report.dropped_not_finite, 0u);
    for (std::size_t k = 0; k < 48; ++k) {
      const std::size_t i = 4 * (k / 3) + k % 3 + 1;
      EXPECT_LT((world(scene.scene, k) - places()[i]).norm(), 1e-3) << format;
      EXPECT_EQ(scene.scene.material[k], i % 2 ? 2 : 0) << format;
      EXPECT_EQ(scene.scene.id[k], i) << format;
    }
  }
  const std::string path = own_file("cloud.las", LasFile{.withheld = 4}.bytes(places()));
  const FileDescription file = describe_file(path);
  EXPECT_EQ(file.points, 64u);
  EXPECT_EQ(file.withheld, 16u);
  EXPECT_THAT(file.problems, testing::Contains("16 of 64 points (25 %) are marked as withheld: will be left out"));
  EXPECT_NEAR(file.min.z(), places()[1].z(), 1e-3) << "the first is withheld";
  const std::string upright = own_file("up.las", LasFile{.withheld = 4, .normals = true}.bytes(places()));
  for (const std::size_t whole_points : {std::size_t{0}, std::size_t{64}}) {
    PrepareTilesOptions options;
    options.whole_points = whole_points;
    const PreparedTiles tiles = prepare_tiles(upright, own_path("up.tiles"), options);
    EXPECT_EQ(tiles.streamed, whole_points == 0);
    EXPECT_EQ(tiles.report.dropped_withheld, 16u);
    EXPECT_EQ(TiledScene(own_path("up.tiles")).info().surfels, 48u);
  }
  expect_error(ErrorKind::content, {"all.las", "no usable point", "64 of 64 points are marked as withheld"},
               [] { load_scene(own_file("all.las", LasFile{.withheld = 1}.bytes(places()))); });
}

TEST(Las, becomes_tiles_in_batches) {
  const std::string las = own_file("cloud.las", LasFile{.extra = true}.bytes(places()));
  prepare_tiles(las, own_path("cloud.tiles"), {});
  EXPECT_EQ(TiledScene(own_path("cloud.tiles")).info().surfels, 64u);
}

TEST(Las, cut_off_anywhere_or_of_another_kind_is_refused) {
  const std::string whole = LasFile{.minor = 4, .format = 6, .extra = true}.bytes(places());
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
  refused(104, std::string(1, '\x86'), {"compressed (LAZ)", "docs/scene-files.md has the command"});
  refused(104, std::string(1, '\x0c'), {"point data record format 12"});
  refused(105, bytes_of(std::uint16_t{29}), {"a point has 29 bytes, format 6 needs 30"});
  refused(247, bytes_of(~std::uint64_t{0}), {"cut off", "announces 18446744073709551615 points"});
  refused(375 + 20, bytes_of(std::uint16_t{65535}), {"cut off"});
  refused(375 + 54 + 2 * 192 + 2, std::string(1, '\x0a'), {"extra bytes 'id' end beyond a point of 38 bytes"});
  refused(375 + 54 + 192 + 2, std::string(1, '\x0b'), {"are of type 11"});
}
