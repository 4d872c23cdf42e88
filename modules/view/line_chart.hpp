#pragma once
#include <functional>
#include <string>
#include <vector>

#include "view/axes.hpp"
#include "view/picture.hpp"

namespace insonify {

enum class LineStyle { line, dashed, points };

/// What else is drawn over the same axes.
struct ChartLine {
  std::vector<double> x, y;  ///< finite
  std::string name;          ///< in the legend
  LineStyle style = LineStyle::line;
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
};

/// Draws frame, grid, labels, titles and lines, and a legend in one row above the frame. Of the options, only size and dark count. The caller has checked
/// their size. Errors of files as show_fan's.
void draw_line_chart(const LineChart& chart, const PictureOptions& options, const char* who,
                     const std::string& png_path);

}  // namespace insonify
