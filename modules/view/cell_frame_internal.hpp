#pragma once
#include <functional>
#include <optional>
#include <string>

#include "view/axes_internal.hpp"
#include "view/canvas_internal.hpp"
#include "view/colour_bar_internal.hpp"

namespace insonify {

/// One side of a rectangle of cells.
struct CellAxis {
  double low = 0, high = 1;
  std::string title;
  std::function<AxisTicks(double pixels)> ticks;  ///< ticks for an axis of this length
};

/// Layout of a rectangle of cells: axes at the left and below, colour bar at the right, title on top.
struct CellFrame {
  Axes axes;
  ColourBar bar;
  std::optional<PlacedText> title;
  int font_size = 0;
};
CellFrame lay_out_cell_frame(const CellAxis& across, const CellAxis& up, const ColourScale& scale,
                             const std::string& unit, const PictureOptions& options);

/// Draws grid lines over the cells, and axes, colour bar and title around them.
void draw_cell_frame(Canvas& canvas, const CellFrame& frame, const ColourScale& scale);

}  // namespace insonify
