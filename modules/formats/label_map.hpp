// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// Category and object of every pixel of a picture, rows from the top.
struct LabelMap {
  Grid<std::uint8_t> category;   ///< 0: nothing
  Grid<std::uint16_t> instance;  ///< number of the object, from 1; 0: no object
};

/// An object in a picture, in the terms of COCO.
struct Annotation {
  std::uint16_t instance = 0;
  std::uint8_t category = 0;
  std::size_t area = 0;                          ///< [pixels]
  int left = 0, top = 0, width = 0, height = 0;  ///< box of the object [pixels]
  std::vector<std::uint32_t>
      counts;  ///< run lengths of the mask, column by column, beginning with pixels outside the object
};

/// Returns the objects that have a pixel in the picture, by ascending instance. The category of an object is that of
/// most of its pixels, of equals the lowest. Throws Error(argument) if the maps differ in size.
std::vector<Annotation> annotations_of(const LabelMap& map);

/// Returns the outlines of an object in a picture, one for each part that is connected along sides of pixels. An
/// outline lists corners x, y, x, y, ... [pixels from the upper left corner of the picture], clockwise as seen, along
/// the sides of pixels. Holes are left out, because a polygon of COCO has none.
std::vector<std::vector<int>> outlines_of(const Grid<std::uint16_t>& instance, std::uint16_t number);

}  // namespace insonify
