// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

#include "core/grid.hpp"

namespace insonify {

/// A grey picture as stored in its file, rows from the top.
struct GreyPicture {
  int bits = 8;               ///< 8 or 16
  Grid<std::uint16_t> value;  ///< rows x columns
};

/// Returns the picture in a PNG of one channel of 8 or 16 bits. Throws Error(file) if the file cannot be read,
/// Error(content) if it is not a PNG, is truncated or damaged, or is in colours.
GreyPicture load_grey_png(const std::string& path);

/// Writes grey values as a PNG, rows from the top; 8 or 16 bits by their type. Written to a temporary name, then
/// renamed. Throws Error(argument) for an empty picture, Error(file) if it cannot write.
void save_grey_png(const std::string& path, const Grid<std::uint8_t>& grey);
/// Writes grey values of 16 bits in the same way.
void save_grey_png(const std::string& path, const Grid<std::uint16_t>& grey);

/// Writes colours in the same way: red x 65536 + green x 256 + blue, each from 0 to 255.
void save_rgb_png(const std::string& path, const Grid<std::uint32_t>& rgb);

}  // namespace insonify
