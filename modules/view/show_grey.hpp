#pragma once
#include <cstdint>
#include <string>

#include "core/grid.hpp"
#include "sampling/beam_fan.hpp"

namespace insonify {

/// Writes grey values (beams x bins) as a bare picture, one pixel each and nothing else: a column per beam by bearing,
/// starboard right, range upwards (the first row of the file is the farthest bin), as show_rect. Beams of equal azimuth
/// stand side by side in the order of the fan. PNG or PGM (P5) by the path's ending, .png or .pgm, 8 or 16 bits by the
/// type of the values. Throws Error(argument) for another ending, an empty picture, or one of another size than its fan;
/// Error(file) if it cannot be written.
void show_grey(const Grid<std::uint8_t>& grey, const BeamFan& fan, const std::string& path);
void show_grey(const Grid<std::uint16_t>& grey, const BeamFan& fan, const std::string& path);

}  // namespace insonify
