// SPDX-License-Identifier: BSD-3-Clause
#include "returns/bed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace insonify {
namespace {

/// Returns the value at a position, bilinear between the middles of cells and constant beyond the outermost. Columns
/// and rows count from the corner of the first cell.
template <typename Cells>
double bilinear(const Cells& cells, double column, double row) {
  const auto position = [](double at, Eigen::Index size) {
    const double inside = std::clamp(at - 0.5, 0.0, static_cast<double>(size - 1));
    const auto first = std::min(static_cast<Eigen::Index>(inside), std::max<Eigen::Index>(0, size - 2));
    return std::pair(first, inside - static_cast<double>(first));
  };
  const auto [i, u] = position(column, cells.rows());
  const auto [j, v] = position(row, cells.cols());
  const auto value = [&](Eigen::Index a, Eigen::Index b) {
    return static_cast<double>(cells(std::min(a, cells.rows() - 1), std::min(b, cells.cols() - 1)));
  };
  return (1 - u) * ((1 - v) * value(i, j) + v * value(i, j + 1)) +
         u * ((1 - v) * value(i + 1, j) + v * value(i + 1, j + 1));
}

/// Returns the means of the cells. An empty cell gets its value from a grid with cells twice as large.
Grid<double> filled_means(const Grid<double>& sum, const Grid<double>& count) {
  if ((count > 0).all()) return sum / count;
  const Eigen::Index columns = (count.rows() + 1) / 2, rows = (count.cols() + 1) / 2;
  Grid<double> coarse_sum = Grid<double>::Zero(columns, rows), coarse_count = coarse_sum;
  for (Eigen::Index i = 0; i < count.rows(); ++i)
    for (Eigen::Index j = 0; j < count.cols(); ++j) {
      coarse_sum(i / 2, j / 2) += sum(i, j);
      coarse_count(i / 2, j / 2) += count(i, j);
    }
  const Grid<double> coarse = filled_means(coarse_sum, coarse_count);
  Grid<double> mean(count.rows(), count.cols());
  for (Eigen::Index i = 0; i < count.rows(); ++i)
    for (Eigen::Index j = 0; j < count.cols(); ++j)
      mean(i, j) = count(i, j) > 0
                       ? sum(i, j) / count(i, j)
                       : bilinear(coarse, (static_cast<double>(i) + 0.5) / 2, (static_cast<double>(j) + 0.5) / 2);
  return mean;
}

}  // namespace

double BedSurface::at(double px, double py) const { return bilinear(height, (px - x) / cell, (py - y) / cell); }

BedSurface flat_bed(double height) { return {0, 0, 1, Grid<float>::Constant(1, 1, static_cast<float>(height))}; }

BedPoints::BedPoints(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell) : cell_(cell) {
  if (!(cell > 0 && std::isfinite(cell)))
    fail(ErrorKind::argument, "BedPoints: cell = ", cell, " m, must be finite and > 0");
  const Eigen::Array2d first = (low.array() / cell).floor(), cells = (high.array() / cell).floor() - first + 1;
  if (!(cells.minCoeff() >= 1 && cells.prod() <= 0x1p26))
    fail(ErrorKind::argument, "BedPoints: cell = ", cell, " m makes ", cells.x(), " x ", cells.y(),
         " cells, must be at least 1 and at most 2^26");
  x_ = first.x() * cell;
  y_ = first.y() * cell;
  sum_ = count_ = Grid<double>::Zero(static_cast<Eigen::Index>(cells.x()), static_cast<Eigen::Index>(cells.y()));
}

void BedPoints::add(const Eigen::Vector3d& point) {
  const auto index = [&](double at, double from, Eigen::Index size) {
    return std::clamp(static_cast<Eigen::Index>(std::floor((at - from) / cell_)), Eigen::Index{0}, size - 1);
  };
  const Eigen::Index i = index(point.x(), x_, sum_.rows()), j = index(point.y(), y_, sum_.cols());
  sum_(i, j) += point.z();
  count_(i, j) += 1;
}

BedSurface BedPoints::surface() const {
  if (!(count_ > 0).any()) fail(ErrorKind::content, "BedPoints: no points, must be at least one");
  return {x_, y_, cell_, filled_means(sum_, count_).cast<float>()};
}

}  // namespace insonify
