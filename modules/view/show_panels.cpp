// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "view/drawing_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

constexpr int min_width = 640, min_height = 480;
constexpr double left_share = 0.56, lower_share = 0.42;  // fractions of the picture
constexpr double smaller_font = 0.85;                    // relative to a picture of a single drawing

// Returns the options of a drawing that fills a box.
PictureOptions options_for(const Box& box, const PictureOptions& options, int font_size) {
  PictureOptions smaller = options;
  smaller.width = static_cast<int>(box.width());
  smaller.height = static_cast<int>(box.height());
  smaller.font_size = font_size;
  smaller.title.clear();
  return smaller;
}

// Draws names in one column, values in the next, from the top; the rows share the available height.
void draw_facts(Canvas& canvas, const std::vector<Fact>& facts, const PictureOptions& options) {
  const int font = options.font_size;
  const double row =
      std::min(1.9 * font, (options.height - 2.0 * font) / static_cast<double>(std::max<std::size_t>(1, facts.size())));
  const int size = std::min(font, static_cast<int>(row / 1.25));
  double names = 0;
  for (const Fact& fact : facts) names = std::max(names, text_size(fact.name, size).width);
  const double left = 1.5 * font, middle = left + names + 1.5 * font;
  const double used = row * static_cast<double>(facts.size());
  double height = (options.height + used) / 2 - row / 2;
  for (const Fact& fact : facts) {
    canvas.add_text_from({left, height}, fact.name, size, names);
    canvas.add_text_from({middle, height}, fact.value, size, options.width - font - middle);
    height -= row;
  }
}

}  // namespace

void draw_panels(Canvas& canvas, const Panels& panels, const PictureOptions& options) {
  const auto title = put_title(options);
  const int font = std::max(9, static_cast<int>(std::lround(smaller_font * font_size_for(options))));
  const double top = std::floor(title ? title->box().bottom - 0.3 * font : options.height);
  const double across = std::round(left_share * options.width), up = std::round(lower_share * top);
  const double right = options.width;
  if (title) canvas.add_text(*title);

  const auto draw_in = [&](const Box& box, auto&& draw) {
    canvas.set_origin({box.left, box.bottom});
    draw(options_for(box, options, font));
  };
  draw_in({0, across, up, top}, [&](const PictureOptions& part) { draw_fan(canvas, panels.image, part); });
  draw_in({across, right, up, top},
          [&](const PictureOptions& part) { draw_ascan(canvas, panels.image, panels.beam, part); });
  draw_in({0, across, 0, up}, [&](PictureOptions part) {
    part.marks.clear();
    part.title = panels.pattern_title;
    if (panels.azimuth.empty()) return draw_rect(canvas, panels.image, part);
    part.min_db = part.max_db = std::numeric_limits<double>::quiet_NaN();
    draw_pattern(canvas, panels.azimuth, panels.pattern_db, part);
  });
  draw_in({across, right, 0, up}, [&](const PictureOptions& part) { draw_facts(canvas, panels.facts, part); });
  canvas.set_origin({});
}

void show_panels(const Panels& panels, const PictureOptions& options, const std::string& png_path) {
  require_drawable(panels.image, options, "show_panels");
  if (options.width < min_width || options.height < min_height)
    fail(ErrorKind::argument, "show_panels", ": options.width x height = ", options.width, " x ", options.height,
         " pixels, must be at least ", min_width, " x ", min_height, " for four panels");
  if (panels.beam >= panels.image.fan.beams())
    fail(ErrorKind::argument, "show_panels", ": beam = ", panels.beam, ", must be below the number of beams, ",
         panels.image.fan.beams());
  if (!panels.azimuth.empty()) require_pattern(panels.azimuth, panels.pattern_db, "show_panels");
  save_picture(options, "show_panels", png_path, [&](Canvas& canvas) { draw_panels(canvas, panels, options); });
}

}  // namespace insonify
