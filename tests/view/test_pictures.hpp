#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "view/colour_maps_internal.hpp"
#include "view/picture.hpp"

namespace insonify::test {

/// An image of `beams` beams spread over `field_of_view_deg`, port first or starboard first, all at
/// `level_db`.
LevelImage flat_image(std::size_t beams, double field_of_view_deg, std::size_t bins, float level_db,
                      bool port_first = false);

/// A picture as read back from its PNG; the origin is the lower left corner.
struct ReadPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;

  Rgb at(double x, double y) const;  ///< of the pixel that holds (x, y), in pixels
};
ReadPicture read_png(const std::string& path);

/// Largest difference of two colours over their channels.
int colour_difference(const Rgb& a, const Rgb& b);

/// Centroid and number of the pixels of a colour within [left, right) x [bottom, top).
struct Blob {
  double x = 0, y = 0;
  int pixels = 0;
};
Blob find_colour(const ReadPicture& picture, const Rgb& colour, double left, double right, double bottom, double top);

/// A path in the test's own folder for temporary files.
std::string picture_path(const std::string& name);

std::string file_bytes(const std::string& path);
bool file_exists(const std::string& path);

}  // namespace insonify::test
