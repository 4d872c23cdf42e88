// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {

void require_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db, const char* who) {
  if (azimuth.size() < 2) fail(ErrorKind::argument, who, ": ", azimuth.size(), " points, must be at least 2");
  if (level_db.size() != azimuth.size())
    fail(ErrorKind::argument, who, ": ", level_db.size(), " levels for ", azimuth.size(), " azimuths, must be as many");
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    if (!std::isfinite(azimuth[i]))
      fail(ErrorKind::argument, who, ": azimuth[", i, "] = ", azimuth[i], ", must be finite");
    if (std::isnan(level_db[i])) fail(ErrorKind::argument, who, ": level_db[", i, "] is NaN, must be a level");
  }
}

void draw_pattern(Canvas& canvas, const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options) {
  LineChart chart;
  chart.low_y = -60, chart.high_y = 0;
  limit_levels(chart, options, canvas.who());

  ChartLine& line = chart.lines[0];
  // Azimuths in head axes are positive to port, bearings in pictures to starboard.
  for (const double a : azimuth) line.x.push_back(-degrees(a));
  const double floor_db = chart.low_y - (chart.high_y - chart.low_y);
  for (const double level : level_db) line.y.push_back(std::max(level, floor_db));
  const auto [low, high] = std::minmax_element(line.x.begin(), line.x.end());
  chart.low_x = *low;
  chart.high_x = *high;
  chart.title = options.title;
  chart.x_title = "Bearing [°], positive to starboard";
  chart.y_title = "Level [dB re the beam's peak]";
  chart.x_ticks = [&chart](double most) { return bearing_labels(chart.low_x, chart.high_x, most); };
  draw_line_chart(canvas, chart, options);
}

void show_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_pattern";
  require_pattern(azimuth, level_db, who);
  require_picture_size(options, who);
  save_picture(options, who, png_path, [&](Canvas& canvas) { draw_pattern(canvas, azimuth, level_db, options); });
}

}  // namespace insonify
