#pragma once
#include <cstdint>
#include <string>

#include "core/grid.hpp"

namespace insonify {

/// Returns of a survey on a horizontal grid: columns along x, rows along y, cells aligned to multiples of their size.
struct ReturnsMosaic {
  double x = 0, y = 0;   ///< corner of cell (0, 0) [m]
  double cell = 0;       ///< size [m]
  Grid<float> level_db;  ///< of the mean intensity of the returns of a cell [dB re 1 uPa at 1 m]; NaN: none
  Grid<float> returns;   ///< how many
};

/// Lays the returns of a .ply that save_soundings, save_survey_returns or join_clouds wrote on a grid. Each counts with
/// the intensity of its level_db + 30 log10(range): spreading both ways less the growth of a bottom's area, without
/// absorption. Reads the file twice, a few MB at a time, so that memory is that of the grid. Throws Error(argument)
/// unless cell > 0 and gives at most 2^26 cells, Error(file) if the file is missing, Error(content) if it holds no
/// returns or lacks a column.
ReturnsMosaic mosaic_of_returns(const std::string& path, double cell);

}  // namespace insonify
