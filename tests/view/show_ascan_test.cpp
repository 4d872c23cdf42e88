// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowAscan : public PictureTest {
 protected:
  LevelImage image = flat_image(3, 60, 300, -200);
};

}  // namespace

// Thirds at 90, 100 and 120 dB: the steps between them are 10 and 20 dB high.
TEST_F(ShowAscan, draws_level_upwards_over_range_to_the_right) {
  image.level_db.row(1).head(100) = 90;
  image.level_db.row(1).segment(100, 100) = 100;
  image.level_db.row(1).tail(100) = 120;
  options.min_db = 80, options.max_db = 130;
  show_ascan(image, 1, options, path);
  const ReadPicture picture = read_png(path);
  EXPECT_EQ(picture.width, 800);
  EXPECT_EQ(picture.height, 600);
  const double near = line_height(picture, 0.15, 0.3), middle = line_height(picture, 0.45, 0.6);
  const double far = line_height(picture, 0.75, 0.9);
  ASSERT_GT(near, 0);
  EXPECT_GT(middle - near, 100);
  EXPECT_NEAR((far - middle) / (middle - near), 2, 0.02);
}

TEST_F(ShowAscan, shows_the_beam_asked_for) {
  image.level_db.row(2) = 100;
  show_ascan(image, 2, options, path);
  EXPECT_GT(line_height(read_png(path), 0.2, 0.9), 0);
  options.min_db = 50, options.max_db = 120;
  show_ascan(image, 0, options, path);
  EXPECT_EQ(line_height(read_png(path), 0.2, 0.9), -1) << "a beam of floor has no line inside the chart";
}

TEST_F(ShowAscan, refuses_a_beam_that_is_not_there) {
  EXPECT_EQ(error_of([&] { show_ascan(image, 3, options, path); }),
            "show_ascan: beam = 3, must be below the number of beams, 3");
}
