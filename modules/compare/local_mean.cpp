// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/local_mean_internal.hpp"

namespace insonify {
namespace {

// Returns sums over boxes along the columns of each row, by differences of running sums.
Grid<double> sums_along_rows(const Grid<double>& image, Eigen::Index half) {
  Grid<double> sums(image.rows(), image.cols());
  std::vector<double> running(static_cast<std::size_t>(image.cols()) + 1);
  for (Eigen::Index r = 0; r < image.rows(); ++r) {
    for (Eigen::Index c = 0; c < image.cols(); ++c)
      running[static_cast<std::size_t>(c) + 1] = running[static_cast<std::size_t>(c)] + image(r, c);
    for (Eigen::Index c = 0; c < image.cols(); ++c)
      sums(r, c) = running[static_cast<std::size_t>(std::min(image.cols(), c + half + 1))] -
                   running[static_cast<std::size_t>(std::max<Eigen::Index>(0, c - half))];
  }
  return sums;
}

Grid<double> box_sums(const Grid<double>& image, HalfWindow half) {
  const Grid<double> across = sums_along_rows(image, half.bins).transpose();
  return sums_along_rows(across, half.beams).transpose();
}

}  // namespace

Grid<double> local_mean(const Grid<double>& image, HalfWindow half) {
  const Grid<double> known = image.isNaN().select(Grid<double>::Zero(image.rows(), image.cols()),
                                                  Grid<double>::Ones(image.rows(), image.cols()));
  const Grid<double> values = (known > 0.5).select(image, 0.0);
  const Grid<double> count = box_sums(known, half);
  return (count > 0.5).select(box_sums(values, half) / count, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace insonify
