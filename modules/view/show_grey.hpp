#pragma once
#include <cstdint>
#include <string>

#include "core/grid.hpp"
#include "sampling/beam_fan.hpp"

namespace insonify {

/// Writes grey values (beams x bins) as a picture of one pixel per sample: a column per beam ordered by bearing,
/// starboard right, range upwards (the first row of the file is the farthest bin), as show_rect. Beams of equal azimuth
/// are adjacent in the order of the fan. The extension selects PNG or PGM (P5), .png or .pgm; the type of the values 8
/// or 16 bits. Throws Error(argument) for another extension, an empty picture, or a number of beams that is not the
/// fan's; Error(file) if it cannot write.
void show_grey(const Grid<std::uint8_t>& grey, const BeamFan& fan, const std::string& path);
void show_grey(const Grid<std::uint16_t>& grey, const BeamFan& fan, const std::string& path);

}  // namespace insonify
