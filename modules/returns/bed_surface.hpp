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

  /// Between the middles of cells bilinear, beyond the outermost ones as at them.
  double at(double px, double py) const;
};

/// A level bed at this height.
BedSurface flat_bed(double height);

/// Sums points on a grid, to make a bed of them.
class BedPoints {
 public:
  /// A grid of cells that holds `low` to `high`. Throws Error(argument) unless cell > 0 and at most 2^26 cells do.
  BedPoints(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell);
  /// Adds a point of the world [m]; one outside the grid counts in the nearest cell.
  void add(const Eigen::Vector3d& point);
  /// The mean height of the points of each cell; of a cell without points that of the cells about it, which grow by
  /// factors of two until they hold some, bilinear between them. Throws Error(content) if no point was added.
  BedSurface surface() const;

 private:
  double x_, y_, cell_;
  Grid<double> sum_, count_;
};

}  // namespace insonify
