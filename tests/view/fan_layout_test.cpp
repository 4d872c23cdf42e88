// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/fan_layout_internal.hpp"

namespace {

// The layout of a fan picture with all its texts.
struct LaidOut {
  FanOutline fan;
  PictureOptions options;
  FanLayout layout;
  std::vector<PlacedText> texts;
};

LaidOut lay_out(double field_of_view_deg, int width, int height, FanOutline fan) {
  LaidOut laid{.fan = fan, .options = {}, .layout = {}, .texts = {}};
  laid.fan.low = -radians(field_of_view_deg) / 2;
  laid.fan.high = -laid.fan.low;
  laid.options.width = width, laid.options.height = height;
  laid.options.title = "Harbour, ping 12: a title of ordinary length";
  laid.layout =
      lay_out_fan(laid.fan, laid.options, {colour_table("copper", "test"), 62, 107}, "dB re 1 µPa, range compensated");
  laid.texts = laid.layout.texts;
  laid.texts.push_back(laid.layout.title.value());
  const auto& bar_texts = laid.layout.colour_bar.texts;
  laid.texts.insert(laid.texts.end(), bar_texts.begin(), bar_texts.end());
  return laid;
}

// Calls check(laid) for fans from a pencil beam to a full circle, in pictures of all shapes.
template <typename Check>
void for_all_fans(Check&& check) {
  const std::pair<int, int> sizes[] = {{600, 500}, {1400, 1050}, {500, 1000}, {1920, 1080}, {4000, 3000}};
  const FanOutline outlines[] = {{0, 0, 0.5, 9}, {0, 0, 10, 640}, {0, 0, 1, 30, true}};
  for (const double field_of_view_deg : {20.0, 45.0, 60.0, 90.0, 120.0, 130.0, 180.0, 210.0, 270.0, 330.0, 360.0})
    for (const auto& [width, height] : sizes)
      for (const FanOutline& outline : outlines) {
        SCOPED_TRACE(testing::Message() << field_of_view_deg << " degrees to " << outline.max_range << " m in " << width
                                        << " x " << height);
        check(lay_out(field_of_view_deg, width, height, outline));
      }
}

}  // namespace

TEST(FanLayout, has_no_text_outside_the_picture_or_on_another) {
  for_all_fans([](const LaidOut& laid) {
    const Box picture{0, static_cast<double>(laid.options.width), 0, static_cast<double>(laid.options.height)};
    const auto& texts = laid.texts;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_TRUE(picture.contains(texts[i].box())) << texts[i].text;
      EXPECT_FALSE(texts[i].box().overlaps(laid.layout.colour_bar.bar)) << texts[i].text;
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_FALSE(texts[i].box().overlaps(texts[j].box())) << texts[i].text << " on " << texts[j].text;
    }
  });
}

TEST(FanLayout, keeps_the_fan_inside_the_picture_and_clear_of_texts_and_colour_bar) {
  for_all_fans([](const LaidOut& laid) {
    const FanOutline& fan = laid.fan;
    std::vector<Box> boxes{laid.layout.colour_bar.outer()};
    for (const PlacedText& text : laid.texts)
      if (!text.on_plate) boxes.push_back(text.box());
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 20; ++j) {
        const Point2 p = laid.layout.at(fan.low + (fan.high - fan.low) * i / 200,
                                        fan.min_range + (fan.max_range - fan.min_range) * j / 20);
        ASSERT_TRUE(p.x >= 0 && p.x <= laid.options.width && p.y >= 0 && p.y <= laid.options.height);
        for (const Box& box : boxes) ASSERT_FALSE(box.contains({p.x, p.x, p.y, p.y})) << box.left << ", " << box.bottom;
      }
  });
}

TEST(FanLayout, fills_the_picture_in_one_direction) {
  for_all_fans([](const LaidOut& laid) {
    Box box{1e9, -1e9, 1e9, -1e9};
    for (int i = 0; i <= 720; ++i)
      for (const double range : {laid.fan.min_range, laid.fan.max_range}) {
        const Point2 p = laid.layout.at(laid.fan.low + (laid.fan.high - laid.fan.low) * i / 720, range);
        box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.bottom, p.y), std::max(box.top, p.y)};
      }
    EXPECT_TRUE(box.width() > 0.7 * laid.options.width || box.height() > 0.7 * laid.options.height)
        << box.width() << " x " << box.height();
  });
}

TEST(FanLayout, has_rings_and_spokes_with_labels) {
  for_all_fans([](const LaidOut& laid) {
    EXPECT_GE(laid.layout.rings.size(), 3u);
    EXPECT_LE(laid.layout.rings.size(), 9u);
    EXPECT_GE(laid.layout.spokes.size(), 3u);
    int metres = 0;
    for (const PlacedText& text : laid.layout.texts) metres += text.text.ends_with(" m");
    EXPECT_GE(metres, 2);
  });
}

TEST(FanLayout, of_a_trimmed_picture_is_as_large_and_leaves_nothing_free) {
  for_all_fans([](const LaidOut& laid) {
    const ColourScale scale{colour_table("copper", "test"), 62, 107};
    const std::string unit = "dB re 1 µPa, range compensated";
    const PictureOptions trimmed = trimmed_to_fan(laid.fan, laid.options, scale, unit);
    EXPECT_LE(trimmed.width, laid.options.width);
    EXPECT_LE(trimmed.height, laid.options.height);
    const FanLayout layout = lay_out_fan(laid.fan, trimmed, scale, unit);
    EXPECT_NEAR(layout.pixels_per_metre / laid.layout.pixels_per_metre, 1, 0.01);
    EXPECT_EQ(layout.font_size, laid.layout.font_size);

    // Title, fan with labels and bar lie close together, unless title or the least size keep them apart.
    Box all = layout.colour_bar.outer();
    const auto include = [&](const Box& box) {
      all = {std::min(all.left, box.left), std::max(all.right, box.right), std::min(all.bottom, box.bottom),
             std::max(all.top, box.top)};
    };
    for (const PlacedText& text : layout.texts) include(text.box());
    for (int i = 0; i <= 720; ++i)
      for (const double range : {laid.fan.min_range, laid.fan.max_range}) {
        const Point2 p = layout.at(laid.fan.low + (laid.fan.high - laid.fan.low) * i / 720, range);
        include({p.x, p.x, p.y, p.y});
      }
    const double border = 2.5 * layout.font_size;
    const bool least_width =
        trimmed.width <= layout.title->box().width() + border || trimmed.width < 0.46 * laid.options.width;
    EXPECT_TRUE(all.width() > trimmed.width - border || least_width) << all.width() << " of " << trimmed.width;
    EXPECT_TRUE(all.height() > layout.title->box().bottom - border || trimmed.height < 0.46 * laid.options.height)
        << all.height() << " of " << trimmed.height;
  });
}

TEST(FitText, shrinks_a_long_line_and_then_cuts_it_between_letters) {
  const std::string longer(400, 'x');
  const FittedText fitted = fit_text("µµ" + longer, 20, 300);
  EXPECT_LE(text_size(fitted.text, fitted.font_size).width, 300);
  EXPECT_EQ(fitted.font_size, 14);
  EXPECT_TRUE(fitted.text.starts_with("µµx") && fitted.text.ends_with("x...")) << fitted.text;
  const FittedText same = fit_text("Reef", 20, 300);
  EXPECT_EQ(same.text, "Reef");
  EXPECT_EQ(same.font_size, 20);
}

// VTK silently omits letters missing in the font, which makes the text narrower.
TEST(TextSize, greek_letters_take_room) {
  EXPECT_GT(text_size("dB re 1 \u00b5Pa", 40).width, text_size("dB re 1 Pa", 40).width + 10);
  EXPECT_GT(text_size("dB re 1 \u03bcPa", 40).width, text_size("dB re 1 Pa", 40).width + 10);
}
