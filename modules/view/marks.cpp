// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/require.hpp"
#include "core/units.hpp"
#include "view/axes_internal.hpp"
#include "view/drawing_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

constexpr Colour ring_colour = {0.35, 0.88, 1.0}, halo_colour = {0.03, 0.05, 0.08};  // visible on every colour map
constexpr double ring_radius = 0.45;                                                 // in font sizes
constexpr int ring_sides = 32;

Box around(Point2 centre, double reach) {
  return {centre.x - reach, centre.x + reach, centre.y - reach, centre.y + reach};
}

bool is_free(const Box& box, const MarkRoom& room) {
  if (!room.box.contains(box)) return false;
  for (const Box& other : room.taken)
    if (box.overlaps(other)) return false;
  return true;
}

/// A name and the end of its leader line.
struct PlacedName {
  PlacedText text;
  double distance;  ///< distance from the ring [font sizes]
};

// Places the name nearest to its ring: at each distance to the right and left, then above and below.
std::optional<PlacedName> place_name(const Mark& mark, Point2 at, const MarkRoom& room) {
  PlacedText text(mark.text, at, room.font_size);
  text.on_plate = true;
  for (const double distance : {0.9, 1.8, 3.0, 4.5, 6.5})
    for (const double turn_deg : {20.0, 160.0, -20.0, 200.0, 60.0, 120.0, -60.0, 240.0, 90.0, 270.0}) {
      const double x = std::cos(radians(turn_deg)), y = std::sin(radians(turn_deg));
      const double aside = std::abs(x) < 0.1 ? 0 : x > 0 ? 0.5 : -0.5;
      text.centre = {at.x + x * distance * room.font_size + aside * text.extent.width,
                     at.y + y * (distance * room.font_size + text.extent.height / 2)};
      if (is_free(text.box(), room)) return PlacedName{text, distance};
    }
  return {};
}

// Returns the line from the ring to the nearest point of the name's box.
Path leader(Point2 from, const Box& box, double radius) {
  const Point2 to{std::clamp(from.x, box.left, box.right), std::clamp(from.y, box.bottom, box.top)};
  const double length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-9);
  return {{from.x + (to.x - from.x) * radius / length, from.y + (to.y - from.y) * radius / length}, to};
}

constexpr double least_distance = 0.05;  // between marks, as a fraction of the outer range

struct Maximum {
  Eigen::Index row = 0, bin = 0;
  float level_db = 0;
};

// Returns true for a local maximum. Only the first of equal neighbours is one.
bool is_maximum(const Grid<float>& level_db, Eigen::Index row, Eigen::Index bin) {
  const float level = level_db(row, bin);
  for (Eigen::Index r = std::max<Eigen::Index>(0, row - 1); r <= std::min(row + 1, level_db.rows() - 1); ++r)
    for (Eigen::Index b = std::max<Eigen::Index>(0, bin - 1); b <= std::min(bin + 1, level_db.cols() - 1); ++b) {
      const bool before = r < row || (r == row && b < bin);
      if (level_db(r, b) > level || (before && level_db(r, b) == level)) return false;
    }
  return true;
}

// Returns the local maxima, strongest first; equal ones in the order of the image.
std::vector<Maximum> local_maxima(const Grid<float>& level_db, double within_db) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const float level : level_db.reshaped<Eigen::RowMajor>())
    if (std::isfinite(level)) {
      lowest = std::min<double>(lowest, level);
      highest = std::max<double>(highest, level);
    }
  std::vector<Maximum> maxima;
  for (Eigen::Index row = 0; row < level_db.rows(); ++row)
    for (Eigen::Index bin = 0; bin < level_db.cols(); ++bin) {
      const float level = level_db(row, bin);
      if (level > lowest && level >= highest - within_db && is_maximum(level_db, row, bin))
        maxima.push_back({row, bin, level});
    }
  std::stable_sort(maxima.begin(), maxima.end(),
                   [](const Maximum& a, const Maximum& b) { return a.level_db > b.level_db; });
  return maxima;
}

std::string name_of(double bearing, double range, double bin_size, double level_db) {
  std::string text = number_text(range, std::clamp(round_step(bin_size), 0.01, 0.1));
  text += " m, ";
  text += bearing_text(degrees(bearing), 0.1);
  text += ", ";
  return text + number_text(level_db, 0.1) + " dB";
}

double distance(const Mark& a, const Mark& b) {
  const double squared =
      a.range * a.range + b.range * b.range - 2 * a.range * b.range * std::cos(a.bearing - b.bearing);
  return std::sqrt(std::max(0.0, squared));
}

}  // namespace

std::vector<Mark> marks_within(const std::vector<Mark>& marks, double low, double high, const RangeGate& gate) {
  const double max_range = gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size;
  std::vector<Mark> within;
  for (Mark mark : marks) {
    if (!(mark.range >= gate.min_range && mark.range <= max_range)) continue;
    mark.bearing = low + std::remainder(mark.bearing - low - pi, 2 * pi) + pi;  // first turn from `low` on
    if (mark.bearing <= high) within.push_back(mark);
  }
  return within;
}

void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, MarkRoom room) {
  const double radius = ring_radius * room.font_size, thin = line_width_for(room.font_size);
  std::vector<Path> lines;
  std::vector<PlacedText> names;
  for (const Mark& mark : marks) {
    lines.push_back(ring(room.at(mark.bearing, mark.range), radius, ring_sides));
    room.taken.push_back(around(room.at(mark.bearing, mark.range), radius + thin));
  }
  for (const Mark& mark : marks) {
    const Point2 at = room.at(mark.bearing, mark.range);
    const auto name = mark.text.empty() ? std::nullopt : place_name(mark, at, room);
    if (!name) continue;
    names.push_back(name->text);
    room.taken.push_back(name->text.box());
    if (name->distance > 1) lines.push_back(leader(at, name->text.box(), radius));
  }
  canvas.add_lines(lines, 3.2 * thin, halo_colour, 0.6);
  canvas.add_lines(lines, 1.4 * thin, ring_colour, 1);
  for (const PlacedText& name : names) canvas.add_text(name);
}

std::vector<Mark> strongest_maxima(const LevelImage& image, std::size_t count, double within_db) {
  require_drawable(image, {}, "strongest_maxima");
  require(within_db > 0, "strongest_maxima", "within_db", within_db, "dB", "> 0");
  const BeamCells cells = order_beams(image);
  const double apart = least_distance * image.gate.max_range;
  std::vector<Mark> marks;
  for (const Maximum& maximum : local_maxima(cells.level_db, within_db)) {
    if (marks.size() == count) break;
    const auto row = static_cast<std::size_t>(maximum.row);
    const double bearing = (cells.edges[row] + cells.edges[row + 1]) / 2;
    const double range = image.gate.centre(static_cast<std::size_t>(maximum.bin));
    const Mark mark{bearing, range, name_of(bearing, range, image.gate.bin_size, maximum.level_db)};
    if (std::all_of(marks.begin(), marks.end(), [&](const Mark& other) { return distance(mark, other) >= apart; }))
      marks.push_back(mark);
  }
  return marks;
}

}  // namespace insonify
