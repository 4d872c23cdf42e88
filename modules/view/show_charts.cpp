// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/error.hpp"
#include "core/require.hpp"
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
