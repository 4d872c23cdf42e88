// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "view/axes_internal.hpp"
#include "view/picture.hpp"

namespace insonify {

enum class LineStyle { line, dashed, points, marked };  // marked: a line with a mark at each of its points
enum class AxisScale { linear, logarithmic };

/// A line of a chart.
struct ChartLine {
  std::vector<double> x, y;  ///< finite; clipped to the axes
  std::string name;          ///< name in the legend; no legend if no line has a name
  LineStyle style = LineStyle::line;
  std::vector<std::string> labels{};  ///< small labels beside the points; empty, or one per point
};

/// One or more lines over two axes.
struct LineChart {
  std::vector<ChartLine> lines = std::vector<ChartLine>(1);  ///< the first is drawn on top
  double low_x = 0, high_x = 1, low_y = 0, high_y = 1;
  std::string title, x_title, y_title;
  /// Gives at most about `most` ticks of the x axis; round_ticks of low_x and high_x if not set.
  std::function<AxisTicks(double most)> x_ticks;
  /// Scale of an axis. Logarithmic: values and ends of the axis are > 0, ticks as decade_ticks.
  AxisScale x_scale = AxisScale::linear, y_scale = AxisScale::linear;
};

/// Draws frame, grid, labels, titles and lines, and a legend above the frame in as many rows as the names need. Labels
/// of points that would cover each other are omitted. Only size and dark of the options are used; the caller has
/// checked the size. File errors as show_fan.
void draw_line_chart(const LineChart& chart, const PictureOptions& options, const char* who,
                     const std::string& png_path);

}  // namespace insonify
