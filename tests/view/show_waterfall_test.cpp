// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

// Eight pings of 20 bins, all of one level but for single cells.
class ShowWaterfall : public JetPictureTest {
 protected:
  void SetUp() override {
    history.gate = {1, 11, 0.5};
    history.unit = "dB re 1 µPa";
    history.level_db = Grid<float>::Constant(8, 20, 5);
    for (int ping = 0; ping < 8; ++ping) {
      history.number.push_back(ping);
      history.time.push_back(0.2 * ping);
    }
  }
  ReadPicture show() {
    show_waterfall(history, options, path);
    return read_png(path);
  }
  ColourScale scale() const { return colour_scale(history.level_db, options, "test"); }
  Blob find(const ReadPicture& picture, double db) const {
    return find_colour(picture, scale().colour(db), 0, 0.9 * picture.width, 0, picture.height);  // without the bar
  }
  std::string refusal() {
    const std::string error = error_of([&] { show_waterfall(history, options, path); });
    EXPECT_FALSE(file_exists(path));
    return error;
  }

  PingHistory history;
};

}  // namespace

TEST_F(ShowWaterfall, has_the_newest_ping_on_top_and_range_to_the_right) {
  history.level_db(0, 18) = 40;  // the oldest, far
  history.level_db(7, 1) = 60;   // the newest, near
  history.level_db(4, 9) = 80;
  const ReadPicture picture = show();
  const Blob oldest = find(picture, 40), newest = find(picture, 60), middle = find(picture, 80);
  for (const Blob& blob : {oldest, newest, middle}) ASSERT_GT(blob.pixels, 500);
  EXPECT_GT(newest.y, middle.y);
  EXPECT_GT(middle.y, oldest.y);
  EXPECT_NEAR((middle.y - oldest.y) / (newest.y - oldest.y), 4.0 / 7, 0.01);
  EXPECT_NEAR((middle.x - newest.x) / (oldest.x - newest.x), 8.0 / 17, 0.01);
}

TEST_F(ShowWaterfall, shows_every_sample_in_the_colour_of_its_level) {
  for (Eigen::Index i = 0; i < 160; ++i) history.level_db.data()[i] = 0.6f * static_cast<float>(i);
  const ReadPicture picture = show();
  const Blob first = find(picture, history.level_db(0, 0)), last = find(picture, history.level_db(7, 19));
  ASSERT_GT(first.pixels, 500);
  ASSERT_GT(last.pixels, 500);
  for (Eigen::Index ping = 0; ping < 8; ++ping)
    for (Eigen::Index bin = 0; bin < 20; ++bin) {
      // Interpolate between the centres of the outermost cells, slightly off possible grid lines.
      const double x = first.x + (last.x - first.x) * (static_cast<double>(bin) + 0.23) / 19;
      const double y = first.y + (last.y - first.y) * (static_cast<double>(ping) + 0.23) / 7;
      if (bin == 19 || ping == 7) continue;
      EXPECT_LE(colour_difference(picture.at(x, y), scale().colour(history.level_db(ping, bin))), 8)
          << ping << ", " << bin;
    }
}

TEST_F(ShowWaterfall, of_thousands_of_pings_loses_none) {
  history.level_db = Grid<float>::Constant(6000, 20, -200);
  history.level_db.row(3003) = 100;
  history.number.resize(6000);
  history.time.resize(6000);
  for (std::size_t p = 0; p < 6000; ++p) history.number[p] = static_cast<std::int64_t>(p);
  options.colour_map = "grey";
  options.max_db = 100;
  const ReadPicture picture = show();
  int brightest = 0;
  for (int y = 0; y < picture.height; ++y)
    brightest = std::max(brightest, int{picture.at(0.37 * picture.width, y)[0]} * (y > 200 && y < 900));
  EXPECT_GT(brightest, 100) << "seven pings share a row of pixels";
}

TEST_F(ShowWaterfall, refuses_a_single_ping_and_parts_that_do_not_agree) {
  history.time.pop_back();
  EXPECT_THAT(refusal(), HasSubstr("show_waterfall: history.level_db is 8 x 20"));
  history.level_db = Grid<float>::Constant(1, 20, 5);
  EXPECT_EQ(refusal(), "show_waterfall: 1 pings, must be at least 2");
}
