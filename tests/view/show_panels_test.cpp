// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowPanels : public JetPictureTest {
 protected:
  void SetUp() override {
    panels.image = flat_image(9, 90, 40, 5);
    panels.facts = {{"Sonar", "test"}, {"Range", "1 to 21 m"}};
  }
  ReadPicture show() {
    show_panels(panels, options, path);
    return read_png(path);
  }
  std::string refusal() {
    return error_of([&] { show_panels(panels, options, path); });
  }

  Panels panels;
};

}  // namespace

// Port near and starboard far appear in the fan, the upper left panel, and in the rectangle, the lower left one.
TEST_F(ShowPanels, show_the_fan_and_the_rectangle_each_in_its_place) {
  panels.image.level_db(7, 8) = 40;   // azimuth +30 degrees: port
  panels.image.level_db(1, 34) = 60;  // starboard
  const ReadPicture picture = show();
  const ColourScale scale = colour_scale(panels.image.level_db, options, "test");
  const auto find = [&](double db, double bottom, double top) {
    return find_colour(picture, scale.colour(db), 0, 0.48 * picture.width, bottom * picture.height,
                       top * picture.height);
  };
  for (const auto& [bottom, top] : {std::pair{0.5, 1.0}, {0.0, 0.42}}) {
    const Blob port = find(40, bottom, top), starboard = find(60, bottom, top);
    ASSERT_GT(port.pixels, 20) << bottom;
    ASSERT_GT(starboard.pixels, 50) << bottom;
    EXPECT_LT(port.x, starboard.x) << bottom;
    EXPECT_LT(port.y, starboard.y) << bottom;
  }
}

TEST_F(ShowPanels, are_refused_in_a_picture_too_small_for_four) {
  options.width = 480, options.height = 360;
  EXPECT_EQ(refusal(),
            "show_panels: options.width x height = 480 x 360 pixels, must be at least 640 x 480 for four panels");
  options.width = options.height = 800;
  panels.beam = 9;
  EXPECT_EQ(refusal(), "show_panels: beam = 9, must be below the number of beams, 9");
  panels.beam = 0;
  panels.azimuth = {0, 1};
  EXPECT_EQ(refusal(), "show_panels: 0 levels for 2 azimuths, must be as many");
  EXPECT_FALSE(file_exists(path));
}

// A step of 10 dB in the middle of the band, on a scale of 40 dB.
TEST_F(ShowPanels, and_a_spectrum_has_frequency_to_the_right_and_level_upwards) {
  SpectrumLine line{{}, {}, ""};
  for (int k = 0; k < 100; ++k) {
    line.frequency.push_back(700e3 + 1e3 * k);
    line.density.push_back(k < 50 ? 1e-12 : 1e-11);  // 0 and 10 dB re 1 µPa²/Hz
  }
  options = {};
  options.min_db = -20, options.max_db = 20;
  show_spectrum({line}, options, path);
  const ReadPicture picture = read_png(path);
  const double step = (line_height(picture, 0.65, 0.9) - line_height(picture, 0.2, 0.45)) / picture.height;
  EXPECT_NEAR(step, 0.25 * 0.86, 0.03);  // of a frame of some 86 % of the height
  for (const auto& bad : std::vector<std::vector<SpectrumLine>>{
           {}, {{{1}, {1}, ""}}, {{{1, 2}, {1}, ""}}, {{{2, 1}, {1, 1}, ""}}, {{{1, 2}, {1, -1}, ""}}})
    EXPECT_THROW(show_spectrum(bad, options, path), Error);
}
