// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

// Returns the limits of the level axis. The automatic upper limit is above the highest level of the beam.
ColourScale level_limits(const Grid<float>& level_db, PictureOptions options, const char* who) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const float level : level_db.reshaped())
    if (std::isfinite(level)) highest = std::max(highest, static_cast<double>(level));
  if (std::isnan(options.max_db) && std::isfinite(highest)) {
    options.max_db = next_five(highest);
    if (options.max_db <= options.min_db) options.max_db = options.min_db + 5.0;
  }
  return colour_scale(level_db, options, who);
}

// Returns the title with beam and bearing first, because long titles are truncated at the end.
std::string chart_title(const LevelImage& image, std::size_t beam, const std::string& title) {
  std::string text = "Beam ";
  text += std::to_string(beam);
  text += ", bearing ";
  text += bearing_text(-degrees(image.fan.azimuth[beam]), 0.1);
  if (!title.empty()) text.append(": ").append(title);
  return text;
}

}  // namespace

Axes draw_ascan(Canvas& canvas, const LevelImage& image, std::size_t beam, const PictureOptions& options) {
  const Grid<float> level_db = image.level_db.row(static_cast<Eigen::Index>(beam));
  const ColourScale limits = level_limits(level_db, options, canvas.who());

  LineChart chart;
  chart.low_x = image.gate.min_range;
  chart.high_x = image.gate.min_range + static_cast<double>(level_db.cols()) * image.gate.bin_size;
  chart.low_y = limits.min_db;
  chart.high_y = limits.max_db;
  chart.title = chart_title(image, beam, options.title);
  chart.x_title = "Range [m]";
  chart.y_title = image.unit.empty() ? "Level [dB]" : "Level, " + image.unit;
  for (Eigen::Index bin = 0; bin < level_db.cols(); ++bin) {
    const double db = level_db(0, bin);
    chart.lines[0].x.push_back(image.gate.centre(static_cast<std::size_t>(bin)));
    chart.lines[0].y.push_back(std::isfinite(db) ? db : limits.min_db - options.window_db);
  }
  return draw_line_chart(canvas, chart, options);
}

void show_ascan(const LevelImage& image, std::size_t beam, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_ascan";
  require_drawable(image, options, who);
  if (beam >= image.fan.beams())
    fail(ErrorKind::argument, who, ": beam = ", beam, ", must be below the number of beams, ", image.fan.beams());
  save_picture(options, who, png_path, [&](Canvas& canvas) { draw_ascan(canvas, image, beam, options); });
}

}  // namespace insonify
