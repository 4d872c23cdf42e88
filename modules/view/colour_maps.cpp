// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "view/axes_internal.hpp"
#include "view/colour_maps_internal.hpp"

namespace insonify {
namespace {

// A stop of a colour map: position in [0, 1] and colour 0xRRGGBB; colours between stops are linear.
struct ColourStop {
  double at;
  std::uint32_t rgb;
};
struct NamedMap {
  const char* name;
  std::vector<ColourStop> stops;
};

// Returns twenty equally spaced colours of viridis (S. van der Walt and N. Smith, CC0).
std::vector<ColourStop> viridis_stops() {
  constexpr std::uint32_t colours[] = {0x440154, 0x481567, 0x482677, 0x453781, 0x404788, 0x39568C, 0x33638D,
                                       0x2D708E, 0x287D8E, 0x238A8D, 0x1F968B, 0x20A387, 0x29AF7F, 0x3CBB75,
                                       0x55C667, 0x73D055, 0x95D840, 0xB8DE29, 0xDCE319, 0xFDE725};
  std::vector<ColourStop> stops;
  for (const std::uint32_t rgb : colours) stops.push_back({static_cast<double>(stops.size()) / 19.0, rgb});
  return stops;
}

// Returns all maps. Copper and jet are MATLAB's. Bronze has lightness 0, 20, 84, 98 and CIELAB hue -10, 15, 95, 102
// degrees at 0, 0.3, 0.8 and 1, linear in between, so that most of its contrast lies where sea beds and their speckle
// are. Amber is the screen of an analogue sonar: black, brown, orange, pale yellow.
std::vector<NamedMap> colour_maps() {
  return {{"viridis", viridis_stops()},
          {"bronze",
           {{0, 0x000000},
            {0.1, 0x250D16},
            {0.2, 0x440D1F},
            {0.3, 0x650522},
            {0.4, 0x961D22},
            {0.5, 0xC0400E},
            {0.6, 0xD77200},
            {0.7, 0xE5A200},
            {0.8, 0xECD235},
            {0.9, 0xF6E78F},
            {1, 0xFFFADD}}},
          {"copper", {{0, 0x000000}, {0.8, 0xFF9F65}, {1, 0xFFC77F}}},
          {"amber", {{0, 0x000000}, {0.35, 0x6B3205}, {0.7, 0xF39A1B}, {0.9, 0xFFDF7A}, {1, 0xFFF8DC}}},
          {"grey", {{0, 0x000000}, {1, 0xFFFFFF}}},
          {"jet",
           {{0, 0x000080}, {0.125, 0x0000FF}, {0.375, 0x00FFFF}, {0.625, 0xFFFF00}, {0.875, 0xFF0000}, {1, 0x800000}}}};
}

Rgb mix(const ColourStop& low, const ColourStop& high, double at) {
  const double share = (at - low.at) / (high.at - low.at);
  Rgb colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t shift = 16 - 8 * static_cast<std::uint32_t>(c);
    const double a = (low.rgb >> shift) & 0xFF, b = (high.rgb >> shift) & 0xFF;
    colour[c] = static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
  }
  return colour;
}

ColourTable expand(const std::vector<ColourStop>& stops) {
  ColourTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double at = static_cast<double>(i) / 255.0;
    std::size_t high = 1;
    while (high + 1 < stops.size() && stops[high].at < at) ++high;
    table[i] = mix(stops[high - 1], stops[high], at);
  }
  return table;
}

// Ticks of a level axis: round levels, at least `spacing` pixels apart.
struct LevelTicks {
  double step;
  std::vector<double> at_db;
};
LevelTicks level_ticks(const ColourScale& scale, double length, double spacing) {
  const double span = scale.max_db - scale.min_db;
  const double step = round_step(span * std::min(1.0, spacing / length));
  return {step, multiples(step, scale.min_db, scale.max_db)};
}

double along(const ColourScale& scale, double at_db, double from, double to) {
  return from + (to - from) * (at_db - scale.min_db) / (scale.max_db - scale.min_db);
}

/// Numbers of levels by steps of 5 dB, upper end included, and of those at the very lowest.
struct LevelCounts {
  static constexpr int steps = 4096;
  std::vector<std::size_t> count = std::vector<std::size_t>(2 * steps + 1, 0);
  float lowest = std::numeric_limits<float>::infinity();
  std::size_t finite = 0, at_lowest = 0;

  static std::size_t step_of(float level) {
    const double step = std::clamp(std::ceil(static_cast<double>(level) / 5), -1.0 * steps, 1.0 * steps);
    return static_cast<std::size_t>(static_cast<int>(step) + steps);
  }

  LevelCounts() = default;
  explicit LevelCounts(std::span<const float> levels) {
    for (const float level : levels) {
      if (!(std::abs(level) <= std::numeric_limits<float>::max())) continue;
      if (level < lowest) lowest = level, at_lowest = 0;
      at_lowest += level == lowest;
      ++count[step_of(level)], ++finite;
    }
  }
  void add(const LevelCounts& other) {
    if (other.lowest < lowest) lowest = other.lowest, at_lowest = 0;
    if (other.lowest == lowest) at_lowest += other.at_lowest;
    finite += other.finite;
    std::transform(count.begin(), count.end(), other.count.begin(), count.begin(), std::plus<>());
  }
};

}  // namespace

double automatic_max_db(const Grid<float>& level_db, double window_db) {
  constexpr std::size_t levels_at_once = 1 << 18;
  const auto size = static_cast<std::size_t>(level_db.size());
  std::vector<LevelCounts> parts((size + levels_at_once - 1) / levels_at_once);
  parallel_blocks(size, levels_at_once, 0, [&](std::size_t begin, std::size_t end) {
    parts[begin / levels_at_once] = LevelCounts({level_db.data() + begin, end - begin});
  });
  LevelCounts all;
  for (const LevelCounts& part : parts) all.add(part);
  if (all.finite == 0) return 0;
  if (all.finite == all.at_lowest) return 5.0 * std::ceil(static_cast<double>(all.lowest) / 5.0) + window_db;
  all.count[LevelCounts::step_of(all.lowest)] -= all.at_lowest;
  const auto rank = static_cast<std::size_t>(0.999 * static_cast<double>(all.finite - all.at_lowest - 1));
  std::size_t below = 0, step = 0;
  while ((below += all.count[step]) <= rank) ++step;
  return 5.0 * (static_cast<double>(step) - LevelCounts::steps);
}

std::vector<std::string> colour_map_names() {
  std::vector<std::string> names;
  for (const NamedMap& map : colour_maps()) names.emplace_back(map.name);
  return names;
}

ColourTable colour_table(const std::string& name, const char* who) {
  std::string names;
  for (const NamedMap& map : colour_maps()) {
    if (name == map.name) return expand(map.stops);
    names += (names.empty() ? "" : ", ") + std::string(map.name);
  }
  fail(ErrorKind::argument, who, ": options.colour_map = \"", name, "\", must be one of ", names);
}

std::size_t ColourScale::index(double level_db) const {
  const double step = 256.0 * (level_db - min_db) / (max_db - min_db);
  if (!(step > 0)) return 0;
  return static_cast<std::size_t>(std::min(step, 255.0));
}

ColourScale colour_scale(const Grid<float>& level_db, const PictureOptions& options, const char* who) {
  ColourScale scale{colour_table(options.colour_map, who), options.min_db, options.max_db};
  if (!(options.window_db > 0) || !std::isfinite(options.window_db))
    fail(ErrorKind::argument, who, ": options.window_db = ", options.window_db, " dB, must be > 0");
  if (std::isnan(scale.max_db))
    scale.max_db = std::isnan(scale.min_db)
                       ? automatic_max_db(level_db, options.window_db)
                       : std::max(automatic_max_db(level_db, options.window_db), scale.min_db + 5.0);
  if (std::isnan(scale.min_db)) scale.min_db = scale.max_db - options.window_db;
  if (!(scale.max_db > scale.min_db) || !std::isfinite(scale.max_db - scale.min_db))
    fail(ErrorKind::argument, who, ": options.max_db = ", scale.max_db,
         " dB, must be finite and exceed min_db = ", scale.min_db, " dB");
  return scale;
}

Box ColourBar::outer() const {
  Box all = bar;
  for (const PlacedText& text : texts) {
    const Box box = text.box();
    all = {std::min(all.left, box.left), std::max(all.right, box.right), std::min(all.bottom, box.bottom),
           std::max(all.top, box.top)};
  }
  return all;
}

ColourBar upright_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double right,
                             double bottom, double top) {
  const double tick = 0.4 * font_size;
  const LevelTicks ticks = level_ticks(scale, top - bottom, 2.6 * font_size);
  const FittedText title = fit_text(unit, font_size, top - bottom);
  double label_width = 0;
  for (const double db : ticks.at_db)
    label_width = std::max(label_width, text_size(number_text(db, ticks.step), font_size).width);

  // Place from the right: title, labels, ticks, bar.
  const double title_height = title.text.empty() ? 0 : text_size(title.text, title.font_size).height;
  const double labels_right = right - title_height - (title_height > 0 ? 0.4 * font_size : 0);
  const double bar_right = labels_right - label_width - 1.6 * tick;
  ColourBar placed;
  placed.bar = {bar_right - 1.5 * font_size, bar_right, bottom, top};
  for (const double db : ticks.at_db) {
    const double y = along(scale, db, bottom, top);
    const std::string label = number_text(db, ticks.step);
    placed.ticks.push_back({{bar_right, y}, {bar_right + tick, y}});
    placed.texts.push_back({label, {labels_right - text_size(label, font_size).width / 2, y}, font_size});
  }
  if (!title.text.empty())
    placed.texts.push_back({title.text, {right - title_height / 2, (bottom + top) / 2}, title.font_size, true});
  return placed;
}

void label_by_depths(ColourBar& bar) {
  for (PlacedText& text : bar.texts) {
    if (text.text.find_first_not_of("0123456789.-\u2212") != std::string::npos) continue;  // the title
    const bool zero = text.text.find_first_not_of("0.") == std::string::npos, negative = text.text[0] == '-';
    text = PlacedText(negative ? text.text.substr(1) : (zero ? "" : "-") + text.text, text.centre, text.font_size,
                      text.turned);
  }
}

ColourBar lying_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double left, double right,
                           double bottom) {
  const double tick = 0.4 * font_size, line = text_size("0", font_size).height;
  const LevelTicks ticks = level_ticks(scale, right - left, 4.5 * font_size);
  const FittedText title = fit_text(unit, font_size, right - left);

  // Place from below: title, labels, ticks, bar.
  const double labels_bottom = bottom + (title.text.empty() ? 0 : 1.15 * line);
  const double bar_bottom = labels_bottom + line + 1.4 * tick;
  ColourBar placed;
  placed.bar = {left, right, bar_bottom, bar_bottom + 1.3 * font_size};
  placed.lying = true;
  for (const double db : ticks.at_db) {
    const double x = along(scale, db, left, right);
    placed.ticks.push_back({{x, bar_bottom - tick}, {x, bar_bottom}});
    placed.texts.push_back({number_text(db, ticks.step), {x, labels_bottom + line / 2}, font_size});
  }
  if (!title.text.empty())
    placed.texts.push_back({title.text, {(left + right) / 2, bottom + line / 2}, title.font_size});
  return placed;
}

}  // namespace insonify
