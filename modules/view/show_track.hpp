// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "view/picture.hpp"

namespace insonify {

/// A survey from above.
struct TrackMap {
  /// The way of a head.
  struct Way {
    std::string name;
    std::vector<Eigen::Vector2d> places;  ///< x, y of each ping [m]
    std::vector<Eigen::Vector2d> ahead;   ///< horizontal part of where it looked, as long as it is level
  };
  std::vector<Way> ways;
  double x = 0, y = 0, cell = 1;  ///< corner of cell (0, 0) of the levels, and size of the cells [m]
  Grid<float> level_db;           ///< columns along x, rows along y; NaN or -inf: nothing; empty: none
  std::string unit;               ///< of the colour bar
};

/// Draws levels and ways to one scale, x to the right and y up, into a PNG without an X server: each way as a line with
/// its name where it begins, a ring where it ends, and some 20 short strokes in the direction of the head. Files and
/// errors as show_fan; also Error(argument) if there is no place at all, or a cell that is not > 0.
void show_track(const TrackMap& map, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
