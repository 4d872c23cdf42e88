#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.hpp"
#include "view/draw_marks_internal.hpp"
#include "view/fan_layout_internal.hpp"

namespace insonify {
namespace {

constexpr Colour ring_colour = {0.35, 0.88, 1.0}, halo_colour = {0.03, 0.05, 0.08};  // visible on every colour map
constexpr double ring_radius = 0.45;                                                 // in font sizes

Path ring(Point2 centre, double radius) {
  constexpr int corners = 32;
  Path path;
  for (int i = 0; i <= corners; ++i) {
    const double turn = 2 * pi * (i % corners) / corners;
    path.push_back({centre.x + radius * std::cos(turn), centre.y + radius * std::sin(turn)});
  }
  return path;
}

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
  double distance;  ///< from the ring [font sizes]
};

// Nearest first; at each distance to the right and left, then above and below.
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

// From the ring to the nearest point of the name's box.
Path leader(Point2 from, const Box& box, double radius) {
  const Point2 to{std::clamp(from.x, box.left, box.right), std::clamp(from.y, box.bottom, box.top)};
  const double length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-9);
  return {{from.x + (to.x - from.x) * radius / length, from.y + (to.y - from.y) * radius / length}, to};
}

}  // namespace

std::vector<Mark> marks_within(const std::vector<Mark>& marks, double low, double high, const RangeGate& gate) {
  const double max_range = gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size;
  std::vector<Mark> within;
  for (Mark mark : marks) {
    if (!(mark.range >= gate.min_range && mark.range <= max_range)) continue;
    mark.bearing = low + std::remainder(mark.bearing - low - pi, 2 * pi) + pi;  // the first one from `low` on
    if (mark.bearing <= high) within.push_back(mark);
  }
  return within;
}

void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, MarkRoom room) {
  const double radius = ring_radius * room.font_size, thin = line_width_for(room.font_size);
  std::vector<Path> lines;
  std::vector<PlacedText> names;
  for (const Mark& mark : marks) {
    lines.push_back(ring(room.at(mark.bearing, mark.range), radius));
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

}  // namespace insonify
