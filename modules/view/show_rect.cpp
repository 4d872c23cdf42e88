// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/units.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

// Returns bearings in radians with their labels in degrees.
AxisTicks bearing_axis(const BeamCells& cells, double width, int font) {
  const double most = std::clamp(width / (1.8 * text_size("+180°", font).width), 1.0, 12.0);
  AxisTicks ticks = bearing_labels(degrees(cells.low()), degrees(cells.high()), most);
  for (double& at : ticks.at) at = radians(at);
  return ticks;
}

}  // namespace

void draw_rect(Canvas& canvas, const LevelImage& image, const PictureOptions& options) {
  const ColourScale scale = colour_scale(image.level_db, options, canvas.who());
  const BeamCells cells = order_beams(image);
  const double min_range = image.gate.min_range;
  const double max_range = min_range + static_cast<double>(image.level_db.cols()) * image.gate.bin_size;

  const int font = font_size_for(options);
  const CellAxis across{cells.low(), cells.high(), "Bearing, positive to starboard",
                        [&](double pixels) { return bearing_axis(cells, pixels, font); }};
  const CellAxis up{min_range, max_range, "Range [m]", [&](double pixels) {
                      return round_ticks(min_range, max_range, std::min(10.0, pixels / (2.5 * font)));
                    }};
  const CellFrame frame = lay_out_cell_frame(across, up, scale, unit_text(image.unit, cells), options);

  const Axes& axes = frame.axes;
  const PlaneProjection at = [&](double bearing, double range) { return axes.at(bearing, range); };
  canvas.add_cells(rect_patch(cells, image.gate, axes.frame.width(), axes.frame.height()), cells.edges, scale, at, 10);
  draw_cell_frame(canvas, frame, scale);
  draw_marks(canvas, marks_within(options.marks, cells.low(), cells.high(), image.gate), {axes.frame, {}, font, at});
}

void show_rect(const LevelImage& image, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_rect";
  require_drawable(image, options, who);
  save_picture(options, who, png_path, [&](Canvas& canvas) { draw_rect(canvas, image, options); });
}

}  // namespace insonify
