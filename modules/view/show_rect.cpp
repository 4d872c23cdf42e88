#include "view/show_rect.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "view/cell_frame_internal.hpp"
#include "view/draw_marks_internal.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/text.hpp"
#include "view/ticks_internal.hpp"

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
  const VtkMessages messages;
  Canvas canvas(options, who);
  draw_rect(canvas, image, options);
  canvas.save_png(png_path, messages);
}

}  // namespace insonify
