// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowPattern : public PictureTest {
 protected:
  void SetUp() override {
    for (int i = -90; i <= 90; ++i) azimuth.push_back(radians(i));
    level_db.assign(azimuth.size(), -50);
  }

  void expect_refused(const std::string& message) const {
    EXPECT_EQ(error_of([&] { show_pattern(azimuth, level_db, options, path); }), message);
  }

  std::vector<double> azimuth, level_db;
};

}  // namespace

// Azimuth is positive to port, bearing to starboard: port is on the left.
TEST_F(ShowPattern, draws_port_on_the_left_and_level_upwards) {
  for (std::size_t i = 0; i < azimuth.size(); ++i)
    if (azimuth[i] > radians(30)) level_db[i] = -10;
  show_pattern(azimuth, level_db, options, path);
  const ReadPicture picture = read_png(path);
  EXPECT_EQ(picture.width, 800);
  EXPECT_EQ(picture.height, 600);
  const double port = line_height(picture, 0.195, 0.2), starboard = line_height(picture, 0.795, 0.8);
  ASSERT_GT(starboard, 0);
  // 40 of 60 dB, of a frame that takes most of the picture.
  EXPECT_GT(port - starboard, 0.5 * picture.height);
}

TEST_F(ShowPattern, nulls_of_minus_infinity_fall_out_of_the_chart) {
  level_db.assign(azimuth.size(), -std::numeric_limits<double>::infinity());
  show_pattern(azimuth, level_db, options, path);
  EXPECT_EQ(line_height(read_png(path), 0.2, 0.9), -1);
}

TEST_F(ShowPattern, refuses_what_is_no_pattern) {
  level_db.pop_back();
  expect_refused("show_pattern: 180 levels for 181 azimuths, must be as many");
  level_db.push_back(std::nan(""));
  expect_refused("show_pattern: level_db[180] is NaN, must be a level");
  level_db.back() = 0;
  options.min_db = 3;
  expect_refused("show_pattern: max_db = 0 dB, must exceed min_db = 3 dB");
  options.width = 3;
  expect_refused("show_pattern: options.width x height = 3 x 600 pixels, must be 240 to 8192 either way");
  azimuth.clear();
  level_db.clear();
  expect_refused("show_pattern: 0 points, must be at least 2");
  EXPECT_FALSE(file_exists(path));
}
