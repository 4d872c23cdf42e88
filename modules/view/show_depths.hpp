// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "view/picture.hpp"

namespace insonify {

/// Depths of a bed from above.
struct DepthMap {
  double x = 0, y = 0, cell = 1;          ///< corner of cell (0, 0), and size of the cells [m]
  Grid<float> height;                     ///< columns along x, rows along y, positive up [m]; NaN: nothing
  std::vector<Eigen::Vector2d> rejected;  ///< places of rejected soundings, x, y [m]
  std::string datum;                      ///< place that depths count from, as the scale says it: "below MSL"
  std::string x_title = "x [m]", y_title = "y [m]";
};

/// Draws depths as a shaded relief (E218), to one scale, x to the right and y up, into a PNG without an X server. The
/// scale beside it has depths, positive down and shallow at the top; contours are at its round values, every second one
/// with its depth; each rejected sounding is a cross. Files and errors as show_fan; also Error(argument) if no cell has
/// a height, or for a cell that is not > 0. options.min_db and max_db do not count.
void show_depths(const DepthMap& map, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
