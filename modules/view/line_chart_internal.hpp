#pragma once
#include <functional>
#include <string>
#include <vector>

#include "view/axes_internal.hpp"
#include "view/picture.hpp"

namespace insonify {

enum class LineStyle { line, dashed, points, marked };  // marked: a line with a mark at each of its points
enum class AxisScale { linear, logarithmic };

/// What else is drawn over the same axes.
struct ChartLine {
  std::vector<double> x, y;  ///< finite
  std::string name;          ///< in the legend
  LineStyle style = LineStyle::line;
  std::vector<std::string> labels{};  ///< small, beside the points; empty, or one per point
};

/// One line over two axes, or several.
struct LineChart {
  std::vector<double> x, y;  ///< finite; what lies outside the axes is not drawn
  double low_x = 0, high_x = 1, low_y = 0, high_y = 1;
  std::string title, x_title, y_title;
  /// Ticks across for about `most` of them at most; round_ticks of low_x and high_x if not given.
  std::function<AxisTicks(double most)> x_ticks;
  std::string name;                   ///< of the line in the legend; no legend if no line has a name
  LineStyle style = LineStyle::line;  ///< of the line
  std::vector<ChartLine> more;        ///< drawn before it, so that it lies on top
  std::vector<std::string> labels{};  ///< of the line's points, as in ChartLine
  /// Logarithmic: values and ends of the axis are > 0, ticks at powers of ten, or at 1, 2, 5 within two of them.
  AxisScale x_scale = AxisScale::linear, y_scale = AxisScale::linear;
};

/// Draws frame, grid, labels, titles and lines, and a legend in one row above the frame, or in more if the names ask for
/// it. Labels of points that would cover each other are left out. Of the options, only size and dark count. The caller
/// has checked their size. Errors of files as show_fan's.
void draw_line_chart(const LineChart& chart, const PictureOptions& options, const char* who,
                     const std::string& png_path);

}  // namespace insonify
