// SPDX-License-Identifier: BSD-3-Clause
// Tests a survey from above: tracks and levels to one scale, x to the right and y up.
#include "view/show_track.hpp"

#include "support/test.hpp"
#include "view/grey_file.hpp"
#include "view/save_vtk.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowTrack : public PictureTest {
 protected:
  /// Sets a track of 20 m along x, 5 m above the middle of a square of 20 m of levels, whose right half is loud.
  ShowTrack() {
    map.tracks = {{"fls", {{0, 5}, {20, 5}}, {}}};
    map.x = 0, map.y = -10, map.cell = 1;
    map.level_db.setConstant(20, 20, 60);
    map.level_db.bottomRows(10).setConstant(100);
    options.colour_map = "grey", options.min_db = 50, options.max_db = 100;
  }
  TrackMap map;
};

/// Pixels near a colour: extent and number.
struct ColouredPixels {
  int left = 1 << 20, right = -1, low = 1 << 20, high = -1, count = 0;
};
ColouredPixels near_colour(const ReadPicture& picture, const Rgb& colour) {
  ColouredPixels found;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (colour_difference(picture.at(x, y), colour) < 20) {
        found.left = std::min(found.left, x), found.right = std::max(found.right, x);
        found.low = std::min(found.low, y), found.high = std::max(found.high, y);
        ++found.count;
      }
  return found;
}

}  // namespace

TEST_F(ShowTrack, draws_the_way_to_the_scale_of_the_levels) {
  show_track(map, options, path);
  const ReadPicture picture = read_png(path);
  const ColouredPixels head_track = near_colour(picture, {26, 191, 242});
  ASSERT_GT(head_track.count, 100);
  // The way of 20 m is as long as the square is wide: its loud half is half as long, and lies under the right half of
  // it.
  const int length = head_track.right - head_track.left, middle = (head_track.left + head_track.right) / 2,
            below = (head_track.low + head_track.high) / 2 - length / 8;
  EXPECT_LT(colour_difference(picture.at(middle + length / 4, below), {255, 255, 255}), 20);
  EXPECT_GT(colour_difference(picture.at(middle - length / 4, below), {255, 255, 255}), 60);
  // A quarter of its length from the top of the square, three quarters from the bottom.
  EXPECT_LT(colour_difference(picture.at(middle + length / 4, head_track.low - 0.7 * length), {255, 255, 255}), 20);
  EXPECT_GT(colour_difference(picture.at(middle - length / 4, head_track.low - 0.7 * length), {255, 255, 255}), 60);
}

TEST_F(ShowTrack, is_the_same_in_utm) {
  show_track(map, options, path);
  const int near = near_colour(read_png(path), {26, 191, 242}).count;
  map.x += 5e5, map.y += 5.4e6;
  for (TrackMap::HeadTrack& head_track : map.tracks)
    for (Eigen::Vector2d& position : head_track.positions) position += Eigen::Vector2d(5e5, 5.4e6);
  show_track(map, options, path);
  EXPECT_NEAR(near_colour(read_png(path), {26, 191, 242}).count, near, 0.1 * near);
}

TEST_F(ShowTrack, draws_ways_without_levels_and_refuses_nothing_at_all) {
  map.level_db.resize(0, 0);
  show_track(map, options, path);
  EXPECT_GT(near_colour(read_png(path), {26, 191, 242}).count, 100);
  map.tracks.clear();
  EXPECT_THAT(error_of([&] { show_track(map, options, path); }), HasSubstr("no way has a place"));
}

// Three cells along x and two along y; the brightest is the second one of the upper row, the others are 45 dB below.
TEST_F(ShowTrack, a_picture_of_a_map_has_y_up_and_names_the_middle_of_its_upper_left_pixel) {
  HorizontalMap written{-3, 7, 0.5, {{"strength_db", Grid<float>::Constant(3, 2, -60)}}};
  written.fields[0].values(1, 1) = -15;
  save_map_picture(own_path("map"), written, 45);
  const Grid<std::uint16_t> pixel = load_grey_png(own_path("map.png")).value;  // rows from the top
  ASSERT_EQ(pixel.rows(), 2);
  ASSERT_EQ(pixel.cols(), 3);
  EXPECT_EQ(pixel(0, 1), 255);
  EXPECT_EQ(pixel(1, 1), 1);
  EXPECT_EQ(file_bytes(own_path("map.pgw")), "0.5\n0\n0\n-0.5\n-2.75\n7.75\n");
}

TEST_F(ShowTrack, maps_are_read_as_they_were_written) {
  HorizontalMap written{-3, 7, 0.5, {{"strength_db", Grid<float>::Random(5, 3)}, {"samples", Grid<float>::Ones(5, 3)}}};
  written.fields[0].values(2, 1) = std::numeric_limits<float>::quiet_NaN();
  save_map_image(own_path("map.vti"), written);
  const HorizontalMap back = load_map_image(own_path("map.vti"));
  EXPECT_EQ(back.x, -3);
  EXPECT_EQ(back.y, 7);
  EXPECT_EQ(back.cell, 0.5);
  ASSERT_EQ(back.fields.size(), 2U);
  EXPECT_EQ(back.fields[0].name, "strength_db");
  EXPECT_TRUE(std::isnan(back.fields[0].values(2, 1)));
  EXPECT_EQ(back.fields[0].values(4, 2), written.fields[0].values(4, 2));
  EXPECT_EQ(back.fields[0].values(4, 0), written.fields[0].values(4, 0));
  expect_error(ErrorKind::file, {"none.vti", "no such file"}, [] { load_map_image(own_path("none.vti")); });
}
