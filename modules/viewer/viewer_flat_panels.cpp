// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "view/drawing_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/ping_record.hpp"
#include "viewer/viewer_flat_panels_internal.hpp"

namespace insonify {
namespace {

constexpr Colour mark_colour = {0.25, 0.95, 0.95}, measure_colour = {0.55, 1.0, 0.45};
constexpr int ring_sides = 24;
constexpr std::size_t sampled_pings = 16;  // number of pings for the common scale

Path arc_of(const FanLayout& layout, double range) {
  constexpr int steps = 256;
  Path path;
  for (int i = 0; i <= steps; ++i)
    path.push_back(layout.at(layout.low + (layout.high - layout.low) * i / steps, range));
  return path;
}

void mark_measure(Canvas& canvas, const FanLayout& layout, const Measure& measure, int font_size) {
  std::vector<Point2> at;
  for (const Eigen::Vector2d& p : measure.points)
    at.push_back({layout.apex.x + p.x() * layout.pixels_per_metre, layout.apex.y + p.y() * layout.pixels_per_metre});
  for (const Point2& p : at) canvas.add_lines({ring(p, 4, ring_sides)}, 2, measure_colour, 1);
  if (at.size() < 2) return;
  canvas.add_lines({{at[0], at[1]}}, 2, measure_colour, 1);
  PlacedText length(number_text(measure.length(), 0.001) + " m",
                    {(at[0].x + at[1].x) / 2, (at[0].y + at[1].y) / 2 + 1.2 * font_size}, font_size);
  length.on_plate = true;
  canvas.add_text(length);
}

// Returns the strongest of the beams drawn in the cell at a bearing, which share a cell with the nearest beam.
std::optional<std::size_t> strongest_at(const LevelImage& image, double bearing, Eigen::Index bin) {
  const BeamCells cells = order_beams(image);
  const auto turned = [&](double angle) {  // wraps an angle into the fan's interval
    const double middle = (cells.low() + cells.high()) / 2;
    return middle + std::remainder(angle - middle, 2 * pi);
  };
  const double at = turned(bearing);
  if (at < cells.low() || at > cells.high()) return {};
  const auto edge = std::upper_bound(cells.edges.begin() + 1, cells.edges.end() - 1, at);
  const double low = *(edge - 1), high = *edge;
  std::optional<std::size_t> found;
  for (std::size_t b = 0; b < image.fan.beams(); ++b) {
    const double own = turned(-image.fan.azimuth[b]);
    if (own < low || own > high) continue;
    const auto row = static_cast<Eigen::Index>(b);
    if (!found || image.level_db(row, bin) > image.level_db(static_cast<Eigen::Index>(*found), bin)) found = b;
  }
  return found;
}

}  // namespace

LevelImage levels_of(const ViewerData& data, std::size_t ping_index, bool tvg) {
  const auto ping = data.pings.ping(ping_index);
  LevelImage image = level_image(*ping, tvg ? std::optional(Tvg{40, ping->absorption_db_per_m}) : std::nullopt);
  image.unit = unit_of(data, tvg);
  if (ping->scan)
    for (double& azimuth : image.fan.azimuth) azimuth = std::remainder(azimuth + ping->scan->angle, 2 * pi);
  return image;
}

std::array<double, 2> common_max_db(const ViewerData& data) {
  const std::size_t step = (data.pings.size() + sampled_pings - 1) / sampled_pings;
  std::array<double, 2> highest = {-1e300, -1e300};
  for (std::size_t i = 0; i < data.pings.size(); i += step)
    for (const bool tvg : {false, true})
      highest[tvg] = std::max(highest[tvg], colour_scale(levels_of(data, i, tvg).level_db, {}, "show_viewer").max_db);
  return highest;
}

LineChart bearing_chart(const LevelImage& image, PixelPosition position, const PictureOptions& options) {
  constexpr double same_row = 1e-6;  // [rad]
  std::vector<std::size_t> order;
  for (std::size_t b = 0; b < image.fan.beams(); ++b)
    if (image.fan.row_width == 0 || std::abs(image.fan.elevation[b] - image.fan.elevation[position.beam]) < same_row)
      order.push_back(b);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return image.fan.azimuth[a] > image.fan.azimuth[b]; });
  LineChart chart;
  ChartLine& line = chart.lines[0];
  double highest = -200;
  for (const std::size_t b : order) {
    const double level = image.level_db(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(position.bin));
    line.x.push_back(-degrees(image.fan.azimuth[b]));
    line.y.push_back(std::isfinite(level) ? level : -200);
    highest = std::max(highest, line.y.back());
  }
  chart.low_x = line.x.front();
  chart.high_x = std::max(line.x.back(), chart.low_x + 1e-3);
  chart.high_y = next_five(highest);
  chart.low_y = chart.high_y - options.window_db;
  for (double& y : line.y) y = std::max(y, chart.low_y - options.window_db);
  chart.title = "Across the beams at " + number_text(image.gate.centre(position.bin), 0.01) + " m";
  if (image.fan.row_width > 0)
    chart.title += ", row at " + bearing_text(degrees(image.fan.elevation[position.beam]), 0.1) + " elevation";
  chart.x_title = "Bearing [°], positive to starboard";
  chart.y_title = "Level, " + image.unit;
  return chart;
}

void mark_fan(ViewerPanel& panel, const FanLayout& layout, const FanMarks& marks, const PictureOptions& options) {
  Canvas canvas = fresh_canvas(panel.marks, options, true);
  if (marks.bearing)
    canvas.add_lines({{layout.at(*marks.bearing, layout.min_range), layout.at(*marks.bearing, layout.max_range)}}, 1,
                     mark_colour, 0.45);
  if (marks.bearing && marks.range) {
    canvas.add_lines({arc_of(layout, *marks.range)}, 1, mark_colour, 0.45);
    canvas.add_lines({ring(layout.at(*marks.bearing, *marks.range), 0.55 * options.font_size, ring_sides)}, 2,
                     mark_colour, 1);
  }
  mark_measure(canvas, layout, marks.measure, options.font_size);
}

void mark_waterfall(ViewerPanel& panel, const Axes& axes, double row, std::optional<double> range,
                    const PictureOptions& options, bool keep_camera) {
  Canvas canvas = fresh_canvas(panel.marks, options, keep_camera);
  const double y = axes.at(axes.low_x, row + 0.5).y;
  canvas.add_lines({{{axes.frame.left, y}, {axes.frame.right, y}}}, 1, mark_colour, 0.6);
  if (!range) return;
  const double x = axes.at(*range, axes.low_y).x;
  canvas.add_lines({{{x, axes.frame.bottom}, {x, axes.frame.top}}}, 1, mark_colour, 0.35);
  canvas.add_lines({ring({x, y}, 0.55 * options.font_size, ring_sides)}, 2, mark_colour, 1);
}

void mark_ascan(ViewerPanel& panel, const LevelImage& image, const Axes& axes, std::optional<PixelPosition> selected,
                const PictureOptions& options) {
  Canvas canvas = fresh_canvas(panel.marks, options, false);
  if (!selected) return;
  const double x = axes.at(image.gate.centre(selected->bin), 0).x;
  canvas.add_lines({{{x, axes.frame.bottom}, {x, axes.frame.top}}}, 1.5, mark_colour, 0.8);
}

FanPosition fan_position(const FanLayout& layout, Point2 position) {
  const auto [x, y] = layout.from_apex(position);
  return {std::atan2(x, y), std::hypot(x, y) / layout.pixels_per_metre};
}

Eigen::Vector2d metres_on_fan(FanPosition position) {
  return position.range * Eigen::Vector2d(std::sin(position.bearing), std::cos(position.bearing));
}

std::optional<PixelPosition> pixel_at(const LevelImage& image, FanPosition position) {
  const double bin = std::floor((position.range - image.gate.min_range) / image.gate.bin_size);
  if (!(bin >= 0 && bin < static_cast<double>(image.level_db.cols()))) return {};
  const auto beam = strongest_at(image, position.bearing, static_cast<Eigen::Index>(bin));
  if (!beam) return {};
  return PixelPosition{*beam, static_cast<std::size_t>(bin)};
}

std::optional<std::size_t> bin_at(const LevelImage& image, const Axes& axes, Point2 position) {
  const Box& frame = axes.frame;
  if (!frame.contains({position.x, position.x, position.y, position.y})) return {};
  const double range = axes.low_x + (axes.high_x - axes.low_x) * (position.x - frame.left) / frame.width();
  const double bin = std::floor((range - image.gate.min_range) / image.gate.bin_size);
  if (!(bin >= 0 && bin < static_cast<double>(image.level_db.cols()))) return {};
  return static_cast<std::size_t>(bin);
}

std::optional<std::size_t> row_at(const Axes& axes, Point2 position) {
  const Box& frame = axes.frame;
  if (!frame.contains({position.x, position.x, position.y, position.y})) return {};
  const double row = axes.low_y + (axes.high_y - axes.low_y) * (position.y - frame.bottom) / frame.height();
  return static_cast<std::size_t>(std::clamp(std::floor(row), 0.0, std::max(0.0, axes.high_y - 1)));
}

}  // namespace insonify
