// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "formats/label_map.hpp"

namespace insonify::tool {

/// Some images of a data set with the boxes of their objects, on one page: 16 at most, evenly from all that are added.
class ContactSheet {
 public:
  /// Adds an image, rows from the top, with its objects.
  void add(const Grid<std::uint8_t>& image, const std::vector<Annotation>& objects);
  /// Writes the page as a PNG, four images in a row, boxes in the colours of their classes (label_colour). Writes
  /// nothing if no image was added. Throws Error(file) if it cannot write.
  void save(const std::string& path) const;

 private:
  std::vector<Grid<std::uint32_t>> kept_;  ///< pixels of kept images, as red x 65536 + green x 256 + blue
  std::size_t added_ = 0, every_ = 1;      ///< one in so many is kept
};

}  // namespace insonify::tool
