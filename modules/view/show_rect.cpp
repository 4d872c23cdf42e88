#include "view/show_rect.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "view/axes.hpp"
#include "view/canvas_internal.hpp"
#include "view/fan_layout.hpp"
#include "view/text.hpp"
#include "view/ticks.hpp"
#include "view/vtk_messages_internal.hpp"

namespace insonify {
namespace {

// Bearings in radians with their labels in degrees.
AxisTicks bearing_axis(const BeamCells& cells, double width, int font) {
  const double most = std::clamp(width / (1.8 * text_size("+180°", font).width), 1.0, 12.0);
  const BearingTicks bearings = bearing_ticks(degrees(cells.low()), degrees(cells.high()), most);
  AxisTicks ticks;
  for (const double bearing_deg : bearings.at_deg) {
    ticks.at.push_back(radians(bearing_deg));
    ticks.labels.push_back(bearing_text(bearing_deg, bearings.step));
  }
  return ticks;
}

}  // namespace

void show_rect(const LevelImage& image, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_rect";
  require_drawable(image, options, who);
  const ColourScale scale = colour_scale(image.level_db, options, who);
  const BeamCells cells = order_beams(image);
  const double min_range = image.gate.min_range;
  const double max_range = min_range + static_cast<double>(image.level_db.cols()) * image.gate.bin_size;

  // The frame is what title, labels and colour bar leave.
  const VtkMessages messages;
  const int font = font_size_for(options.width, options.height);
  const double thin = line_width_for(font);
  const auto title = place_title(options);
  const double bottom = 0.8 * font + room_below(font);
  const double top = (title ? title->box().bottom : options.height) - font;
  const ColourBar bar =
      upright_colour_bar(scale, unit_text(image.unit, cells), font, options.width - 0.8 * font, bottom, top);
  const AxisTicks ranges = round_ticks(min_range, max_range, std::min(10.0, (top - bottom) / (2.5 * font)));
  Axes axes{{0.8 * font + room_left(ranges, font), bar.bar.left - 1.2 * font, bottom, top},
            cells.low(),
            cells.high(),
            min_range,
            max_range,
            {},
            {},
            {}};
  add_axis_across(axes, bearing_axis(cells, axes.frame.width(), font), "Bearing, positive to starboard", font);
  add_axis_upwards(axes, ranges, "Range [m]", font);

  Canvas canvas(options, who);
  canvas.add_cells(
      rect_patch(cells, image.gate, axes.frame.width(), axes.frame.height()), cells.edges, scale,
      [&](double bearing, double range) { return axes.at(bearing, range); }, 10);
  canvas.add_lines(axes.grid, thin, grid_colour, grid_opacity);
  axes.ticks.push_back(axes.outline());
  canvas.add_lines(axes.ticks, thin, canvas.colours().line, 1);
  for (const PlacedText& text : axes.texts) canvas.add_text(text);
  if (title) canvas.add_text(*title);
  canvas.add_colour_bar(bar, scale, thin);
  canvas.save_png(png_path, messages);
}

}  // namespace insonify
