// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "core/grid.hpp"

namespace insonify {

/// Returns red, green and blue of a class in label pictures: 0 (nothing) black, 1 (shadow) dark blue, then materials in
/// the colours of pictures of scenes, which repeat after ten.
std::array<std::uint8_t, 3> label_colour(std::uint8_t category);

/// Returns classes, rows from the top, as the bytes of a PNG in their colours, for the file `path`. Throws
/// Error(argument) without classes, or unless `path` ends with .png.
std::string label_png(const std::string& path, const Grid<std::uint8_t>& category);

/// Writes such a PNG. Errors as save_grey_png.
void save_label_png(const std::string& path, const Grid<std::uint8_t>& category);

}  // namespace insonify
