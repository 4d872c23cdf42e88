// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "view/picture.hpp"
#include "view/placed_text.hpp"

namespace insonify {

using Rgb = std::array<std::uint8_t, 3>;
using ColourTable = std::array<Rgb, 256>;

/// Returns the 256 entries of a named map, lowest level first. Throws Error(argument) that lists the names.
ColourTable colour_table(const std::string& name, const char* who);

/// Maps levels to colours in 256 equal steps from min_db to max_db; levels outside get the first or last colour, NaN
/// the first.
struct ColourScale {
  ColourTable table;
  double min_db = 0;
  double max_db = 1;

  std::size_t index(double level_db) const;
  Rgb colour(double level_db) const { return table[index(level_db)]; }
};

/// Returns the 99.9 % quantile of the levels above the lowest one (that of empty samples), rounded up to 5 dB. If all
/// levels are equal, returns a value that maps them to the lowest colour.
double automatic_max_db(const Grid<float>& level_db, double window_db);

/// Returns the next multiple of 5 dB above a level, where the axis of a chart ends.
inline double next_five(double level_db) { return 5 * std::floor(level_db / 5) + 5; }

/// Returns the scale of an image, with the automatic maximum unless one is given. Throws Error(argument) for an unknown
/// map, a window that is not positive, or max_db <= min_db.
ColourScale colour_scale(const Grid<float>& level_db, const PictureOptions& options, const char* who);

/// Layout of a colour bar, its ticks and texts: vertical with labels on the right, or horizontal with labels below.
struct ColourBar {
  Box bar;
  bool lying = false;
  std::vector<Path> ticks;
  std::vector<PlacedText> texts;  ///< labels, and the unit as title

  Box outer() const;  ///< bounding box of bar, ticks and texts
};

/// Returns a vertical bar from `bottom` to `top` whose outer box ends at `right`.
ColourBar upright_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double right,
                             double bottom, double top);

/// Labels a bar whose scale counts heights by depths: its numbers change their signs.
void label_by_depths(ColourBar& bar);

/// Returns a horizontal bar from `left` to `right` whose outer box begins at `bottom`.
ColourBar lying_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double left, double right,
                           double bottom);

}  // namespace insonify
