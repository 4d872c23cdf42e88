#pragma once
#include <cstddef>
#include <string>

#include "view/picture.hpp"

namespace insonify {

/// Draws the level of one beam against range as a chart with units; the title begins with beam and bearing.
/// min_db and max_db limit the level axis; an automatic max_db is the next multiple of 5 dB above the beam's
/// highest level. Files and errors as show_fan; also Error(argument) unless beam < beams.
void show_ascan(const LevelImage& image, std::size_t beam, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
