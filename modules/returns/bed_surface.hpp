// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"

namespace insonify {

/// Height of a bed over a horizontal grid: columns along x, rows along y, known everywhere.
struct BedSurface {
  double x = 0, y = 0;  ///< corner of cell (0, 0) [m]
  double cell = 1;      ///< size [m]
  Grid<float> height;   ///< z at the middles of the cells [m]

  /// Returns z at (px, py) [m]: bilinear between the middles of cells, and constant beyond the outermost middles.
  double at(double px, double py) const;
};

/// Returns a level bed at z = `height` [m].
BedSurface flat_bed(double height);

/// Makes a bed from points, as means over the cells of a grid.
class BedPoints {
 public:
  /// Sets up a grid of cells of size `cell` from `low` to `high` [m]. Throws Error(argument) unless cell > 0 and the
  /// grid has at most 2^26 cells.
  BedPoints(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell);
  /// Adds a point [m, world]. A point outside the grid is added to the nearest cell.
  void add(const Eigen::Vector3d& point);
  /// Returns the mean height of the points in each cell [m]. For a cell without points, larger cells around it are
  /// used: their size doubles until they contain points, and the heights are interpolated bilinearly between them.
  /// Throws Error(content) if no point was added.
  BedSurface surface() const;

 private:
  double x_, y_, cell_;
  Grid<double> sum_, count_;
};

}  // namespace insonify
