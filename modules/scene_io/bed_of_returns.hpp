// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "returns/bed_surface.hpp"

namespace insonify {

/// Returns the bed under returns: the mean height of the returns in each cell of size `cell` [m], with gaps filled
/// (BedPoints). Returns without a surfel (false alarms) are left out. `path` is a .ply that save_soundings,
/// save_survey_returns or join_clouds wrote. The file is read twice, a few MB at a time, so memory holds little more
/// than the grid. Throws as BedPoints; Error(file) if the file is missing, Error(content) if it holds no returns.
BedSurface bed_of_returns(const std::string& path, double cell);

/// Returns on a horizontal grid: columns along x, rows along y.
struct ReturnsMap {
  double x = 0, y = 0, cell = 1;  ///< corner of cell (0, 0); size of a cell [m]
  Grid<float> level_db;           ///< highest level + 40 log10(range) in a cell [dB re 1 uPa at 1 m]; NaN: no return
};

/// Returns a map of the returns in such a file on a grid with `cells` cells along its longer side. Memory and errors
/// are those of bed_of_returns.
ReturnsMap map_of_returns(const std::string& path, int cells);

}  // namespace insonify
