// SPDX-License-Identifier: BSD-3-Clause
#include <vtkLookupTable.h>
#include <vtkNew.h>

#include "support/test.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/test_pictures.hpp"

namespace {

PictureOptions with_map(const std::string& name) {
  PictureOptions options;
  options.colour_map = name;
  return options;
}

std::string message_of(const PictureOptions& options) {
  return error_of([&] { colour_scale(Grid<float>::Zero(2, 2), options, "show_fan"); });
}

}  // namespace

TEST(ColourMaps, every_listed_name_has_a_table) {
  EXPECT_THAT(colour_map_names(), testing::UnorderedElementsAre("viridis", "bronze", "copper", "amber", "grey", "jet"));
  for (const std::string& name : colour_map_names()) EXPECT_NO_THROW(colour_table(name, "test")) << name;
}

// Five colours of viridis at 0, 1/4, 1/2, 3/4 and 1, as ggplot2 and matplotlib print them (viridis(5)).
TEST(ColourMaps, viridis_passes_through_its_published_colours) {
  const ColourTable table = colour_table("viridis", "test");
  EXPECT_LE(colour_difference(table[0], {0x44, 0x01, 0x54}), 2);
  EXPECT_LE(colour_difference(table[64], {0x3B, 0x52, 0x8B}), 2);
  EXPECT_LE(colour_difference(table[128], {0x21, 0x91, 0x8C}), 2);
  EXPECT_LE(colour_difference(table[191], {0x5E, 0xC9, 0x62}), 2);
  EXPECT_LE(colour_difference(table[255], {0xFD, 0xE7, 0x25}), 2);
}

// copper(n) of MATLAB: min(1, 1.25 t), 0.7812 t, 0.4975 t.
TEST(ColourMaps, copper_follows_its_formula) {
  const ColourTable table = colour_table("copper", "test");
  for (std::size_t i = 0; i < 256; ++i) {
    const double t = static_cast<double>(i) / 255.0;
    EXPECT_NEAR(table[i][0], 255 * std::min(1.0, 1.25 * t), 2) << i;
    EXPECT_NEAR(table[i][1], 255 * 0.7812 * t, 2) << i;
    EXPECT_NEAR(table[i][2], 255 * 0.4975 * t, 2) << i;
  }
}

TEST(ColourMaps, all_but_jet_grow_brighter_with_the_level) {
  for (const char* name : {"viridis", "bronze", "copper", "amber", "grey"}) {
    const ColourTable table = colour_table(name, "test");
    const auto luma = [&](std::size_t i) { return 0.2126 * table[i][0] + 0.7152 * table[i][1] + 0.0722 * table[i][2]; };
    for (std::size_t i = 1; i < 256; ++i)
      EXPECT_GE(luma(i) + 0.8, luma(i - 1)) << name << " " << i;  // rounding to bytes
    EXPECT_GT(luma(255) - luma(0), 120) << name;
  }
}

// Returns CIELAB of sRGB, IEC 61966-2-1 and ISO 11664-4, white D65.
Eigen::Vector3d lab_of(const Rgb& colour) {
  const auto linear = [](std::uint8_t value) {
    const double u = value / 255.0;
    return u <= 0.04045 ? u / 12.92 : std::pow((u + 0.055) / 1.055, 2.4);
  };
  const double r = linear(colour[0]), g = linear(colour[1]), b = linear(colour[2]);
  const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = root(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Returns the length of the path through CIELAB over the middle half of the levels. Its steps are large against the
// rounding of a byte.
double contrast_of_mid_tones(const std::string& name) {
  const ColourTable table = colour_table(name, "test");
  double way = 0;
  for (std::size_t i = 76; i < 204; i += 8) way += (lab_of(table[i + 8]) - lab_of(table[i])).norm();
  return way;
}

TEST(ColourMaps, the_default_has_twice_the_contrast_of_copper_in_the_mid_tones_and_more_than_viridis) {
  EXPECT_GT(contrast_of_mid_tones(default_colour_map), 2 * contrast_of_mid_tones("copper"));
  EXPECT_GT(contrast_of_mid_tones(default_colour_map), contrast_of_mid_tones("viridis"));
}

TEST(ColourMaps, bronze_begins_black_and_its_hue_rises_from_red_to_yellow) {
  const ColourTable table = colour_table("bronze", "test");
  EXPECT_EQ(table[0], (Rgb{0, 0, 0}));
  const auto hue = [&](std::size_t i) {
    const Eigen::Vector3d lab = lab_of(table[i]);
    return degrees(std::atan2(lab.z(), lab.y()));
  };
  for (std::size_t i = 80; i < 204; ++i) EXPECT_GT(hue(i + 1), hue(i) - 0.5) << i;  // rounding to bytes
  EXPECT_LT(hue(80), 25);
  EXPECT_GT(hue(204), 90);
}

TEST(ColourMaps, an_unknown_name_is_an_error_that_lists_the_known_ones) {
  const std::string message = message_of(with_map("virdis"));
  EXPECT_THAT(message, HasSubstr("show_fan: options.colour_map = \"virdis\""));
  for (const std::string& name : colour_map_names()) EXPECT_THAT(message, HasSubstr(name));
}

TEST(ColourScale, maps_levels_as_vtkLookupTable_does) {
  const ColourScale scale{colour_table("jet", "test"), -31.0, 17.0};
  vtkNew<vtkLookupTable> referee;
  referee->SetNumberOfTableValues(256);
  referee->SetRange(scale.min_db, scale.max_db);
  for (double db = -40; db < 25; db += 0.0137)
    ASSERT_EQ(static_cast<vtkIdType>(scale.index(db)), referee->GetIndex(db)) << db;
}

TEST(ColourScale, levels_that_are_floor_or_not_numbers_take_the_first_colour) {
  const ColourScale scale{colour_table("copper", "test"), 60, 105};
  EXPECT_EQ(scale.index(-200), 0u);
  EXPECT_EQ(scale.index(-std::numeric_limits<double>::infinity()), 0u);
  EXPECT_EQ(scale.index(std::nan("")), 0u);
  EXPECT_EQ(scale.index(std::numeric_limits<double>::infinity()), 255u);
}

// 10 000 levels 0, 0.01 ... 99.99 dB: the 99.9 % quantile is 99.89, which rounds up to 100.
TEST(ColourScale, automatic_maximum_is_the_high_quantile_rounded_up_to_5_db) {
  Grid<float> level_db(100, 100);
  for (Eigen::Index i = 0; i < level_db.size(); ++i) level_db.data()[i] = 0.01F * static_cast<float>(i);
  ColourScale scale = colour_scale(level_db, {}, "test");
  EXPECT_EQ(scale.max_db, 100);
  EXPECT_EQ(scale.min_db, 55);

  // Five bright samples in ten thousand are outliers; a floor that fills most of the image is ignored.
  level_db.row(0).head(5) = 500;
  EXPECT_EQ(colour_scale(level_db, {}, "test").max_db, 100);
  level_db.bottomRows(95) = -200;
  level_db.topRows(5) = 83;
  EXPECT_EQ(colour_scale(level_db, {}, "test").max_db, 85);
}

TEST(ColourScale, an_image_of_floor_only_has_a_finite_scale) {
  const ColourScale scale = colour_scale(Grid<float>::Constant(4, 4, -200.0F), {}, "test");
  EXPECT_EQ(scale.min_db, -200);
  EXPECT_EQ(scale.max_db, -155);
  EXPECT_EQ(scale.index(-200), 0u);
}

TEST(ColourScale, a_window_or_limits_that_are_no_range_are_errors) {
  PictureOptions options;
  options.window_db = -3;
  EXPECT_THAT(message_of(options), HasSubstr("options.window_db = -3 dB, must be > 0"));
  options.window_db = 45;
  options.min_db = 20, options.max_db = 10;
  EXPECT_THAT(message_of(options), HasSubstr("options.max_db = 10 dB, must be finite and exceed min_db = 20 dB"));
}

TEST(ColourMaps, a_bar_of_heights_is_labelled_by_depths) {
  const ColourScale scale{colour_table("viridis", "test"), -12, 2};
  const ColourBar heights = upright_colour_bar(scale, "Depth below z = 0 [m]", 12, 200, 0, 300);
  ColourBar depths = heights;
  label_by_depths(depths);
  ASSERT_EQ(depths.texts.size(), heights.texts.size());
  std::size_t numbers = 0;
  for (std::size_t t = 0; t + 1 < heights.texts.size(); ++t, ++numbers) {
    EXPECT_EQ(std::stod(depths.texts[t].text), -std::stod(heights.texts[t].text));
    EXPECT_EQ(depths.texts[t].text == "-0", false);
    EXPECT_EQ(depths.texts[t].centre.y, heights.texts[t].centre.y);
  }
  EXPECT_GE(numbers, 3U);
  EXPECT_EQ(depths.texts.back().text, "Depth below z = 0 [m]");
}
