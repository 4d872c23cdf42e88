// SPDX-License-Identifier: BSD-3-Clause
// LAZ: LAS files written here by their specification, and their twins that LASzip packs; files by laspy; a COPC.
#include "scene_io/las_file.hpp"
#include "scene_io/prepare_tiles.hpp"
// It says `using namespace std`.
#include <laszip/laszip_api.h>

namespace insonify::laz_tests {

constexpr int points_of_plate = 64;

std::vector<Eigen::Vector3d> plate() {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < points_of_plate; ++i)
    all.emplace_back(500123.25 + 0.1 * (i % 8), 5403061.5 + 0.1 * (i / 8), -7.125 + 0.01 * i);
  return all;
}

/// Fills the bytes of the rows between class and normals, which LasFile leaves 0, so that all of them are compared.
std::string with_all_bytes(const LasFile& las, std::string bytes, std::size_t rows) {
  const std::size_t begin = bytes.size() - rows * las.stride(), first = las.format < 6 ? 16 : 17;
  const std::size_t last = las.stride() - (las.normals ? 12 : 0);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = first; k < last; ++k) bytes[begin + i * las.stride() + k] = static_cast<char>(i * i + 3 * k);
  return bytes;
}

/// Packs a LAS file by LASzip in chunks of so many points.
void pack(const std::string& las, const std::string& laz, unsigned chunk) {
  laszip_POINTER in = nullptr, out = nullptr;
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  laszip_BOOL packed = 0;
  laszip_create(&in), laszip_create(&out);
  ASSERT_EQ(laszip_open_reader(in, las.c_str(), &packed), 0);
  laszip_get_header_pointer(in, &header), laszip_get_point_pointer(in, &point);
  const std::size_t count = header->number_of_point_records + header->extended_number_of_point_records;
  laszip_set_header(out, header), laszip_request_native_extension(out, 1), laszip_set_chunk_size(out, chunk);
  ASSERT_EQ(laszip_open_writer(out, laz.c_str(), 1), 0);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(laszip_read_point(in) + laszip_set_point(out, point) + laszip_write_point(out), 0);
  }
  ASSERT_EQ(laszip_close_writer(out) + laszip_close_reader(in), 0);
  laszip_destroy(out), laszip_destroy(in);
}

LoadedScene with_columns(const std::string& path) {
  LoadOptions options;
  options.keep_columns = true;
  options.meaning = meaning_override("classes", "all");
  return load_scene(path, options);
}

void expect_twins(const LoadedScene& laz, const LoadedScene& las) {
  EXPECT_EQ(laz.scene.origin, las.scene.origin);
  EXPECT_EQ(laz.scene.point, las.scene.point);
  EXPECT_EQ(laz.scene.normal, las.scene.normal);
  EXPECT_EQ(laz.scene.area, las.scene.area);
  EXPECT_EQ(laz.scene.material, las.scene.material);
  EXPECT_EQ(laz.scene.id, las.scene.id);
  EXPECT_EQ(laz.report.dropped_withheld, las.report.dropped_withheld);
  EXPECT_EQ(laz.report.notes, las.report.notes);
  ASSERT_EQ(laz.columns.others.size(), las.columns.others.size());
  for (std::size_t k = 0; k < las.columns.others.size(); ++k) {
    EXPECT_EQ(laz.columns.others[k].name, las.columns.others[k].name);
    EXPECT_EQ(laz.columns.others[k].bytes, las.columns.others[k].bytes) << las.columns.others[k].name;
  }
  EXPECT_EQ(replaced(laz.report.format, "LAZ", "LAS"), las.report.format);
}

TEST(Laz, equals_its_twin_in_las_in_all_point_formats) {
  for (int format = 0; format <= 10; ++format) {
    const LasFile las{.minor = format >= 6 ? 4 : format >= 4 ? 3 : 2, .format = format, .withheld = 4, .normals = true};
    own_file("twin.las", with_all_bytes(las, las.bytes(plate()), points_of_plate));
    pack(own_path("twin.las"), own_path("twin.laz"), 10);
    SCOPED_TRACE(format);
    const LoadedScene packed = with_columns(own_path("twin.laz"));
    expect_twins(packed, with_columns(own_path("twin.las")));
    EXPECT_THAT(packed.report.format, testing::StartsWith("LAZ 1."));
  }
}

TEST(Laz, extra_bytes_and_the_coordinate_system_are_those_of_the_twin) {
  const std::string wkt = R"(LOCAL_CS["site",UNIT["foot",0.3048]])";
  for (const int format : {1, 6}) {
    LasFile las{.minor = format == 6 ? 4 : 2, .format = format, .extra = true};
    las.records = {las_record("LASF_Projection", 2112, wkt + '\0')};
    own_file("foot.las", las.bytes(plate()));
    pack(own_path("foot.las"), own_path("foot.laz"), 1000);
    const LoadedScene packed = with_columns(own_path("foot.laz"));
    expect_twins(packed, with_columns(own_path("foot.las")));
    EXPECT_EQ(packed.scene.id[5], 1005u);
    EXPECT_EQ(packed.report.meaning.unit.value, load_scene(own_path("foot.las")).report.meaning.unit.value);
  }
}

// Two batches, the second of which begins within a chunk.
TEST(Laz, becomes_the_same_tiles_in_batches) {
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 270'000; ++i) positions.emplace_back(500000 + 0.01 * (i % 600), 5400000 + 0.01 * (i / 600), -5);
  own_file("many.las", LasFile{.minor = 4, .format = 6, .normals = true}.bytes(positions));
  pack(own_path("many.las"), own_path("many.laz"), 50'000);
  PrepareTilesOptions options;
  options.whole_points = 1000;
  for (const char* name : {"many.las", "many.laz"}) {
    const PreparedTiles tiles = prepare_tiles(own_path(name), own_path(std::string(name) + ".tiles"), options);
    EXPECT_TRUE(tiles.streamed) << name;
    EXPECT_EQ(tiles.tiles.surfels, 270'000u) << name;
  }
  EXPECT_EQ(file_bytes(own_path("many.las.tiles")), file_bytes(own_path("many.laz.tiles")));
}

// The files and their makers: tests/data/laz/README.md.
TEST(Laz, of_other_writers_has_their_points) {
  const std::string octree = "octree.copc.laz";  // without areas
  for (const std::string& name :
       {std::string("laspy_12.laz"), std::string("laspy_13.laz"), std::string("laspy_14.laz"), octree}) {
    const LoadedScene loaded = load_scene(INSONIFY_TEST_LAZ "/" + name);
    ASSERT_EQ(loaded.scene.size(), 48u) << name;
    EXPECT_EQ(loaded.report.dropped_withheld, 16u) << name;
    for (std::size_t k = 0; k < loaded.scene.size(); ++k) {
      const std::size_t i = loaded.scene.id[k];
      EXPECT_LT((world(loaded.scene, k) - plate()[i]).norm(), 1e-6) << name;
      EXPECT_EQ(loaded.scene.material[k], i % 2 ? 2 : 0) << name;
      if (name != octree) {
        EXPECT_NEAR(loaded.scene.area[k], 0.01 + 1e-4 * static_cast<double>(i), 1e-8);
      }
    }
  }
}

TEST(Laz, damage_is_named_with_a_remedy) {
  for (const int format : {0, 6}) {
    own_file("whole.las", LasFile{.minor = format == 6 ? 4 : 2, .format = format}.bytes(plate()));
    pack(own_path("whole.las"), own_path("whole.laz"), 10);
    const std::string whole = file_bytes(own_path("whole.laz"));
    for (std::size_t length = 8; length < whole.size() / 2; length += 7)
      expect_error(ErrorKind::content, {"cut.laz", "again"},
                   [&] { load_scene(own_file("cut.laz", whole.substr(0, length))); });
    std::string wrong = whole;
    wrong.replace(format == 6 ? 247 : 107, 4, bytes_of(std::uint32_t{4'000'000'000}));
    expect_error(ErrorKind::content, {"many.laz", "4000000000 points", "again"},
                 [&] { load_scene(own_file("many.laz", wrong)); });
    wrong = whole;
    wrong.replace(105, 2, bytes_of(std::uint16_t{99}));
    expect_error(ErrorKind::content, {"size.laz", "cannot be unpacked"},
                 [&] { load_scene(own_file("size.laz", wrong)); });
  }
}

}  // namespace insonify::laz_tests
