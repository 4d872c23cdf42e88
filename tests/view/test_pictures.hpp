// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "support/test.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/picture.hpp"

namespace insonify {

/// Returns an image of `beams` beams spread over `field_of_view_deg`, port or starboard first, all at `level_db`.
LevelImage flat_image(std::size_t beams, double field_of_view_deg, std::size_t bins, float level_db,
                      bool port_first = false);

/// Draws without a screen, into a file of its own.
class PictureTest : public testing::Test {
 protected:
  PictureTest() {
    unsetenv("DISPLAY");
    options.width = 800, options.height = 600;
  }

  PictureOptions options;
  std::string path = own_path("picture.png");
};

/// Draws in colours over 0 to 100 dB.
class JetPictureTest : public PictureTest {
 protected:
  JetPictureTest() { options.colour_map = "jet", options.min_db = 0, options.max_db = 100; }
};

/// A picture as read back from its PNG; the origin is the lower left corner.
struct ReadPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;

  Rgb at(double x, double y) const;  ///< colour of the pixel that holds (x, y), in pixels
};
ReadPicture read_png(const std::string& path);

/// Returns the largest difference of two colours over their channels.
int colour_difference(const Rgb& a, const Rgb& b);

/// Centroid and number of the pixels of a colour within [left, right) x [bottom, top).
struct Blob {
  double x = 0, y = 0;
  int pixels = 0;
};
Blob find_colour(const ReadPicture& picture, const Rgb& colour, double left, double right, double bottom, double top);

/// Returns the mean height of the blue line between two fractions of a chart's width, in pixels; -1 without a line.
double line_height(const ReadPicture& picture, double from, double to);

}  // namespace insonify
