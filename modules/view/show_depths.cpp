// SPDX-License-Identifier: BSD-3-Clause
#include "view/show_depths.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "view/contours_internal.hpp"
#include "view/drawing_internal.hpp"

namespace insonify {
namespace {

constexpr double contours_wanted = 12;   // about as many over the range of depths
constexpr double relief_range = 0.6;     // of brightness that shading takes, of 1
constexpr double most_exaggeration = 5;  // more would show the noise of a level bed
constexpr double least_named = 8;        // length of a contour with a name, in sizes of its font
constexpr Colour contour_colour = {0.05, 0.05, 0.1}, rejected_colour = {0.9, 0.1, 0.1};

/// Returns least and greatest height of a map. Throws Error(argument) if there is none.
std::pair<double, double> heights_of(const DepthMap& map, const char* who) {
  float low = INFINITY, high = -INFINITY;
  for (const float z : map.height.reshaped())
    if (std::isfinite(z)) low = std::min(low, z), high = std::max(high, z);
  if (!(low <= high)) fail(ErrorKind::argument, who, ": no cell has a height, must have one at least");
  const double room = low == high ? 0.05 : 0;
  return {static_cast<double>(low) - room, static_cast<double>(high) + room};
}

/// Returns the vertical exaggeration at which the steeper slopes of a map are at 45 degrees, at least 1.
double exaggeration_of(const Grid<float>& height, double cell) {
  std::vector<double> slopes;
  for (Eigen::Index x = 0; x + 1 < height.rows(); ++x)
    for (Eigen::Index y = 0; y < height.cols(); ++y)
      if (const double dz = static_cast<double>(std::abs(height(x + 1, y) - height(x, y))); std::isfinite(dz))
        slopes.push_back(dz / cell);
  if (slopes.empty()) return 1;
  const auto at = slopes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(slopes.size() - 1));
  std::nth_element(slopes.begin(), at, slopes.end());
  return std::clamp(1 / std::max(*at, 1e-6), 1.0, most_exaggeration);
}

/// Returns the colours of the cells, row after row of y from below: by height, brighter and darker by the relief.
std::vector<Rgb> relief_colours(const DepthMap& map, const ColourScale& scale, const Rgb& nothing) {
  const Grid<float> bright =
      relief_of(map.height / static_cast<float>(map.cell), exaggeration_of(map.height, map.cell));
  std::vector<Rgb> colours;
  for (Eigen::Index y = 0; y < map.height.cols(); ++y)
    for (Eigen::Index x = 0; x < map.height.rows(); ++x) {
      if (!std::isfinite(map.height(x, y))) {
        colours.push_back(nothing);
        continue;
      }
      Rgb colour = scale.colour(static_cast<double>(map.height(x, y)));
      const double share = 1 - relief_range + relief_range * std::min(1.4, static_cast<double>(bright(x, y)));
      for (std::uint8_t& part : colour) part = static_cast<std::uint8_t>(std::min(255.0, part * share));
      colours.push_back(colour);
    }
  return colours;
}

double length_of(const Path& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return length;
}

/// Draws contours at multiples of a step, every second of them with its depth in the middle.
void draw_contours(Canvas& canvas, const DepthMap& map, const Axes& axes, const ColourScale& scale, int font) {
  const double step = round_step((scale.max_db - scale.min_db) / contours_wanted);
  const auto at = [&](const Eigen::Vector2d& place) {
    return axes.at(map.x + (place.x() + 0.5) * map.cell, map.y + (place.y() + 0.5) * map.cell);
  };
  std::vector<Box> taken;
  for (const double height : multiples(step, scale.min_db, scale.max_db)) {
    const bool named = std::llround(height / step) % 2 == 0;
    for (const Contour& contour : contours_at(map.height, height)) {
      Path line;
      for (const Eigen::Vector2d& place : contour) line.push_back(at(place));
      canvas.add_lines({line}, (named ? 1.4 : 0.7) * line_width_for(font), contour_colour, named ? 0.75 : 0.5);
      PlacedText depth(number_text(-height, step), line[line.size() / 2], font * 4 / 5);
      depth.on_plate = true;
      const Box box = depth.box();
      const bool free = std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return box.overlaps(other); });
      if (!named || length_of(line) < least_named * font || !free || !axes.frame.contains(box)) continue;
      taken.push_back(box);
      canvas.add_text(depth);
    }
  }
}

void draw_rejected(Canvas& canvas, const DepthMap& map, const Axes& axes, int font) {
  std::vector<Path> crosses;
  const double arm = 0.22 * font;
  for (const Eigen::Vector2d& place : map.rejected) {
    const auto [x, y] = axes.at(place.x(), place.y());
    crosses.push_back({{x - arm, y - arm}, {x + arm, y + arm}});
    crosses.push_back({{x - arm, y + arm}, {x + arm, y - arm}});
  }
  canvas.add_lines(crosses, 1.2 * line_width_for(font), rejected_colour, 0.9);
}

/// Returns the layout of a map in a box of the plane.
CellFrame depth_frame(const DepthMap& map, const Eigen::Vector4d& box, const ColourScale& scale,
                      const PictureOptions& options, int font) {
  const auto axis = [&](double low, double high, const std::string& title) {
    return CellAxis{low, high, title,
                    [=](double pixels) { return round_ticks(low, high, std::min(12.0, pixels / (5.5 * font))); }};
  };
  CellFrame frame = lay_out_cell_frame(axis(box[0], box[1], map.x_title), axis(box[2], box[3], map.y_title), scale,
                                       "Depth " + map.datum + " [m]", options);
  label_by_depths(frame.bar);
  return frame;
}

/// Returns a box of the plane, left, right, below and above, that holds the map and has this ratio of width to height.
Eigen::Vector4d box_about(const DepthMap& map, double ratio) {
  const Eigen::Vector2d size(map.cell * static_cast<double>(map.height.rows()),
                             map.cell * static_cast<double>(map.height.cols()));
  const Eigen::Vector2d middle = Eigen::Vector2d(map.x, map.y) + size / 2;
  const double tall = 1.06 * std::max(size.y(), size.x() / ratio), wide = tall * ratio;
  return {middle.x() - wide / 2, middle.x() + wide / 2, middle.y() - tall / 2, middle.y() + tall / 2};
}

}  // namespace

void show_depths(const DepthMap& map, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_depths";
  require_picture_size(options, who);
  if (!(map.cell > 0)) fail(ErrorKind::argument, who, ": cell = ", map.cell, " m, must be > 0");
  const auto [low, high] = heights_of(map, who);
  const ColourScale scale{colour_table(options.colour_map, who), low, high};
  save_picture(options, who, png_path, [&](Canvas& canvas) {
    const int font = font_size_for(options);
    const Box first = depth_frame(map, box_about(map, 1), scale, options, font).axes.frame;
    const CellFrame frame = depth_frame(map, box_about(map, first.width() / first.height()), scale, options, font);
    const auto part = [](double of) { return static_cast<std::uint8_t>(255 * of); };
    const Colour& back = canvas.colours().background;
    const double right = map.x + map.cell * static_cast<double>(map.height.rows());
    const double top = map.y + map.cell * static_cast<double>(map.height.cols());
    const Point2 from = frame.axes.at(map.x, map.y), to = frame.axes.at(right, top);
    canvas.add_image({from.x, to.x, from.y, to.y}, static_cast<int>(map.height.rows()),
                     relief_colours(map, scale, {part(back[0]), part(back[1]), part(back[2])}));
    draw_contours(canvas, map, frame.axes, scale, font);
    draw_rejected(canvas, map, frame.axes, font);
    draw_cell_frame(canvas, frame, scale);
  });
}

}  // namespace insonify
