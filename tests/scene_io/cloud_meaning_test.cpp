// SPDX-License-Identifier: BSD-3-Clause
// Tests the meaning of the numbers of clouds, in all formats, read whole and in batches.
#include "scene_io/describe_file.hpp"
#include "scene_io/las_file.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

/// Positions of a cloud with upright normals.
using Positions = std::vector<Eigen::Vector3d>;

Positions level_bed(double x, double y, double step, double z, int side = 32) {
  Positions all;
  for (int i = 0; i < side * side; ++i)
    all.emplace_back(x + step * (i % side), y + step * (i / side), z - 0.125 * ((7 * i) % 11));
  return all;
}

std::string rows_as_text(const Positions& positions, const std::string& heading) {
  std::ostringstream text;
  text.precision(12);
  text << heading;
  for (const Eigen::Vector3d& p : positions) text << p.transpose() << " 0 0 1\n";
  return text.str();
}

std::string rows_as_binary(const Positions& positions) {
  std::string rows;
  for (const Eigen::Vector3d& p : positions) {
    for (int axis = 0; axis < 3; ++axis) rows += bytes_of(p[axis]);
    rows += bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(1.0F);
  }
  return rows;
}

/// Writes the cloud in each format that can be read in batches, and as text. Returns the paths.
std::vector<std::string> files_of(const Positions& positions) {
  const std::string count = std::to_string(positions.size());
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + count + "\n";
  for (const char* name : {"x", "y", "z"}) ply += std::string("property double ") + name + "\n";
  for (const char* name : {"nx", "ny", "nz"}) ply += std::string("property float ") + name + "\n";
  LasFile las{.normals = true};
  las.scale = 1e-4;
  las.offset = positions[0].array().round();
  las.offset.z() = 0;
  return {own_file("a.xyz", rows_as_text(positions, "x y z nx ny nz\n")),
          own_file("a.ply", ply + "end_header\n" + rows_as_binary(positions)),
          own_file("a.pcd",
                   "FIELDS x y z normal_x normal_y normal_z\nSIZE 8 8 8 4 4 4\nTYPE F F F F F F\n"
                   "COUNT 1 1 1 1 1 1\nWIDTH " +
                       count + "\nHEIGHT 1\nPOINTS " + count + "\nDATA binary\n" + rows_as_binary(positions)),
          own_file("a.las", las.bytes(positions))};
}

/// Checks the reports of load_scene, prepare_tiles in batches and describe_file for each of these files.
void expect_of_all(const Positions& positions, const MeaningOverride& requested,
                   const std::function<void(const LoadReport&, const Bounds&, std::size_t points)>& check) {
  for (const std::string& path : files_of(positions)) {
    SCOPED_TRACE(path);
    LoadOptions options;
    options.meaning = requested;
    const LoadedScene loaded = load_scene(path, options);
    check(loaded.report, bounds(loaded.scene), loaded.scene.size());
    PrepareTilesOptions tiles;
    tiles.load = options;
    tiles.whole_points = 0;
    const PreparedTiles prepared = prepare_tiles(path, own_path("a.tiles"), tiles);
    EXPECT_EQ(prepared.streamed, !path.ends_with(".xyz"));
    const TiledScene scene(own_path("a.tiles"));
    check(prepared.report, scene.info().box, scene.info().surfels);
    const FileDescription file = describe_file(path, requested);
    EXPECT_LT((file.min - bounds(loaded.scene).min).norm(), 1e-3);
    EXPECT_LT((file.max - bounds(loaded.scene).max).norm(), 1e-3);
  }
}

}  // namespace

TEST(CloudMeaning, undeclared_marks_are_holes) {
  for (const double mark : {-9999.0, -32768.0, -99999.0}) {
    Positions positions = level_bed(500000, 6000000, 0.25, -12);
    for (std::size_t i = 100; i < 116; ++i) positions[i].z() = mark;
    expect_of_all(positions, {}, [&](const LoadReport& report, const Bounds& box, std::size_t points) {
      EXPECT_EQ(points, positions.size() - 16);
      EXPECT_NEAR(box.min.z(), -13.25, 1e-3);
      EXPECT_TRUE(has_note(report, "16 heights are " + std::to_string(static_cast<int>(mark)))) << mark;
    });
    expect_of_all(positions, meaning_override("nodata", "none"),
                  [&](const LoadReport& report, const Bounds& box, std::size_t points) {
                    EXPECT_EQ(points, positions.size());
                    EXPECT_NEAR(box.min.z(), mark, 1e-2);
                    EXPECT_FALSE(has_note(report, ": holes"));
                  });
  }
}

TEST(CloudMeaning, a_declared_mark_is_a_hole_and_an_odd_height_stays) {
  Positions positions = level_bed(500000, 6000000, 0.25, -12);
  positions[40].z() = -500;
  expect_of_all(positions, {}, [&](const LoadReport& report, const Bounds& box, std::size_t points) {
    EXPECT_EQ(points, positions.size());
    EXPECT_NEAR(box.min.z(), -500, 1e-3);
    EXPECT_TRUE(has_note(report, "heights reach -500 m"));
  });
  expect_of_all(positions, meaning_override("nodata", "-500,7"),
                [&](const LoadReport&, const Bounds& box, std::size_t points) {
                  EXPECT_EQ(points, positions.size() - 1);
                  EXPECT_NEAR(box.min.z(), -13.25, 1e-3);
                });
}

TEST(CloudMeaning, numbers_like_degrees_are_noted) {
  expect_of_all(level_bed(7.9, 54.1, 1e-4, -12), {}, [](const LoadReport& report, const Bounds&, std::size_t) {
    EXPECT_TRUE(has_note(report, "degrees?"));
  });
  expect_of_all(level_bed(7.9, 54.1, 0.25, -12), {}, [](const LoadReport& report, const Bounds&, std::size_t) {
    EXPECT_FALSE(has_note(report, "degrees?"));
  });
}

TEST(CloudMeaning, unit_and_sign_of_the_caller_count_in_batches_too) {
  MeaningOverride requested = meaning_override("unit", "ft");
  requested.z_down = true;
  const Positions positions = level_bed(400, 300, 0.25, 40);
  expect_of_all(positions, requested, [&](const LoadReport&, const Bounds& box, std::size_t points) {
    EXPECT_EQ(points, positions.size());
    EXPECT_LT((box.min - 0.3048 * Eigen::Vector3d(400, 300, -40)).norm(), 2e-3);
    EXPECT_LT((box.max - 0.3048 * Eigen::Vector3d(407.75, 307.75, -38.75)).norm(), 2e-3);
  });
}

TEST(CloudMeaning, classes_concern_files_of_classes_alone) {
  const Positions positions = level_bed(100, 200, 0.25, -12);
  for (const std::string& path : files_of(positions)) {
    if (path.ends_with(".las")) continue;
    LoadOptions options;
    options.meaning = meaning_override("classes", "2,9");
    EXPECT_EQ(load_scene(path, options).scene.size(), positions.size()) << path;
  }
}

// Fields of a binary file may have headings as well.
TEST(CloudMeaning, fields_of_depths_and_other_units_are_known_in_batches) {
  const Positions positions = level_bed(100, 200, 0.25, 12);
  for (const std::string& path : files_of(positions)) {
    if (!path.ends_with(".ply") && !path.ends_with(".pcd")) continue;
    const bool ply = path.ends_with(".ply");
    std::string bytes = file_bytes(path);
    bytes = ply ? replaced(replaced(replaced(bytes, "double x\n", "double Easting\n"), "double y\n", "double north\n"),
                           "double z\n", "double depth_cm\n")
                : replaced(bytes, "FIELDS x y z", "FIELDS easting northing depth_cm");
    const std::string named = own_file(ply ? "b.ply" : "b.pcd", bytes);
    PrepareTilesOptions tiles;
    tiles.whole_points = 0;
    const PreparedTiles prepared = prepare_tiles(named, own_path("b.tiles"), tiles);
    EXPECT_TRUE(prepared.streamed);
    const Bounds box = TiledScene(own_path("b.tiles")).info().box;
    EXPECT_LT((box.min - Eigen::Vector3d(100, 200, -0.12)).norm(), 1e-3) << named;
    EXPECT_TRUE(has_note(prepared.report, "the heights are called depths")) << named;
    EXPECT_LT((bounds(load_scene(named).scene).min - box.min).norm(), 1e-3) << named;
  }
}

TEST(CloudMeaning, a_mesh_on_its_side_is_noted_and_can_be_set_up) {
  // A wavy bed of 32 x 32 m whose y axis points up, as programs of films write it.
  std::ostringstream obj;
  for (int i = 0; i < 33 * 33; ++i) obj << "v " << i % 33 << ' ' << -5 + 0.1 * (i % 3) << ' ' << -(i / 33) << '\n';
  for (int row = 0; row < 32; ++row)
    for (int c = 1; c <= 32; ++c) {
      const int a = 33 * row + c;
      obj << "f " << a << ' ' << a + 1 << ' ' << a + 34 << ' ' << a + 33 << '\n';
    }
  const std::string path = own_file("bed.obj", obj.str());
  EXPECT_TRUE(has_note(load_scene(path).report, "give --up y"));
  LoadOptions options;
  options.meaning = meaning_override("up", "y");
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_FALSE(has_note(loaded.report, "give --up y"));
  const Bounds box = bounds(loaded.scene);
  EXPECT_NEAR(box.max.y(), 32, 0.5);
  EXPECT_NEAR(box.min.z(), -5, 0.05);
  for (const Eigen::Vector3f& normal : loaded.scene.normal) EXPECT_GT(normal.z(), 0.9f);
}
