#pragma once
#include <string>

#include "returns/bed_surface.hpp"

namespace insonify {

/// The bed on which returns stand: mean height of those in each cell of a grid, with gaps filled (BedPoints). `path` is
/// a .ply that save_soundings, save_survey_returns or join_clouds wrote. Reads it twice, a few MB at a time, so that
/// memory is that of the grid. Throws as BedPoints; Error(file) if the file is missing, Error(content) if it holds no
/// returns.
BedSurface bed_of_returns(const std::string& path, double cell);

}  // namespace insonify
