// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

void require_lines(const std::vector<SpectrumLine>& lines, const PictureOptions& options) {
  if (lines.empty()) fail(ErrorKind::argument, "show_spectrum", ": no lines, must be at least one");
  for (const SpectrumLine& line : lines) {
    const auto& f = line.frequency;
    if (f.size() < 2 || line.density.size() != f.size())
      fail(ErrorKind::argument, "show_spectrum", ": ", f.size(), " frequencies and ", line.density.size(),
           " densities, must be at least 2 and as many");
    if (!std::isfinite(f.front()) || !std::isfinite(f.back()) ||
        std::adjacent_find(f.begin(), f.end(), [](double a, double b) { return !(a < b); }) != f.end())
      fail(ErrorKind::argument, "show_spectrum", ": frequencies must be finite and ascend");
    for (const double density : line.density)
      require(density >= 0, "show_spectrum", "density", density, "Pa^2/Hz", ">= 0");
  }
  require_picture_size(options, "show_spectrum");
}

ChartLine in_decibels(const SpectrumLine& line) {
  ChartLine chart{{}, {}, line.name};
  for (const double f : line.frequency) chart.x.push_back(f / 1000);
  for (const double d : line.density) chart.y.push_back(db_from_power(d / (micropascal * micropascal)));
  return chart;
}

// Returns multiples of 5 dB around all levels, at most `window_db` apart.
std::pair<double, double> limits_of(const std::vector<ChartLine>& lines, double window_db) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const ChartLine& line : lines) {
    const auto [low, high] = std::minmax_element(line.y.begin(), line.y.end());
    lowest = std::min(lowest, *low);
    highest = std::max(highest, *high);
  }
  if (!std::isfinite(highest)) return {-window_db, 0};
  const double top = next_five(highest);
  return {std::max(top - window_db, 5 * std::ceil(lowest / 5) - 5), top};
}

}  // namespace

void draw_spectrum(Canvas& canvas, const std::vector<SpectrumLine>& lines, const PictureOptions& options) {
  std::vector<ChartLine> all;
  for (const SpectrumLine& line : lines) all.push_back(in_decibels(line));
  LineChart chart;
  chart.low_x = all.front().x.front();
  chart.high_x = all.front().x.back();
  std::tie(chart.low_y, chart.high_y) = limits_of(all, options.window_db);
  if (!std::isnan(options.max_db)) chart.low_y = options.max_db - options.window_db;
  limit_levels(chart, options, canvas.who());

  // Zero density is drawn below the chart.
  for (ChartLine& line : all)
    for (double& level : line.y) level = std::max(level, 2 * chart.low_y - chart.high_y);
  for (std::size_t i = 1; i < all.size(); ++i) all[i].style = LineStyle::dashed;
  chart.lines.assign(all.rbegin(), all.rend());  // the dashed lines lie on top
  chart.title = options.title;
  chart.x_title = "Frequency [kHz]";
  chart.y_title = "Power spectral density [dB re 1 µPa²/Hz]";
  draw_line_chart(canvas, chart, options);
}

void show_spectrum(const std::vector<SpectrumLine>& lines, const PictureOptions& options, const std::string& png_path) {
  require_lines(lines, options);
  save_picture(options, "show_spectrum", png_path, [&](Canvas& canvas) { draw_spectrum(canvas, lines, options); });
}

}  // namespace insonify
