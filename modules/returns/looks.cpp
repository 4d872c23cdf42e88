// SPDX-License-Identifier: BSD-3-Clause
#include "returns/looks.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

Grid<float> mean_over_bins(const Grid<double>& intensity, int bins) {
  if (bins < 1) fail(ErrorKind::argument, "mean_over_bins: bins = ", bins, ", must be at least 1");
  Grid<float> mean(intensity.rows(), intensity.cols());
  for (Eigen::Index n = 0; n < intensity.cols(); ++n) {
    const Eigen::Index first = std::max<Eigen::Index>(0, n - (bins - 1) / 2);
    const Eigen::Index end = std::min<Eigen::Index>(intensity.cols(), n + bins / 2 + 1);
    mean.col(n) = intensity.middleCols(first, end - first).rowwise().mean().cast<float>();  // (E71)
  }
  return mean;
}

Grid<float> shown_level_db(const Ping& ping, double floor_db) {
  if (ping.intensity.size() == 0) return level_db(ping, floor_db);
  return ping.intensity.unaryExpr([&](float intensity) {
    return static_cast<float>(std::max(pressure_level_db(std::sqrt(static_cast<double>(intensity))), floor_db));
  });
}

}  // namespace insonify
