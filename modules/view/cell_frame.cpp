#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"

namespace insonify {

CellFrame lay_out_cell_frame(const CellAxis& across, const CellAxis& up, const ColourScale& scale,
                             const std::string& unit, const PictureOptions& options) {
  // The cells fill the space left by title, labels and colour bar.
  CellFrame frame;
  frame.font_size = font_size_for(options);
  frame.title = place_title(options);
  const double margin = 0.8 * frame.font_size, bottom = margin + room_below(frame.font_size);
  const double top = (frame.title ? frame.title->box().bottom : options.height) - frame.font_size;
  frame.bar = upright_colour_bar(scale, unit, frame.font_size, options.width - margin, bottom, top);
  const AxisTicks upwards = up.ticks(top - bottom);
  const Box cells{margin + room_left(upwards, frame.font_size), frame.bar.bar.left - 1.2 * frame.font_size, bottom,
                  top};
  frame.axes = {cells, across.low, across.high, up.low, up.high, {}, {}, {}};
  add_axis_across(frame.axes, across.ticks(cells.width()), across.title, frame.font_size);
  add_axis_upwards(frame.axes, upwards, up.title, frame.font_size);
  return frame;
}

void draw_cell_frame(Canvas& canvas, const CellFrame& frame, const ColourScale& scale) {
  const double thin = line_width_for(frame.font_size);
  canvas.add_lines(frame.axes.grid, thin, grid_colour, grid_opacity);
  std::vector<Path> lines = frame.axes.ticks;
  lines.push_back(frame.axes.outline());
  canvas.add_lines(lines, thin, canvas.colours().line, 1);
  for (const PlacedText& text : frame.axes.texts) canvas.add_text(text);
  if (frame.title) canvas.add_text(*frame.title);
  canvas.add_colour_bar(frame.bar, scale, thin);
}

}  // namespace insonify
