// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

// Twelve beams over 60 degrees and 20 bins, all of one level but for single cells.
class ShowRect : public JetPictureTest {
 protected:
  ReadPicture show() {
    show_rect(image, options, path);
    return read_png(path);
  }
  Blob find(const ReadPicture& picture, double db) const {
    const Rgb colour = colour_scale(image.level_db, options, "test").colour(db);
    return find_colour(picture, colour, 0, 0.91 * picture.width, 0,
                       picture.height);  // without the colour bar
  }

  LevelImage image = flat_image(12, 60, 20, 5);
};

}  // namespace

TEST_F(ShowRect, has_starboard_right_and_range_upwards_and_every_cell_in_its_colour) {
  image.level_db(0, 19) = 40;  // the first beam has the lowest azimuth: outermost to starboard, far
  image.level_db(11, 0) = 60;  // port, near
  image.level_db(5, 10) = 80;  // just to starboard, in the middle
  const ReadPicture picture = show();
  const Blob starboard_far = find(picture, 40), port_near = find(picture, 60), middle = find(picture, 80);
  for (const Blob& blob : {starboard_far, port_near, middle}) ASSERT_GT(blob.pixels, 500);
  EXPECT_LT(port_near.x, middle.x);
  EXPECT_LT(middle.x, starboard_far.x);
  EXPECT_LT(port_near.y, middle.y);
  EXPECT_LT(middle.y, starboard_far.y);

  // The middle cell lies at 6/11 of the beams and 10/19 of the bins. Grid lines cover up to a pixel of a cell's middle.
  EXPECT_NEAR((middle.x - port_near.x) / (starboard_far.x - port_near.x), 6.0 / 11, 0.01);
  EXPECT_NEAR((middle.y - port_near.y) / (starboard_far.y - port_near.y), 10.0 / 19, 0.01);
}

TEST_F(ShowRect, comes_out_in_the_size_asked_for) {
  options.width = 640, options.height = 512;
  const ReadPicture picture = show();
  EXPECT_EQ(picture.width, 640);
  EXPECT_EQ(picture.height, 512);
}

TEST_F(ShowRect, draws_a_single_cell) {
  image = flat_image(1, 10, 1, 50);
  EXPECT_GT(find(show(), 50).pixels, 100000);
}

TEST_F(ShowRect, refuses_an_image_of_another_size_than_its_fan) {
  image.fan.azimuth.pop_back();
  image.fan.elevation.pop_back();
  EXPECT_THROW(show_rect(image, options, path), Error);
  EXPECT_FALSE(file_exists(path));
}
