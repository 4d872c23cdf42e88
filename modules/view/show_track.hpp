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
  /// The track of a head.
  struct HeadTrack {
    std::string name;
    std::vector<Eigen::Vector2d> positions;  ///< positions of the pings, x, y [m]
    std::vector<Eigen::Vector2d> ahead;  ///< horizontal part of the head's unit vector ahead, of length 1 when level
  };
  std::vector<HeadTrack> tracks;
  double x = 0, y = 0, cell = 1;  ///< corner of cell (0, 0) of the levels, and size of the cells [m]
  Grid<float> level_db;           ///< columns along x, rows along y; NaN or -inf: nothing; empty: none
  std::string unit;               ///< unit of the colour bar
};

/// Draws levels and tracks to one scale, x to the right and y up, into a PNG without an X server. Each track is a line
/// with its name at the beginning, a ring at the end, and some 20 short strokes in the direction of the head. Files and
/// errors as show_fan; also Error(argument) if there is no position at all, or a cell that is not > 0.
void show_track(const TrackMap& map, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
