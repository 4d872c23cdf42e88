#pragma once
#include <string>
#include <vector>

#include "view/colour_maps_internal.hpp"
#include "view/placed_text.hpp"

namespace insonify {

/// Layout of a colour bar, its ticks and texts: vertical with labels on the right, or horizontal with labels below.
struct ColourBar {
  Box bar;
  bool lying = false;
  std::vector<Path> ticks;
  std::vector<PlacedText> texts;  ///< labels, and the unit as title

  Box outer() const;  ///< bounding box of bar, ticks and texts
};

/// A vertical bar from `bottom` to `top` whose outer box ends at `right`.
ColourBar upright_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double right,
                             double bottom, double top);

/// A horizontal bar from `left` to `right` whose outer box begins at `bottom`.
ColourBar lying_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double left, double right,
                           double bottom);

}  // namespace insonify
