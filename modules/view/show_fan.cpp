// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

// Returns points along the circle of radius `range`, from one edge of the fan to the other.
Path arc(const FanLayout& layout, double range, double step) {
  const int steps = std::max(1, static_cast<int>(std::ceil((layout.high - layout.low) / step)));
  Path path;
  for (int i = 0; i <= steps; ++i)
    path.push_back(layout.at(layout.low + (layout.high - layout.low) * i / steps, range));
  return path;
}

void draw_grid(Canvas& canvas, const FanLayout& layout, double step) {
  const double thin = line_width_for(layout.font_size);
  std::vector<Path> grid;
  for (const double ring : layout.rings) grid.push_back(arc(layout, ring, step));
  for (const double spoke : layout.spokes)
    grid.push_back({layout.at(spoke, layout.min_range), layout.at(spoke, layout.max_range)});
  canvas.add_lines(grid, thin, grid_colour, grid_opacity);

  // Draw the outline, and a tick at every bearing label.
  const Path outer = arc(layout, layout.max_range, step), inner = arc(layout, layout.min_range, step);
  std::vector<Path> lines{outer, inner};
  if (layout.high - layout.low < 6.28) {
    lines.push_back({inner.front(), outer.front()});
    lines.push_back({inner.back(), outer.back()});
  }
  const double tick = 0.35 * layout.font_size / layout.pixels_per_metre;
  for (const double spoke : layout.spokes)
    lines.push_back({layout.at(spoke, layout.max_range), layout.at(spoke, layout.max_range + tick)});
  canvas.add_lines(lines, thin, canvas.colours().line, 1);
}

// Returns the whole picture except its texts and the colour bar.
MarkRoom room_for_marks(const FanLayout& layout, const PictureOptions& options) {
  MarkRoom room;
  room.box = {0, static_cast<double>(options.width), 0, static_cast<double>(options.height)};
  room.taken.push_back(layout.colour_bar.outer());
  for (const PlacedText& text : layout.texts) room.taken.push_back(text.box());
  if (layout.title) room.taken.push_back(layout.title->box());
  room.font_size = layout.font_size;
  room.at = [layout](double bearing, double range) { return layout.at(bearing, range); };
  return room;
}

/// An image with its cells, ready to be laid out.
struct FanImage {
  const LevelImage& image;
  ColourScale scale;
  BeamCells cells;
  FanOutline outline;
  std::string unit;
};

FanImage fan_image(const LevelImage& image, const PictureOptions& options, const char* who) {
  FanImage fan{image, colour_scale(image.level_db, options, who), order_beams(image), {}, {}};
  const double max_range = image.gate.min_range + static_cast<double>(image.level_db.cols()) * image.gate.bin_size;
  fan.outline = {fan.cells.low(), fan.cells.high(), image.gate.min_range, max_range, image.downwards};
  fan.unit = unit_text(image.unit, fan.cells);
  return fan;
}

FanLayout draw_fan(Canvas& canvas, const FanImage& fan, const PictureOptions& options) {
  const auto& [image, scale, cells, outline, unit] = fan;
  // Lay out everything, then draw it.
  const FanLayout layout = lay_out_fan(outline, options, scale, unit);
  const double step = std::sqrt(0.8 / (outline.max_range * layout.pixels_per_metre));  // chord within 0.1 pixel
  for (const CellPatch& patch : fan_patches(cells, image.gate, layout.pixels_per_metre))
    canvas.add_cells(
        patch, cells.edges, scale, [&](double b, double r) { return layout.at(b, r); }, step);
  draw_grid(canvas, layout, step);
  for (const PlacedText& text : layout.texts) canvas.add_text(text);
  if (layout.title) canvas.add_text(*layout.title);
  canvas.add_colour_bar(layout.colour_bar, scale, line_width_for(layout.font_size));
  draw_marks(canvas, marks_within(options.marks, cells.low(), cells.high(), image.gate),
             room_for_marks(layout, options));
  return layout;
}

}  // namespace

FanLayout draw_fan(Canvas& canvas, const LevelImage& image, const PictureOptions& options) {
  return draw_fan(canvas, fan_image(image, options, canvas.who()), options);
}

void show_fan(const LevelImage& image, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_fan";
  require_drawable(image, options, who);
  const FanImage fan = fan_image(image, options, who);
  const PictureOptions fitted = options.trim ? trimmed_to_fan(fan.outline, options, fan.scale, fan.unit) : options;
  save_picture(fitted, who, png_path, [&](Canvas& canvas) { draw_fan(canvas, fan, fitted); });
}

}  // namespace insonify
