// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid.hpp"
#include "core/units.hpp"

namespace insonify {

/// Returns the root mean square of the differences [dB] of cells within 40 dB of the strongest, each limited to 30, and
/// the fraction of differences above 10 dB.
inline std::pair<double, double> difference(const Grid<double>& level, const Grid<double>& exact) {
  const double least = 1e-4 * exact.maxCoeff();
  double squares = 0, cells = 0, far = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    if (exact.data()[i] < least) continue;
    const double off = std::clamp(db_from_power(std::max(1e-30, level.data()[i] / exact.data()[i])), -30.0, 30.0);
    squares += off * off, ++cells, far += std::abs(off) > 10;
  }
  return {std::sqrt(squares / cells), far / cells};
}

/// Returns the largest difference of a tenth of the ranges that holds a thousandth of the energy or more [dB].
inline double worst_band(const Grid<double>& level, const Grid<double>& exact) {
  double worst = 0;
  for (Eigen::Index k = 0; k < 10; ++k) {
    const Eigen::Index first = k * exact.cols() / 10, bins = (k + 1) * exact.cols() / 10 - first;
    const double energy = exact.middleCols(first, bins).sum();
    if (energy < 1e-3 * exact.sum()) continue;
    const double off = db_from_power(level.middleCols(first, bins).sum() / energy);
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  return worst;
}

}  // namespace insonify
