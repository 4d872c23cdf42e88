// SPDX-License-Identifier: BSD-3-Clause
#include "view/show_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/drawing_internal.hpp"

namespace insonify {
namespace {

constexpr float no_level = -200;
constexpr std::array<Colour, 6> track_colours = {
    {{0.1, 0.75, 0.95}, {1, 0.35, 0.3}, {0.45, 0.9, 0.35}, {1, 0.8, 0.2}, {0.8, 0.5, 1}, {1, 0.6, 0.8}}};

/// Returns the box of the map: tracks with a margin, and the levels.
Eigen::AlignedBox2d extent_of(const TrackMap& map) {
  Eigen::AlignedBox2d box;
  for (const TrackMap::HeadTrack& head_track : map.tracks)
    for (const Eigen::Vector2d& position : head_track.positions) box.extend(position);
  if (map.level_db.size() > 0) {
    box.extend(Eigen::Vector2d(map.x, map.y));
    const Eigen::Vector2d cells(static_cast<double>(map.level_db.rows()), static_cast<double>(map.level_db.cols()));
    box.extend(Eigen::Vector2d(Eigen::Vector2d(map.x, map.y) + map.cell * cells));
  }
  if (box.isEmpty()) fail(ErrorKind::argument, "show_track: no way has a place, must have at least one");
  const double room = std::max(0.5, 0.04 * box.sizes().maxCoeff());
  return {box.min().array() - room, box.max().array() + room};
}

/// Returns the box widened on one side until it has this ratio of width to height.
Eigen::AlignedBox2d widened(const Eigen::AlignedBox2d& box, double ratio) {
  Eigen::Vector2d size = box.sizes();
  if (size.x() < ratio * size.y())
    size.x() = ratio * size.y();
  else
    size.y() = size.x() / ratio;
  return {box.center() - size / 2, box.center() + size / 2};
}

CellFrame frame_about(const Eigen::AlignedBox2d& box, const ColourScale& scale, const std::string& unit,
                      const PictureOptions& options, int font) {
  const auto ticks = [font](double low, double high) {
    return [=](double pixels) { return round_ticks(low, high, std::min(12.0, pixels / (4.5 * font))); };
  };
  const CellAxis across{box.min().x(), box.max().x(), "x [m]", ticks(box.min().x(), box.max().x())};
  const CellAxis up{box.min().y(), box.max().y(), "y [m]", ticks(box.min().y(), box.max().y())};
  return lay_out_cell_frame(across, up, scale, unit, options);
}

void draw_levels(Canvas& canvas, const TrackMap& map, const Axes& axes, const ColourScale& scale) {
  BeamCells rows;
  rows.level_db = map.level_db.transpose();
  rows.level_db = rows.level_db.isFinite().select(rows.level_db, no_level);
  for (Eigen::Index row = 0; row <= rows.level_db.rows(); ++row)
    rows.edges.push_back(map.y + static_cast<double>(row) * map.cell);
  const double right = map.x + static_cast<double>(map.level_db.rows()) * map.cell;
  const Point2 low = axes.at(map.x, map.y), high = axes.at(right, rows.edges.back());
  canvas.add_cells(
      rect_patch(rows, {map.x, right, map.cell}, high.x - low.x, high.y - low.y), rows.edges, scale,
      [&](double y, double x) { return axes.at(x, y); }, rows.edges.back() - rows.edges.front());
}

void draw_head_track(Canvas& canvas, const TrackMap::HeadTrack& head_track, const Axes& axes, const Colour& colour,
                     int font) {
  const auto at = [&](const Eigen::Vector2d& p) { return axes.at(p.x(), p.y()); };
  const double thin = line_width_for(font);
  Path line;
  for (const Eigen::Vector2d& position : head_track.positions) line.push_back(at(position));
  std::vector<Path> strokes;
  const std::size_t step = std::max<std::size_t>(1, head_track.positions.size() / 20);
  for (std::size_t i = 0; i < head_track.ahead.size(); i += step)
    strokes.push_back(
        {line[i],
         {line[i].x + 1.5 * font * head_track.ahead[i].x(), line[i].y + 1.5 * font * head_track.ahead[i].y()}});
  canvas.add_lines({line, ring(line.back(), 0.4 * font, 24)}, 2.5 * thin, colour, 1);
  canvas.add_lines(strokes, 1.5 * thin, colour, 0.8);
}

/// Draws names beside the beginnings of the tracks, one below the other where they would meet.
void draw_names(Canvas& canvas, const TrackMap& map, const Axes& axes, int font) {
  std::vector<Box> taken;
  for (const TrackMap::HeadTrack& head_track : map.tracks) {
    if (head_track.positions.empty()) continue;
    const Point2 begin = axes.at(head_track.positions.front().x(), head_track.positions.front().y());
    PlacedText name(head_track.name, begin, font);
    name.on_plate = true;
    const auto put = [&](double x, double y) {
      const double half = name.extent.width / 2 + 2, tall = name.extent.height;
      name.centre = {std::clamp(x, axes.frame.left + half, std::max(axes.frame.left + half, axes.frame.right - half)),
                     std::clamp(y, axes.frame.bottom + tall, axes.frame.top - tall)};
    };
    double below = 0;
    do put(begin.x - name.extent.width / 2 - font, begin.y - below);
    while (std::any_of(taken.begin(), taken.end(), [&](const Box& box) { return box.overlaps(name.box()); }) &&
           (below += 1.5 * font) < axes.frame.height());
    taken.push_back(name.box());
    canvas.add_text(name);
  }
}

}  // namespace

void show_track(const TrackMap& map, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_track";
  require_picture_size(options, who);
  if (!(map.cell > 0)) fail(ErrorKind::argument, who, ": cell = ", map.cell, " m, must be > 0");
  const Eigen::AlignedBox2d extent = extent_of(map);
  save_picture(options, who, png_path, [&](Canvas& canvas) {
    const int font = font_size_for(options);
    const Grid<float> silent = Grid<float>::Constant(1, 1, no_level);
    const ColourScale scale = colour_scale(map.level_db.size() > 0 ? map.level_db : silent, options, who);
    const Box first = frame_about(extent, scale, map.unit, options, font).axes.frame;
    const CellFrame frame =
        frame_about(widened(extent, first.width() / first.height()), scale, map.unit, options, font);
    if (map.level_db.size() > 0) draw_levels(canvas, map, frame.axes, scale);
    for (std::size_t w = 0; w < map.tracks.size(); ++w)
      if (!map.tracks[w].positions.empty())
        draw_head_track(canvas, map.tracks[w], frame.axes, track_colours[w % track_colours.size()], font);
    draw_names(canvas, map, frame.axes, font);
    draw_cell_frame(canvas, frame, scale);
  });
}

}  // namespace insonify
