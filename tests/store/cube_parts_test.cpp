// SPDX-License-Identifier: BSD-3-Clause
// Parts of a scene in cubes.
#include <cmath>

#include "store/concatenate_cube_files.hpp"
#include "store/merge_cubes_by_time.hpp"
#include "store/random_cube.hpp"
#include "store/raw_file.hpp"

namespace insonify::cube_parts_tests {

/// Returns labels of a scene of three parts, one of which is not in view.
PixelLabels labels_like(const Ping& ping) {
  const Eigen::Index beams = ping.pressure.rows(), bins = ping.pressure.cols();
  PixelLabels labels{Grid<std::uint16_t>::Zero(beams, bins),
                     Grid<std::uint32_t>::Constant(beams, bins, 7),
                     Grid<float>::Ones(beams, bins),
                     {"sand", "tyre"}};
  labels.part = Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::no_part);
  labels.part(3, 1) = static_cast<std::uint16_t>(ping.number % 3);
  labels.elevation = labels.second_share = Grid<float>::Zero(beams, bins);
  labels.elevation(3, 1) = -0.25F, labels.second_share(3, 1) = 0.125F;
  labels.second = Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::nothing);
  labels.second(3, 1) = 0;
  labels.part_names = {"bed", "pot-1", "tyre"}, labels.part_labels = {"", "", "tyre"};
  labels.views.resize(3);
  PartView& tyre = labels.views[2];
  tyre.world_from_part = pose_from_yaw_pitch_roll({1, 2, static_cast<double>(ping.number)}, 0.1, 0.2, 0.3);
  tyre.visible_share = 0.25, tyre.azimuth = {-0.1, 0.2}, tyre.elevation = {0.3, 0.4}, tyre.range = {5, 6};
  tyre.beam_azimuth = {-0.09, 0.19}, tyre.ahead = {4.5, 5.5}, tyre.port = {-0.5, 1}, tyre.scale = 1.25,
  tyre.size = {0.6, 0.6, 0.2};
  return labels;
}

Cube cube_of_parts(std::size_t pings = 3) {
  Cube cube = random_cube(pings, 5);
  for (Ping& ping : cube.pings) ping.labels = labels_like(ping);
  return cube;
}

void expect_parts(const Ping& ping) {
  const PixelLabels expected = labels_like(ping);
  const PixelLabels& back = ping.labels;
  EXPECT_TRUE((back.part == expected.part).all());
  EXPECT_TRUE((back.elevation == expected.elevation).all());
  EXPECT_TRUE((back.second == expected.second).all());
  EXPECT_TRUE((back.second_share == expected.second_share).all());
  EXPECT_EQ(back.names, expected.names);
  EXPECT_EQ(back.part_names, expected.part_names);
  EXPECT_EQ(back.part_labels, expected.part_labels);
  ASSERT_EQ(back.views.size(), 3U);
  EXPECT_TRUE(std::isnan(back.views[0].visible_share));
  EXPECT_TRUE(std::isnan(back.views[1].range.most));
  const PartView &a = back.views[2], &b = expected.views[2];
  EXPECT_EQ(a.world_from_part.matrix(), b.world_from_part.matrix());
  EXPECT_EQ(a.visible_share, b.visible_share);
  EXPECT_EQ(std::tie(a.azimuth, a.elevation, a.range), std::tie(b.azimuth, b.elevation, b.range));
  EXPECT_EQ(std::tie(a.beam_azimuth, a.ahead, a.port, a.scale, a.size),
            std::tie(b.beam_azimuth, b.ahead, b.port, b.scale, b.size));
}

TEST(CubeOfParts, comes_back_bit_for_bit) {
  const Cube back = read_cube(write(cube_of_parts()));
  ASSERT_EQ(back.pings.size(), 3U);
  for (const Ping& ping : back.pings) expect_parts(ping);
  const Cube last = read_cube(own_path("cube.h5"), 2, 1);
  ASSERT_EQ(last.pings.size(), 1U);
  expect_parts(last.pings[0]);
}

TEST(CubeOfParts, is_joined_with_the_next_one) {
  for (const bool copy : {false, true}) {
    const std::string path = own_path(copy ? "copied.h5" : "joined.h5");
    concatenate_cube_files(path, {write(cube_of_parts(3), "a.h5"), write(cube_of_parts(2), "b.h5")}, copy);
    const Cube back = read_cube(path);
    ASSERT_EQ(back.pings.size(), 5U);
    for (const Ping& ping : back.pings) expect_parts(ping);
  }
}

/// Writes a cube as earlier versions did: its views end after the third extent.
std::string earlier_cube(const std::string& name) {
  const std::string path = write(cube_of_parts(), name);
  const RawFile file(path);
  const std::vector<double> all = raw_values(file, "/part_views");
  const std::size_t views = all.size() / 29;
  std::vector<double> first;
  for (std::size_t v = 0; v < views; ++v) first.insert(first.end(), &all[29 * v], &all[29 * v] + 19);
  H5Ldelete(file, "/part_views", H5P_DEFAULT);
  const hsize_t extent[] = {3, 3, 19};
  const hid_t space = H5Screate_simple(3, extent, nullptr),
              made = H5Dcreate2(file, "/part_views", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, first.data()), 0);
  H5Dclose(made), H5Sclose(space);
  return path;
}

TEST(CubeOfParts, of_an_earlier_version_lacks_sizes) {
  const std::string path = earlier_cube("earlier.h5");
  for (const Ping& ping : read_cube(path).pings) {
    const PartView& tyre = ping.labels.views[2];
    EXPECT_EQ(tyre.range, (PartView::Extent{5, 6}));
    EXPECT_EQ(tyre.world_from_part.translation().z(), static_cast<double>(ping.number));
    EXPECT_TRUE(std::isnan(tyre.scale) && std::isnan(tyre.port.most) && tyre.size.hasNaN());
  }
  const std::string later = write(cube_of_parts(), "later.h5");
  EXPECT_THAT(error_with_kind([&] {
                concatenate_cube_files(own_path("both.h5"), {path, later}, false);
              }),
              testing::HasSubstr("/part_views has another shape than in the cubes before"));
}

TEST(CubeOfParts, loses_its_labels_beside_pings_of_other_parts) {
  Cube other = cube_of_parts();
  for (Ping& ping : other.pings) ping.labels.part_names[1] = "pot-2";
  const MergedCube merged = merge_cubes_by_time({{"a", cube_of_parts()}, {"b", other}});
  for (const Ping& ping : merged.cube.pings) EXPECT_TRUE(ping.labels.empty());
  // Labels of samples, without a second label, are dropped beside labels of cells, too.
  Cube of_samples = cube_of_parts();
  for (Ping& ping : of_samples.pings) {
    ping.labels.second.resize(0, 0);
    for (Grid<float>* map : {&ping.labels.second_share, &ping.labels.elevation}) map->resize(0, 0);
  }
  EXPECT_TRUE(merge_cubes_by_time({{"a", cube_of_parts()}, {"b", of_samples}}).cube.pings[0].labels.empty());
}

TEST(MergedCubes, lose_maps_that_not_all_have) {
  Cube looks = random_cube(), plain = looks;
  for (Ping& ping : looks.pings) ping.intensity = Grid<float>::Ones(ping.pressure.rows(), ping.pressure.cols());
  for (const Ping& ping : merge_cubes_by_time({{"a", looks}, {"b", plain}}).cube.pings)
    EXPECT_EQ(ping.intensity.size(), 0);
}

TEST(CubeOfParts, refuses_pings_of_other_parts) {
  Cube cube = cube_of_parts();
  cube.pings[1].labels.part_labels[1] = "pot";
  EXPECT_THAT(error_with_kind([&] { write_cube(own_path("bad.h5"), cube); }),
              testing::HasSubstr("ping 41 is of a scene of other parts than ping 40"));
  cube = cube_of_parts();
  cube.pings[2].labels.views.pop_back();
  EXPECT_THAT(error_with_kind([&] { write_cube(own_path("bad.h5"), cube); }),
              testing::HasSubstr("ping 42 has views of 2 parts, must have 3"));
}

}  // namespace insonify::cube_parts_tests
