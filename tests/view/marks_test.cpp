// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

// Returns 91 beams 1 degree apart, 100 bins of 0.5 m from 1 m, dark.
LevelImage dark_image() { return flat_image(91, 91, 100, -200); }

// Adds a peak with a skirt of weaker neighbours at a bearing [deg, positive to starboard] and a bin.
void add_peak(LevelImage& image, double bearing_deg, Eigen::Index bin, float db) {
  for (std::size_t b = 0; b < image.fan.beams(); ++b)
    for (Eigen::Index n = bin - 2; n <= bin + 2; ++n) {
      const double off =
          std::abs(-degrees(image.fan.azimuth[b]) - bearing_deg) + std::abs(static_cast<double>(n - bin));
      float& level = image.level_db(static_cast<Eigen::Index>(b), n);
      if (off < 4) level = std::max(level, db - 6 * static_cast<float>(std::round(off)));
    }
}

}  // namespace

TEST(StrongestMaxima, are_the_peaks_in_order_of_level_with_range_bearing_and_level) {
  LevelImage image = dark_image();
  add_peak(image, -20, 30, 90);
  add_peak(image, 30, 80, 100);
  add_peak(image, 5, 50, 80);
  const std::vector<Mark> marks = strongest_maxima(image, 5, 40);
  ASSERT_EQ(marks.size(), 3U) << "a skirt is no maximum";
  EXPECT_EQ(marks[0].text, "41.2 m, +30.0°, 100.0 dB");
  EXPECT_EQ(marks[1].text, "16.2 m, -20.0°, 90.0 dB");
  EXPECT_NEAR(marks[2].bearing, radians(5), 1e-9);
  EXPECT_NEAR(marks[2].range, 26.25, 1e-9);
  EXPECT_EQ(strongest_maxima(image, 2, 40).size(), 2U);
  EXPECT_EQ(strongest_maxima(image, 5, 15).size(), 2U) << "20 dB below the strongest";
}

// A twentieth of 51 m is 2.55 m.
TEST(StrongestMaxima, keep_their_distance) {
  LevelImage image = dark_image();
  add_peak(image, 0, 50, 100);
  image.level_db(45, 53) = 95;
  add_peak(image, 0, 60, 90);
  const std::vector<Mark> marks = strongest_maxima(image, 5, 40);
  ASSERT_EQ(marks.size(), 2U) << "1.5 m away is too near, 5 m is not";
  EXPECT_NEAR(marks[1].range, 31.25, 1e-9);
}

TEST(StrongestMaxima, of_silence_are_none) {
  EXPECT_TRUE(strongest_maxima(dark_image(), 5, 40).empty());
  EXPECT_THROW(strongest_maxima(dark_image(), 5, 0), Error);
}

TEST(Marks, outside_the_sector_are_left_out_and_bearings_come_round_the_circle) {
  const RangeGate gate{1, 51, 0.5};
  const auto kept = [&](double bearing_deg, double range, double low_deg, double high_deg) {
    return marks_within({{radians(bearing_deg), range, ""}}, radians(low_deg), radians(high_deg), gate);
  };
  EXPECT_EQ(kept(10, 20, -45, 45).size(), 1U);
  EXPECT_TRUE(kept(50, 20, -45, 45).empty());
  EXPECT_TRUE(kept(10, 52, -45, 45).empty());
  EXPECT_TRUE(kept(10, 0.5, -45, 45).empty());
  ASSERT_EQ(kept(-170, 20, 100, 260).size(), 1U) << "a fan across the stern";
  EXPECT_NEAR(kept(-170, 20, 100, 260)[0].bearing, radians(190), 1e-9);
  EXPECT_NEAR(kept(350, 20, -45, 45)[0].bearing, radians(-10), 1e-9);
}

TEST(Marks, have_their_ring_where_they_are) {
  unsetenv("DISPLAY");
  const std::string path = own_path("marks.png");
  LevelImage image = dark_image();
  PictureOptions options;
  options.min_db = 0, options.max_db = 100;
  options.marks = {{radians(25), 40, ""}, {radians(-30), 12, ""}};
  show_fan(image, options, path);
  const ReadPicture picture = read_png(path);
  const BeamCells cells = order_beams(image);
  const FanLayout layout = lay_out_fan({cells.low(), cells.high(), 1, 51}, options,
                                       colour_scale(image.level_db, options, "test"), image.unit);
  for (const Mark& mark : options.marks) {
    const Point2 at = layout.at(mark.bearing, mark.range);
    const Blob ring = find_colour(picture, {89, 224, 255}, at.x - 30, at.x + 30, at.y - 30, at.y + 30);
    EXPECT_GT(ring.pixels, 20);
    EXPECT_NEAR(ring.x, at.x, 0.7);
    EXPECT_NEAR(ring.y, at.y, 0.7);
  }
  const Point2 port = layout.at(radians(-25), 40);
  EXPECT_EQ(find_colour(picture, {89, 224, 255}, port.x - 30, port.x + 30, port.y - 30, port.y + 30).pixels, 0);
}

TEST(Marks, in_a_crowd_keep_names_off_each_other_and_off_the_rings) {
  unsetenv("DISPLAY");
  PictureOptions options;
  for (int i = 0; i < 60; ++i)
    options.marks.push_back({radians(-6 + 0.2 * i), 20 + 0.3 * (i * 7 % 40), "name " + std::to_string(i)});
  const LevelImage image = dark_image();
  const VtkMessages messages;
  Canvas canvas(options, "test");
  draw_fan(canvas, image, options);
  std::size_t names = 0;
  const auto& texts = canvas.texts();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    names += texts[i].text.starts_with("name");
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(texts[i].box().overlaps(texts[j].box())) << texts[i].text;
  }
  EXPECT_GT(names, 12U);
  EXPECT_LE(names, 60U);
}
