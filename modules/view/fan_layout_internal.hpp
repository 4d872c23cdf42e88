// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "view/colour_maps_internal.hpp"
#include "view/picture.hpp"

namespace insonify {

/// The sector of the plane that a fan fills: bearings [rad] positive to starboard, ranges [m].
struct FanOutline {
  double low = 0, high = 0;  ///< bearings
  double min_range = 0, max_range = 0;
  bool downwards = false;  ///< true: drawn with the apex at the top
};

/// Layout of a fan picture. Forward is up, or down if the head looks down, and starboard right: the flip of the head
/// axes (y to port) is made only here.
struct FanLayout {
  Point2 apex;  ///< position of the head
  double pixels_per_metre = 1;
  double low = 0, high = 0, min_range = 0, max_range = 0;
  bool downwards = false;
  std::vector<double> rings;   ///< [m]
  std::vector<double> spokes;  ///< bearings [rad]
  std::vector<PlacedText> texts;
  std::optional<PlacedText> title;
  ColourBar colour_bar;
  int font_size = 0;

  Point2 at(double bearing, double range) const;
  /// Returns the vector from the apex to a position, as in a picture with forward up [pixels].
  Point2 from_apex(Point2 position) const;
};

/// Returns the size of ordinary text for a picture of width x height pixels.
int font_size_for(int width, int height);

/// Returns options.font_size, or the size for the picture if that is 0.
int font_size_for(const PictureOptions& options);

/// Returns the width of thin lines beside text of that size [pixels].
double line_width_for(int font_size);

/// Returns the title, centred at the top of the picture and fitted to its width; none if it is empty.
std::optional<PlacedText> put_title(const PictureOptions& options);

/// Fits the fan and its labels into the picture as large as possible, with the colour bar at the right or below,
/// whichever leaves more space. Texts neither overlap nor leave the picture.
FanLayout lay_out_fan(const FanOutline& fan, const PictureOptions& options, const ColourScale& scale,
                      const std::string& unit);

/// Returns the options with the text size and the scale of the whole picture, and the least even width and height for
/// the fan, its labels, colour bar and title.
PictureOptions trimmed_to_fan(const FanOutline& fan, const PictureOptions& options, const ColourScale& scale,
                              const std::string& unit);

}  // namespace insonify
