// SPDX-License-Identifier: BSD-3-Clause
#include "compare/swath_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double deviations_within_95 = 1.959963985;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Sums over numbers: how many, mean, and squares of their differences from the mean.
struct RunningMoments {
  void add(double value) {
    ++count;
    const double before = value - mean;
    mean += before / static_cast<double>(count);
    squares += before * (value - mean);
  }
  double deviation() const { return count < 2 ? not_known : std::sqrt(squares / static_cast<double>(count - 1)); }

  std::size_t count = 0;
  double mean = 0, squares = 0;
};

using BandNumber = std::int64_t;

struct BandSums {
  std::size_t soundings = 0;
  double intensity = 0;
  RunningMoments levels;
};

std::map<BandNumber, BandSums> bands_of_swath(const SwathPoints& points, double width) {
  std::map<BandNumber, BandSums> bands;
  for (std::size_t i = 0; i < points.angle.size(); ++i) {
    BandSums& band = bands[static_cast<BandNumber>(std::floor(points.angle[i] / width))];
    ++band.soundings;
    if (std::isnan(points.level_db[i])) continue;
    band.intensity += std::pow(10, points.level_db[i] / 10), band.levels.add(points.level_db[i]);
  }
  return bands;
}

SwathBand band_from(const std::map<BandNumber, BandSums>& bands, BandNumber number, std::size_t pings, double width) {
  const auto found = bands.find(number);
  if (found == bands.end()) return {0, 0, not_known, not_known};
  const BandSums& sums = found->second;  // (E212)
  return {sums.soundings,
          static_cast<double>(sums.soundings) / (static_cast<double>(std::max<std::size_t>(pings, 1)) * degrees(width)),
          sums.levels.count == 0 ? not_known : 10 * std::log10(sums.intensity / static_cast<double>(sums.levels.count)),
          sums.levels.deviation()};
}

using SwathCell = std::pair<std::int64_t, std::int64_t>;  ///< row and column

/// Heights of the soundings in a cell.
struct CellHeights {
  RunningMoments height;
  double variance = 0;       ///< sum of the squares of stated deviations [m^2]
  std::size_t unstated = 0;  ///< number of soundings that state no deviation

  /// Returns the variance of the mean height [m^2].
  double variance_of_mean() const {
    const auto count = static_cast<double>(height.count);
    const double of_sample =
        unstated == 0 ? 0 : height.deviation() * height.deviation() * static_cast<double>(unstated);
    return (variance + of_sample) / (count * count);  // (E213)
  }
};

std::map<SwathCell, CellHeights> cells_of_swath(const SwathPoints& points, double size) {
  std::map<SwathCell, CellHeights> cells;
  for (std::size_t i = 0; i < points.position.size(); ++i) {
    const Eigen::Vector3d& at = points.position[i];
    CellHeights& cell = cells[{static_cast<std::int64_t>(std::floor(at.y() / size)),
                               static_cast<std::int64_t>(std::floor(at.x() / size))}];
    cell.height.add(at.z());
    if (std::isnan(points.deviation[i]))
      ++cell.unstated;
    else
      cell.variance += points.deviation[i] * points.deviation[i];
  }
  return cells;
}

/// A difference of a cell and its predicted deviation [m].
struct CellDifference {
  double difference = 0, predicted = 0;
};

std::vector<CellDifference> differences_of_cells(const std::map<SwathCell, CellHeights>& a,
                                                 const std::map<SwathCell, CellHeights>& b) {
  std::vector<CellDifference> differences;
  for (const auto& [cell, of_a] : a) {
    const auto found = b.find(cell);
    if (found == b.end() || of_a.height.count < 2 || found->second.height.count < 2) continue;
    differences.push_back({of_a.height.mean - found->second.height.mean,
                           std::sqrt(of_a.variance_of_mean() + found->second.variance_of_mean())});
  }
  return differences;
}

}  // namespace

std::vector<SwathAngleBand> compare_by_angle(const SwathPoints& a, const SwathPoints& b, double width) {
  if (!(width > 0)) fail(ErrorKind::argument, "compare_by_angle: width = ", width, " rad, must be > 0");
  const auto of_a = bands_of_swath(a, width), of_b = bands_of_swath(b, width);
  std::map<BandNumber, BandSums> either = of_a;
  either.insert(of_b.begin(), of_b.end());
  std::vector<SwathAngleBand> bands;
  for (const auto& [number, sums] : either)
    bands.push_back({static_cast<double>(number) * width, static_cast<double>(number + 1) * width,
                     band_from(of_a, number, a.pings, width), band_from(of_b, number, b.pings, width)});
  return bands;
}

SwathCellComparison compare_swath_cells(const SwathPoints& a, const SwathPoints& b, double cell) {
  if (!(cell > 0)) fail(ErrorKind::argument, "compare_swath_cells: cell = ", cell, " m, must be > 0");
  const auto of_a = cells_of_swath(a, cell), of_b = cells_of_swath(b, cell);
  const std::vector<CellDifference> differences = differences_of_cells(of_a, of_b);
  SwathCellComparison result{differences.size(), of_a.size(), of_b.size()};
  RunningMoments moments, normalised;
  double predicted = 0, within = 0;
  for (const CellDifference& d : differences) {
    moments.add(d.difference), predicted += d.predicted * d.predicted;
    result.largest = std::max(result.largest, std::abs(d.difference));
  }
  for (const CellDifference& d : differences) {
    const double off = d.difference - moments.mean;
    if (d.predicted > 0) normalised.add(off / d.predicted);
    within += std::abs(off) <= deviations_within_95 * d.predicted ? 1 : 0;
  }
  const double count = differences.empty() ? not_known : static_cast<double>(differences.size());
  result.bias = differences.empty() ? not_known : moments.mean;
  result.deviation = moments.deviation(), result.predicted = std::sqrt(predicted / count);
  result.normalised = normalised.deviation(), result.within_95 = within / count;
  if (differences.empty()) result.largest = not_known;
  return result;
}

}  // namespace insonify
