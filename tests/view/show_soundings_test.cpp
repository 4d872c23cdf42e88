// SPDX-License-Identifier: BSD-3-Clause
// Soundings of a ping across its way: drawn wherever in the world they are.
#include "support/test.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowSoundings : public PictureTest {
 protected:
  /// Draws a bed 2 m deep below the head that rises by 0.6 m, in 40 soundings, `by` away from the world's origin.
  ReadPicture drawn(const Eigen::Vector3d& by) {
    Ping ping;
    ping.world_from_head.translation() = by;
    BottomSoundings found;
    for (int i = 0; i < 40; ++i) {
      found.position.push_back(by + Eigen::Vector3d(0, 2 - 0.1 * i, -2 + 0.015 * i));
      found.range.push_back(2);
      found.reject.push_back(0);
      found.method.push_back(i % 2 == 0 ? BottomMethod::amplitude : BottomMethod::phase);
    }
    show_soundings(ping, found, options, path);
    return read_png(path);
  }
  /// Counts the pixels of both kinds of points, below the legend.
  static std::array<int, 2> points_in(const ReadPicture& picture) {
    const auto count = [&](const Rgb& colour) {
      return find_colour(picture, colour, 0, picture.width, 0, 0.85 * picture.height).pixels;
    };
    return {count({20, 84, 158}), count({217, 94, 13})};
  }
};

}  // namespace

// The bed rises to starboard, which is right.
TEST_F(ShowSoundings, have_starboard_right_and_height_upwards) {
  const ReadPicture picture = drawn({0, 0, 0});
  const auto height = [&](double from, double to) {
    return find_colour(picture, {20, 84, 158}, from * picture.width, to * picture.width, 0, 0.85 * picture.height).y;
  };
  EXPECT_GT(height(0.6, 1), height(0, 0.4) + 50);
}

TEST_F(ShowSoundings, are_drawn_wherever_they_are) {
  const auto near = points_in(drawn({0, 0, 0}));
  EXPECT_GT(near[0], 200);
  EXPECT_GT(near[1], 200);
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0, 0, -150), {0, 0, 374}, {0, 0, 1e4}, {0, 0, -1e4}, {5e5, 5.4e6, -374}}) {
    const auto far = points_in(drawn(by));
    for (std::size_t kind = 0; kind < 2; ++kind)
      EXPECT_NEAR(far[kind], near[kind], 0.1 * near[kind]) << "about " << by.transpose();
  }
}
