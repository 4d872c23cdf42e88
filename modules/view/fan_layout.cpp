// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "view/axes_internal.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"

namespace insonify {
namespace {

constexpr double narrow_gap = radians(40);  // behind a fan: too narrow for range labels, which then go onto the image

// The labels attached to the fan for one trial scale, with the apex at (0, 0).
struct Trial {
  std::vector<double> rings, spokes;
  std::vector<PlacedText> texts;
  Box extent;
};

Point2 polar(double bearing, double radius) { return {radius * std::sin(bearing), radius * std::cos(bearing)}; }

void include(Box& box, const Box& more) {
  box = {std::min(box.left, more.left), std::max(box.right, more.right), std::min(box.bottom, more.bottom),
         std::max(box.top, more.top)};
}

// Returns the bounding box of the sector, for a scale of 1.
Box sector_box(const FanOutline& fan) {
  Box box{1e300, -1e300, 1e300, -1e300};
  const auto add = [&](double bearing) {
    for (const double range : {fan.min_range, fan.max_range}) {
      const Point2 p = polar(bearing, range);
      include(box, {p.x, p.x, p.y, p.y});
    }
  };
  add(fan.low);
  add(fan.high);
  for (const double quarter : multiples(pi / 2, fan.low, fan.high)) add(quarter);
  return box;
}

bool inside_sector(const FanOutline& fan, double scale, Point2 p) {
  const double radius = std::hypot(p.x, p.y) / scale;
  if (radius < fan.min_range || radius > fan.max_range) return false;
  const double bearing = std::atan2(p.x, p.y);
  for (const double turn : {-2 * pi, 0.0, 2 * pi})
    if (bearing + turn >= fan.low && bearing + turn <= fan.high) return true;
  return false;
}

bool touches_sector(const FanOutline& fan, double scale, const Box& box) {
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      if (inside_sector(fan, scale, {box.left + i * box.width() / 4, box.bottom + j * box.height() / 4})) return true;
  return false;
}

Box grown(const Box& box, double by) { return {box.left - by, box.right + by, box.bottom - by, box.top + by}; }

// Moves a label from `foot` along a unit vector until its box keeps a distance of `pad` from the line through `foot`
// across that vector.
void push_out(PlacedText& label, Point2 foot, Point2 outwards, double pad) {
  const TextSize& size = label.extent;
  const double reach = pad + std::abs(outwards.x) * size.width / 2 + std::abs(outwards.y) * size.height / 2;
  label.centre = {foot.x + reach * outwards.x, foot.y + reach * outwards.y};
}

// Adds a label unless it overlaps an earlier one.
bool add_if_free(std::vector<PlacedText>& texts, const PlacedText& label, double gap) {
  const Box box = grown(label.box(), gap);
  for (const PlacedText& other : texts)
    if (box.overlaps(other.box())) return false;
  texts.push_back(label);
  return true;
}

// Adds bearing labels outside the outer arc.
void add_bearings(Trial& trial, const FanOutline& fan, double scale, int font) {
  const double arc = (fan.high - fan.low) * fan.max_range * scale;
  const double label_width = text_size("+180°", font).width;
  const double most = std::clamp(arc / (1.5 * label_width), 1.0, fan.high - fan.low > 3.3 ? 12.0 : 8.0);
  const BearingTicks ticks = bearing_ticks(degrees(fan.low), degrees(fan.high), most);
  for (const double bearing_deg : ticks.at_deg) {
    const double bearing = radians(bearing_deg);
    PlacedText label{bearing_text(bearing_deg, ticks.step), {}, font};
    push_out(label, polar(bearing, fan.max_range * scale), polar(bearing, 1), 0.6 * font);
    if (add_if_free(trial.texts, label, 0)) trial.spokes.push_back(bearing);
  }
}

// Adds range labels outside the starboard edge, or on the image if there is no room behind the fan.
void add_ranges(Trial& trial, const FanOutline& fan, double scale, int font) {
  const bool on_picture = 2 * pi - (fan.high - fan.low) < narrow_gap;
  const double spoke = trial.spokes.size() > 1 ? trial.spokes[1] - trial.spokes[0] : radians(30);
  const double bearing =
      on_picture
          ? trial.spokes.front() + std::floor(0.55 * static_cast<double>(trial.spokes.size())) * spoke + spoke / 2
          : fan.high;
  const TextSize widest = text_size(number_text(fan.max_range, 0.1) + " m", font);
  const double needed = std::min((widest.width + 0.5 * font) / std::max(std::abs(std::sin(bearing)), 1e-6),
                                 1.5 * widest.height / std::max(std::abs(std::cos(bearing)), 1e-6));
  const double step = round_step(std::max(fan.max_range / 8, needed / scale));
  for (const double ring : multiples(step, fan.min_range, fan.max_range)) {
    if (ring <= 0) continue;
    trial.rings.push_back(ring);
    PlacedText label{number_text(ring, step) + " m", polar(bearing, ring * scale), font};
    label.on_plate = on_picture;
    if (!on_picture) push_out(label, label.centre, polar(bearing + pi / 2, 1), 0.5 * font);
    const bool hidden =
        on_picture ? ring * scale + widest.height > fan.max_range * scale : touches_sector(fan, scale, label.box());
    if (!hidden) add_if_free(trial.texts, label, 0.15 * font);
  }
}

Trial try_scale(const FanOutline& fan, double scale, int font) {
  Trial trial;
  add_bearings(trial, fan, scale, font);
  add_ranges(trial, fan, scale, font);
  const Box sector = sector_box(fan);
  trial.extent = {sector.left * scale, sector.right * scale, sector.bottom * scale, sector.top * scale};
  for (const PlacedText& text : trial.texts) include(trial.extent, text.box());
  return trial;
}

// Mirrors the labels at the horizontal line through the apex.
void turn_over(Trial& trial) {
  for (PlacedText& text : trial.texts) text.centre.y = -text.centre.y;
  trial.extent = {trial.extent.left, trial.extent.right, -trial.extent.top, -trial.extent.bottom};
}

// Returns the largest scale at which the fan and its labels fit into the room, by bisection. The set of labels depends
// on the scale, so the result is a scale that was tried and fits.
double fitting_scale(const FanOutline& fan, const Box& room, int font) {
  const Box sector = sector_box(fan);
  double fits = 0, too_large = std::min(room.width() / sector.width(), room.height() / sector.height());
  for (int round = 0; round < 14; ++round) {
    const double scale = (fits + too_large) / 2;
    const Box extent = try_scale(fan, scale, font).extent;
    (extent.width() <= room.width() && extent.height() <= room.height() ? fits : too_large) = scale;
  }
  return fits > 0 ? fits : too_large / 4;
}

}  // namespace

Point2 FanLayout::at(double bearing, double range) const {
  const Point2 p = polar(bearing, range * pixels_per_metre);
  return {apex.x + p.x, downwards ? apex.y - p.y : apex.y + p.y};
}

Point2 FanLayout::from_apex(Point2 position) const {
  return {position.x - apex.x, downwards ? apex.y - position.y : position.y - apex.y};
}

int font_size_for(int width, int height) {
  return std::max(11, static_cast<int>(std::lround(std::sqrt(static_cast<double>(width) * height) / 68.0)));
}

int font_size_for(const PictureOptions& options) {
  return options.font_size > 0 ? options.font_size : font_size_for(options.width, options.height);
}

double line_width_for(int font_size) { return std::max(1.0, font_size / 15.0); }

std::optional<PlacedText> put_title(const PictureOptions& options) {
  if (options.title.empty()) return {};
  const int font = font_size_for(options);
  const FittedText fitted = fit_text(options.title, (5 * font) / 4, options.width - 2.0 * font);
  PlacedText title(fitted.text, {options.width / 2.0, 0}, fitted.font_size);
  title.centre.y = options.height - 0.8 * font - title.extent.height / 2;
  return title;
}

namespace {

/// A fan with its labels around the apex, and the room that title and colour bar leave for them.
struct FanRoom {
  Trial trial;
  Box room;
};

FanRoom lay_out_room(FanLayout& layout, const FanOutline& fan, const PictureOptions& options, const ColourScale& scale,
                     const std::string& unit) {
  const int font = font_size_for(options);
  layout.title = put_title(options);

  // Try the bar at the right and below.
  const double margin = font;
  const double top = (layout.title ? layout.title->box().bottom : options.height) - margin;
  const double right = options.width - margin;
  const double inset = 0.08 * (top - margin);
  const ColourBar upright = upright_colour_bar(scale, unit, font, right, margin + inset, top - inset);
  const ColourBar lying = lying_colour_bar(scale, unit, font, 0.2 * options.width, 0.8 * options.width, margin);
  const Box beside{margin, upright.outer().left - 1.2 * font, margin, top};
  const Box above{margin, right, lying.outer().top + 1.2 * font, top};
  const double scale_beside = fitting_scale(fan, beside, font), scale_above = fitting_scale(fan, above, font);
  const bool lie = scale_above > 1.05 * scale_beside;
  layout.colour_bar = lie ? lying : upright;
  layout.pixels_per_metre = lie ? scale_above : scale_beside;
  FanRoom placed{try_scale(fan, layout.pixels_per_metre, font), lie ? above : beside};
  if (fan.downwards) turn_over(placed.trial);
  return placed;
}

}  // namespace

PictureOptions trimmed_to_fan(const FanOutline& fan, const PictureOptions& options, const ColourScale& scale,
                              const std::string& unit) {
  FanLayout layout;
  const auto [trial, room] = lay_out_room(layout, fan, options, scale, unit);
  const auto without = [](int pixels, double least, double free) {
    const double needed = std::max(pixels - std::max(free, 0.0), least);
    return std::min(pixels, 2 * static_cast<int>(std::ceil(needed / 2)));
  };
  PictureOptions trimmed = options;
  trimmed.font_size = font_size_for(options);
  const double title = layout.title ? layout.title->box().width() + 2 * trimmed.font_size : 0;
  trimmed.width = without(options.width, std::max(title, 0.45 * options.width), room.width() - trial.extent.width());
  trimmed.height = without(options.height, 0.45 * options.height, room.height() - trial.extent.height());
  return trimmed;
}

FanLayout lay_out_fan(const FanOutline& fan, const PictureOptions& options, const ColourScale& scale,
                      const std::string& unit) {
  FanLayout layout;
  layout.low = fan.low;
  layout.high = fan.high;
  layout.min_range = fan.min_range;
  layout.max_range = fan.max_range;
  layout.downwards = fan.downwards;
  layout.font_size = font_size_for(options);

  // Centre the fan with its labels in the room.
  auto [trial, room] = lay_out_room(layout, fan, options, scale, unit);
  layout.apex = {(room.left + room.right - trial.extent.left - trial.extent.right) / 2,
                 (room.bottom + room.top - trial.extent.bottom - trial.extent.top) / 2};
  for (PlacedText& text : trial.texts) text.centre = {text.centre.x + layout.apex.x, text.centre.y + layout.apex.y};
  layout.rings = std::move(trial.rings);
  layout.spokes = std::move(trial.spokes);
  layout.texts = std::move(trial.texts);
  return layout;
}

CellFrame lay_out_cell_frame(const CellAxis& across, const CellAxis& up, const ColourScale& scale,
                             const std::string& unit, const PictureOptions& options) {
  // The cells fill the space left by title, labels and colour bar.
  CellFrame frame;
  frame.font_size = font_size_for(options);
  frame.title = put_title(options);
  const double margin = 0.8 * frame.font_size, bottom = margin + room_below(frame.font_size);
  const double top = (frame.title ? frame.title->box().bottom : options.height) - frame.font_size;
  frame.bar = upright_colour_bar(scale, unit, frame.font_size, options.width - margin, bottom, top);
  const AxisTicks upwards = up.ticks(top - bottom);
  const Box cells{margin + room_left(upwards, frame.font_size), frame.bar.bar.left - 1.2 * frame.font_size, bottom,
                  top};
  frame.axes = {cells, across.low, across.high, up.low, up.high, {}, {}, {}};
  add_axis_across(frame.axes, across.ticks(cells.width()), across.title, frame.font_size);
  add_axis_upwards(frame.axes, upwards, up.title, frame.font_size);
  return frame;
}

void draw_cell_frame(Canvas& canvas, const CellFrame& frame, const ColourScale& scale) {
  const double thin = line_width_for(frame.font_size);
  canvas.add_lines(frame.axes.grid, thin, grid_colour, grid_opacity);
  std::vector<Path> lines = frame.axes.ticks;
  lines.push_back(outline(frame.axes.frame));
  canvas.add_lines(lines, thin, canvas.colours().line, 1);
  for (const PlacedText& text : frame.axes.texts) canvas.add_text(text);
  if (frame.title) canvas.add_text(*frame.title);
  canvas.add_colour_bar(frame.bar, scale, thin);
}

}  // namespace insonify
