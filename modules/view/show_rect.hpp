#pragma once
#include <string>

#include "view/picture.hpp"

namespace insonify {

/// Draws beams x range as a rectangle: bearing (positive to starboard, on the right) across, range upwards,
/// axes with units, colour bar, title. Files and errors as show_fan.
void show_rect(const LevelImage& image, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
