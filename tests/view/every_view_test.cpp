// SPDX-License-Identifier: BSD-3-Clause
// Tests properties of every view: room for all texts at all sizes, both themes, Greek letters.
#include "support/test.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

// Returns levels over the whole window, for a typical sonar.
LevelImage busy_image() {
  LevelImage image = flat_image(64, 120, 78, 0);
  image.unit = "dB re 1 µPa at 1 m, range compensated";
  for (Eigen::Index i = 0; i < image.level_db.size(); ++i)
    image.level_db.data()[i] = static_cast<float>(70 + (i * 7919) % 45);
  return image;
}

PingHistory busy_history() {
  const LevelImage image = busy_image();
  PingHistory history{{}, {}, image.gate, image.level_db, image.unit};
  for (int ping = 0; ping < 64; ++ping) {
    history.number.push_back(12300 + ping);
    history.time.push_back(0.1 * ping);
  }
  return history;
}

std::pair<std::vector<double>, std::vector<double>> pattern() {
  std::vector<double> azimuth, level_db;
  for (int i = -180; i <= 180; ++i) {
    azimuth.push_back(radians(i / 2.0));
    level_db.push_back(-std::abs(i) / 4.0);
  }
  return {azimuth, level_db};
}

Panels busy_panels() {
  Panels panels;
  panels.image = busy_image();
  panels.beam = 20;
  std::tie(panels.azimuth, panels.pattern_db) = pattern();
  panels.pattern_title = "Pattern of beam 20 at +3.2°, 128 elements";
  for (int i = 0; i < 14; ++i)
    panels.facts.push_back({"Source level", "220 dB re 1 µPa at 1 m, and what else there is to be said"});
  return panels;
}

std::vector<SpectrumLine> spectra() {
  SpectrumLine line{{}, {}, "mean of all beams"};
  for (int k = -32; k < 32; ++k) {
    line.frequency.push_back(750e3 + 6e3 * k);
    line.density.push_back(1e-3 * std::exp(-k * k / 200.0));
  }
  SpectrumLine other = line;
  other.name = "pulse, Gaussian of 187.5 kHz";
  return {line, other};
}

std::vector<Mark> marks() {
  std::vector<Mark> marks;
  for (int i = 0; i < 12; ++i) marks.push_back({radians(-50 + 9.0 * i), 5.0 + 2.4 * i, "12.40 m, +5.2°, 93.1 dB"});
  return marks;
}

using Draw = std::function<void(Canvas&, const PictureOptions&)>;
const std::map<std::string, Draw>& views() {
  static const std::map<std::string, Draw> all = {
      {"fan", [](Canvas& canvas, const PictureOptions& o) { draw_fan(canvas, busy_image(), o); }},
      {"rect", [](Canvas& canvas, const PictureOptions& o) { draw_rect(canvas, busy_image(), o); }},
      {"waterfall", [](Canvas& canvas, const PictureOptions& o) { draw_waterfall(canvas, busy_history(), o); }},
      {"ascan", [](Canvas& canvas, const PictureOptions& o) { draw_ascan(canvas, busy_image(), 5, o); }},
      {"pattern",
       [](Canvas& canvas, const PictureOptions& o) { draw_pattern(canvas, pattern().first, pattern().second, o); }},
      {"spectrum", [](Canvas& canvas, const PictureOptions& o) { draw_spectrum(canvas, spectra(), o); }},
      {"panels", [](Canvas& canvas, const PictureOptions& o) { draw_panels(canvas, busy_panels(), o); }},
      {"panels without a pattern", [](Canvas& canvas, const PictureOptions& o) {
         Panels panels = busy_panels();
         panels.azimuth.clear();
         panels.pattern_db.clear();
         draw_panels(canvas, panels, o);
       }}};
  return all;
}

// Expects texts that neither leave the picture nor overlap.
void expect_readable(const std::vector<PlacedText>& texts, const PictureOptions& options) {
  const Box picture{0, static_cast<double>(options.width), 0, static_cast<double>(options.height)};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(picture.contains(texts[i].box())) << '"' << texts[i].text << "\" leaves the picture";
    EXPECT_GE(texts[i].font_size, 6) << texts[i].text;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(texts[i].box().overlaps(texts[j].box())) << texts[i].text << " lies on " << texts[j].text;
  }
}

class EveryView : public testing::Test {
 protected:
  void SetUp() override { unsetenv("DISPLAY"); }

  std::string path = own_path("view.png");
};

}  // namespace

TEST_F(EveryView, has_no_text_outside_the_picture_or_on_another_at_any_size) {
  const std::pair<int, int> sizes[] = {{480, 360},   {640, 480},   {500, 1000}, {1000, 500},
                                       {1400, 1050}, {2800, 2100}, {4096, 3072}};
  for (const auto& [name, draw] : views())
    for (const auto& [width, height] : sizes) {
      if (name.starts_with("panels") && (width < 640 || height < 480)) continue;
      SCOPED_TRACE(testing::Message() << name << " in " << width << " x " << height);
      PictureOptions options;
      options.width = width, options.height = height;
      options.title = "Harbour λ/2, oculus-m750d, ping 12300, 1 to 40 m";
      options.marks = marks();
      const VtkMessages messages;
      Canvas canvas(options, "test");
      draw(canvas, options);
      EXPECT_GT(canvas.texts().size(), 8U);
      expect_readable(canvas.texts(), options);
    }
}

TEST_F(EveryView, has_a_light_and_a_dark_theme_and_the_same_bytes_every_time) {
  for (const auto& [name, draw] : views())
    for (const bool dark : {false, true}) {
      SCOPED_TRACE(name);
      PictureOptions options;
      options.width = 640, options.height = 480;
      options.dark = dark;
      const auto bytes = [&, draw = draw] {
        const VtkMessages messages;
        Canvas canvas(options, "test");
        draw(canvas, options);
        write_png(path, canvas.png(messages));
        return file_bytes(path);
      };
      const std::string first = bytes();
      EXPECT_GT(first.size(), 10000U);
      EXPECT_TRUE(bytes() == first);
      const ReadPicture picture = read_png(path);
      double ground = 0;
      for (const auto& [x, y] : {std::pair{1, 1}, {638, 1}, {1, 478}, {638, 478}}) ground += picture.at(x, y)[1] / 4.0;
      EXPECT_TRUE(dark ? ground < 40 : ground > 250) << ground;
    }
}

// A font without Greek would draw the same empty box, or nothing, for all these letters.
TEST_F(EveryView, shows_greek) {
  const auto bytes = [&](const std::string& title) {
    PictureOptions options;
    options.width = 480, options.height = 360;
    options.title = title;
    show_rect(flat_image(4, 40, 8, 60), options, path);
    return file_bytes(path);
  };
  const std::string lambda = bytes("λ λ λ"), micro = bytes("µ µ µ"), question = bytes("? ? ?"),
                    unknown = bytes("\uE000 \uE000 \uE000");
  EXPECT_NE(lambda, question);
  EXPECT_NE(micro, question);
  EXPECT_NE(lambda, micro);
  EXPECT_NE(lambda, unknown) << "drawn as a letter that no font has";
}

TEST_F(EveryView, says_in_its_colour_bar_or_axis_what_the_levels_refer_to) {
  const std::map<std::string, std::string> units = {
      {"fan", "dB re 1 µPa at 1 m"},   {"rect", "dB re 1 µPa at 1 m"},       {"waterfall", "dB re 1 µPa at 1 m"},
      {"ascan", "dB re 1 µPa at 1 m"}, {"pattern", "dB re the beam's peak"}, {"spectrum", "dB re 1 µPa²/Hz"},
      {"panels", "dB re 1 µPa at 1 m"}};
  for (const auto& [name, unit] : units) {
    PictureOptions options;
    const VtkMessages messages;
    Canvas canvas(options, "test");
    views().at(name)(canvas, options);
    const auto says = [&, wanted = unit](const PlacedText& text) {
      return text.text.find(wanted) != std::string::npos;
    };
    EXPECT_TRUE(std::any_of(canvas.texts().begin(), canvas.texts().end(), says)) << name;
  }
}
