// SPDX-License-Identifier: BSD-3-Clause
// Positions without normals, which are completed group by group of tiles if the file is large.
#include <random>

#include "scene_io/complete_scene_internal.hpp"
#include "support/test.hpp"
#include "test_files.hpp"
#include "tile_batches.hpp"

namespace {

/// Returns points of a bed of waves, unevenly about 0.1 m apart, in rows whose length divides a sample evenly.
std::vector<Eigen::Vector3d> uneven_bed(int side) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.04, 0.04);
  std::vector<Eigen::Vector3d> bed;
  for (int i = 0; i < side * side; ++i) {
    const double x = 0.1 * (i % side) + shift(random), y = 0.1 * (i / side) + shift(random);
    bed.emplace_back(431000 + x, 5412000 + y, 0.3 * std::sin(x) * std::cos(0.7 * y) + 0.1 * shift(random));
  }
  return bed;
}

/// Writes a PLY of positions alone.
std::string bare_ply(const std::vector<Eigen::Vector3d>& points) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += std::string("property double ") + axis + "\n";
  text += "end_header\n";
  for (const Eigen::Vector3d& p : points) text += bytes_of(p.x()) + bytes_of(p.y()) + bytes_of(p.z());
  return own_file("bare.ply", text);
}

/// Expects the same points, and the same normals, areas and noise of all but a few: neighbours at one distance may
/// decide otherwise in another order, and at a seam the 12 spacings around a tile are those of a mean density. Normals
/// that are not oriented have no side, so the sign does not count.
void expect_nearly_same(const SceneCloud& found, const SceneCloud& expected) {
  ASSERT_EQ(found.size(), expected.size());
  std::vector<std::size_t> row(expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) row[expected.id[i]] = i;
  std::size_t normals = 0, areas = 0, noise = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t k = row[found.id[i]];
    ASSERT_EQ(found.point[i], expected.point[k]);
    const bool turned = !expected.normals_oriented && found.normal[i].dot(expected.normal[k]) < 0;
    normals += (found.normal[i] - (turned ? -1.0F : 1.0F) * expected.normal[k]).norm() > 1e-4F;
    areas += std::abs(found.area[i] - expected.area[k]) > 1e-4F * expected.area[k];
    noise += std::abs(found.noise[i] - expected.noise[k]) > 1e-4F * expected.noise[k];
  }
  EXPECT_LE(normals, found.size() / 1000);
  EXPECT_LE(areas, found.size() / 1000);
  EXPECT_LE(noise, found.size() / 1000);
}

}  // namespace

TEST(PrepareBarePoints, points_without_normals_are_completed_in_batches_as_in_memory) {
  const std::vector<Eigen::Vector3d> bed = uneven_bed(180);
  PrepareTilesOptions options = in_batches();
  for (const bool seen : {false, true}) {
    if (seen) options.load.viewpoint = {431009, 5412009, 30};
    const PreparedTiles prepared = prepare_tiles(bare_ply(bed), own_path("bed.tiles"), options);
    EXPECT_TRUE(prepared.streamed);
    EXPECT_EQ(prepared.normals_oriented, seen);
    EXPECT_TRUE(prepared.report.normals_estimated && prepared.report.areas_estimated &&
                prepared.report.noise_estimated);
    EXPECT_EQ(std::count(prepared.report.notes.begin(), prepared.report.notes.end(), two_sided_note), seen ? 0 : 1);
    expect_nearly_same(load_all(own_path("bed.tiles")), load_scene(bare_ply(bed), options.load).scene);
  }
  options.load.scan_noise = 0.125;
  prepare_tiles(bare_ply(bed), own_path("bed.tiles"), options);
  const SceneCloud noisy = load_all(own_path("bed.tiles"));
  EXPECT_EQ(std::count(noisy.noise.begin(), noisy.noise.end(), 0.125F), std::ssize(bed));
}

// Neighbours of points beside a seam stand in other groups of tiles.
TEST(PrepareBarePoints, groups_of_tiles_are_completed_without_seams) {
  const LoadedScene whole = load_scene(bare_ply(uneven_bed(180)));
  TileWriterOptions writing{.origin = whole.scene.origin, .tile_surfels = 50};  // some seven groups
  std::size_t groups = 0;
  writing.complete = [&](SceneCloud& group) {
    ++groups;
    complete_group({{}, whole.scene.origin, {}, true, true}, group);
  };
  SceneCloud blank = whole.scene;
  blank.normal.assign(blank.size(), Eigen::Vector3f::UnitZ());
  blank.area.assign(blank.size(), 0), blank.noise.assign(blank.size(), 0);
  TileWriter writer(own_path("groups.tiles"), writing);
  writer.add(blank);
  writer.finish();
  EXPECT_GE(groups, 5U);
  expect_nearly_same(load_all(own_path("groups.tiles")), whole.scene);
}

TEST(PrepareBarePoints, a_raster_of_heights_without_normals_is_completed_whole) {
  std::vector<Eigen::Vector3d> heights;
  for (int i = 0; i < 2500; ++i) heights.emplace_back(0.5 * (i % 50), 0.5 * (i / 50), 0.1 * std::sin(0.2 * i));
  const PreparedTiles prepared = prepare_tiles(bare_ply(heights), own_path("raster.tiles"), in_batches());
  EXPECT_FALSE(prepared.streamed);
  EXPECT_TRUE(prepared.normals_oriented);
  EXPECT_THAT(prepared.report.notes, testing::Contains(HasSubstr("raster of heights")));
}
