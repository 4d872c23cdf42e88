// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/axes_internal.hpp"
#include "view/canvas_internal.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/line_chart_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {

/// Draw onto a canvas without writing a file. Each drawing fills options.width x options.height pixels from the
/// canvas's origin, so that several can share one picture. The caller has checked image and size, and keeps VtkMessages
/// alive. Throw Error(argument), in the name of canvas.who(), for contradictory level limits. Fans and charts return
/// their layout relative to the origin.
FanLayout draw_fan(Canvas& canvas, const LevelImage& image, const PictureOptions& options);
void draw_rect(Canvas& canvas, const LevelImage& image, const PictureOptions& options);
Axes draw_waterfall(Canvas& canvas, const PingHistory& history, const PictureOptions& options);
Axes draw_ascan(Canvas& canvas, const LevelImage& image, std::size_t beam, const PictureOptions& options);
void draw_pattern(Canvas& canvas, const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options);
void require_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db, const char* who);
Axes draw_line_chart(Canvas& canvas, const LineChart& chart, const PictureOptions& options);
/// Sets the ends of a chart's level axis that the options give, and leaves the others; errors as above.
void limit_levels(LineChart& chart, const PictureOptions& options, const char* who);
void draw_spectrum(Canvas& canvas, const std::vector<SpectrumLine>& lines, const PictureOptions& options);
void draw_panels(Canvas& canvas, const Panels& panels, const PictureOptions& options);

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

/// Space available for marks.
struct MarkRoom {
  Box box;                 ///< contains all names
  std::vector<Box> taken;  ///< not to be covered by names
  int font_size = 0;
  PlaneProjection at;
};

/// Returns the marks inside a sector, with whole turns added to their bearings so that they lie within [low, high].
std::vector<Mark> marks_within(const std::vector<Mark>& marks, double low, double high, const RangeGate& gate);

/// Draws a ring at each mark and its name at the nearest position where it covers no ring and no other text, with a
/// leader line if the two are apart. Names without a free position are omitted; earlier marks have priority.
void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, MarkRoom room);

}  // namespace insonify
