#pragma once
#include <string>
#include <vector>

#include "view/colour_maps_internal.hpp"
#include "view/placed_text.hpp"

namespace insonify {

/// Where a colour bar, its ticks and its texts go: upright with labels on the right, or lying with labels
/// below.
struct ColourBar {
  Box bar;
  bool lying = false;
  std::vector<Path> ticks;
  std::vector<PlacedText> texts;  ///< labels, and the unit as title

  Box outer() const;  ///< the bar and everything around it
};

/// Upright bar whose outer box ends at `right` and whose bar reaches from `bottom` to `top`.
ColourBar upright_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double right,
                             double bottom, double top);

/// Lying bar from `left` to `right` whose outer box stands on `bottom`.
ColourBar lying_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double left, double right,
                           double bottom);

}  // namespace insonify
