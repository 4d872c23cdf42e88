// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compare_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "view/grey_file.hpp"
#include "view/line_chart_internal.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {
namespace {

struct PagePicture {
  std::string file, shows;
};

void draw_levels(const std::string& path, const ComparedImage& image, const GreyWindow& window,
                 const std::string& title, const char* unit) {
  const Grid<float> level = image.level_db.isNaN().select(static_cast<float>(window.min_db), image.level_db);
  if (!image.fan || !image.gate)
    return save_grey_png(path, Grid<std::uint8_t>(quantise_8(level, window).transpose().colwise().reverse()));
  PictureOptions picture;
  picture.width = 900, picture.height = 900;
  picture.min_db = window.min_db, picture.max_db = window.max_db;
  picture.title = title;
  show_rect({*image.fan, *image.gate, level, unit}, picture, path);
}

void draw_chart(const std::string& path, LineChart chart) {
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
  for (const ChartLine& line : chart.lines) {
    for (const double x : line.x) low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    for (const double y : line.y) low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  chart.low_x = low_x, chart.high_x = high_x > low_x ? high_x : low_x + 1;
  chart.low_y = low_y, chart.high_y = high_y > low_y ? high_y : low_y + 1;
  PictureOptions picture;
  picture.width = 900, picture.height = 600;
  draw_line_chart(chart, picture, "compare", path);
}

/// Shares of levels in steps of 1 dB.
ChartLine histogram_line(const Grid<float>& level_db, const GreyWindow& window, const std::string& name,
                         LineStyle style) {
  const auto bins = static_cast<std::size_t>(std::ceil(window.max_db - window.min_db)) + 20;
  std::vector<double> count(bins, 0.0);
  double all = 0;
  for (const float level : level_db.reshaped<Eigen::RowMajor>()) {
    const double at = static_cast<double>(level) - window.min_db + 10;
    if (!(at >= 0 && at < static_cast<double>(bins))) continue;
    ++count[static_cast<std::size_t>(at)], ++all;
  }
  ChartLine line{{}, {}, name, style};
  for (std::size_t k = 0; k < bins; ++k) {
    line.x.push_back(window.min_db - 9.5 + static_cast<double>(k));
    line.y.push_back(100 * count[k] / std::max(1.0, all));
  }
  return line;
}

ChartLine lag_line(const std::vector<double>& covariance, const std::string& name, LineStyle style) {
  ChartLine line{{}, covariance, name, style};
  for (std::size_t k = 0; k < covariance.size(); ++k) line.x.push_back(static_cast<double>(k));
  const std::size_t most = std::min<std::size_t>(line.x.size(), 25);
  line.x.resize(most), line.y.resize(most);
  return line;
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) html += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return html;
}

void write_page(const RunDirectory& directory, const CompareOptions& o, const std::vector<PagePicture>& pictures,
                const std::string& table) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>insonify compare</title>\n"
      "<style>body{{font-family:sans-serif;margin:2em}}img{{max-width:46em;display:block}}</style></head><body>\n"
      "<h1>{} against {}</h1>\n<pre>{}</pre>\n",
      escaped(o.a), escaped(o.b), escaped(table));
  for (const PagePicture& picture : pictures)
    html += fmt::format("<h2>{}</h2>\n<img src=\"{}\" alt=\"{}\">\n", escaped(picture.shows), picture.file,
                        escaped(picture.shows));
  write_file(directory.file("index.html"), html + "</body></html>\n");
}

}  // namespace

void write_compare_page(const RunDirectory& directory, const CompareOptions& o, const ComparedFile& a,
                        const ComparedFile& b, const ImageComparison& c, const std::string& table) {
  const ComparedImage moved{a.image.level_db - static_cast<float>(c.bias_db), a.image.fan, a.image.gate};
  const ComparedImage difference{moved.level_db - b.image.level_db, b.image.fan, b.image.gate};
  draw_levels(directory.file("a.png"), moved, c.window, fmt::format("A less {:.2f} dB", c.bias_db), "dB");
  draw_levels(directory.file("b.png"), b.image, c.window, "B", "dB");
  draw_levels(directory.file("difference.png"), difference, {-20, 20}, "A - B after the gain", "dB");

  LineChart levels;
  levels.title = "Levels", levels.x_title = "Level [dB]", levels.y_title = "Share of pixels in 1 dB [%]";
  levels.lines = {histogram_line(moved.level_db, c.window, "A after the gain", LineStyle::line),
                  histogram_line(b.image.level_db, c.window, "B", LineStyle::dashed)};
  draw_chart(directory.file("levels.png"), levels);
  LineChart lags;
  lags.title = "Autocovariance of intensity", lags.x_title = "Lag [pixels]", lags.y_title = "Covariance, 1 at lag 0";
  lags.lines = {lag_line(c.a.speckle.covariance_bins, "A, range", LineStyle::line),
                lag_line(c.b.speckle.covariance_bins, "B, range", LineStyle::dashed),
                lag_line(c.a.speckle.covariance_beams, "A, beams", LineStyle::marked),
                lag_line(c.b.speckle.covariance_beams, "B, beams", LineStyle::points)};
  draw_chart(directory.file("correlation.png"), lags);
  LineChart map;
  map.title = "Monotone map", map.x_title = "Level of A after gain and TVG [dB]", map.y_title = "Level of B [dB]";
  map.lines = {{c.map.from, c.map.to, "fitted", LineStyle::marked},
               {c.map.from, c.map.from, "none", LineStyle::dashed}};
  draw_chart(directory.file("map.png"), map);
  write_page(directory, o,
             {{"a.png", "A, after the gain"},
              {"b.png", "B"},
              {"difference.png", "Difference, after the gain"},
              {"levels.png", "Levels"},
              {"correlation.png", "Autocovariance of intensity over its local mean"},
              {"map.png", "Map of levels"}},
             table);
}

void write_points_page(const RunDirectory& directory, const CompareOptions& o, const ComparedPoints& p,
                       const PointComparison& c, const std::string& table) {
  const auto draw = [&](const char* file, const std::vector<double>& x, const std::vector<double>& y,
                        const char* title) {
    LineChart chart;
    chart.title = title, chart.x_title = "Measured [dB]", chart.y_title = "Predicted [dB]";
    ChartLine line{{}, {}, "", LineStyle::points};
    const std::size_t step = std::max<std::size_t>(1, x.size() / 4000);
    for (std::size_t i = 0; i < x.size(); i += step) line.x.push_back(x[i]), line.y.push_back(y[i]);
    chart.lines = {line};
    draw_chart(directory.file(file), chart);
  };
  draw("points.png", p.measured_db, p.predicted_db, "Levels at the points");
  draw("points_without_trend.png", without_range_trend(p.measured_db, p.range),
       without_range_trend(p.predicted_db, p.range), "Levels less their trends over range");
  write_page(directory, o,
             {{"points.png", fmt::format("Levels: rank correlation {:.2f}", c.rank)},
              {"points_without_trend.png", fmt::format("Without the range trends: {:.2f}", c.rank_without_trend)}},
             table);
}

}  // namespace insonify::tool
