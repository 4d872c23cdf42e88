// SPDX-License-Identifier: BSD-3-Clause
#include "returns/looks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// The bins that a display cell overlaps, with the areas that they share [m^2], and all of these.
struct CellBins {
  std::size_t begin = 0;
  std::vector<double> share;
  double area = 0;

  double mean(const double* beam) const {
    double sum = 0;
    for (std::size_t k = 0; k < share.size(); ++k) sum += share[k] * beam[begin + k];
    return area > 0 ? sum / area : sum;
  }
};

std::vector<CellBins> bins_of_cells(const RangeGate& samples, const RangeGate& cells) {
  std::vector<CellBins> all(cells.bins());
  for (std::size_t c = 0; c < all.size(); ++c) {
    const double first = cells.min_range + static_cast<double>(c) * cells.bin_size, last = first + cells.bin_size;
    const auto bin_at = [&](double range) { return (range - samples.min_range) / samples.bin_size; };
    all[c].begin = static_cast<std::size_t>(std::max(0.0, std::floor(bin_at(first))));
    const auto end = std::min(samples.bins(), static_cast<std::size_t>(std::ceil(bin_at(last))));
    for (std::size_t n = all[c].begin; n < end; ++n) {
      const double low = std::max(first, samples.min_range + static_cast<double>(n) * samples.bin_size);
      const double high = std::min(last, samples.min_range + static_cast<double>(n + 1) * samples.bin_size);
      all[c].share.push_back(std::max(0.0, high * high - low * low));
      all[c].area += all[c].share.back();
    }
  }
  return all;
}

}  // namespace

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

RangeGate display_gate(const RangeGate& gate, int count) {
  return {gate.min_range, gate.max_range, (gate.max_range - gate.min_range) / count};
}

Grid<double> mean_over_cells(const Grid<double>& intensity, const RangeGate& samples, const RangeGate& cells) {
  if (static_cast<std::size_t>(intensity.cols()) != samples.bins())
    fail(ErrorKind::argument, "mean_over_cells: intensity has ", intensity.cols(), " bins, must have ", samples.bins());
  const std::vector<CellBins> bins = bins_of_cells(samples, cells);
  Grid<double> mean(intensity.rows(), static_cast<Eigen::Index>(bins.size()));
  for (Eigen::Index b = 0; b < mean.rows(); ++b)
    for (std::size_t c = 0; c < bins.size(); ++c)
      mean(b, static_cast<Eigen::Index>(c)) = bins[c].mean(&intensity(b, 0));
  return mean;
}

Grid<float> shown_level_db(const Ping& ping, double floor_db) {
  if (ping.intensity.size() == 0) return level_db(ping, floor_db);
  return ping.intensity.unaryExpr([&](float intensity) {
    return static_cast<float>(std::max(pressure_level_db(std::sqrt(static_cast<double>(intensity))), floor_db));
  });
}

}  // namespace insonify
