// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace insonify {

/// Returns Spearman's rank correlation: that of the ranks, equal numbers sharing their mean rank (E122). NaN if one
/// list is constant. Throws Error(argument) unless both have the same length of two at least.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// Differences between predicted and measured levels at points.
struct PointComparison {
  std::size_t points = 0;
  double bias_db = 0, deviation_db = 0;     ///< mean and deviation of predicted - measured
  double predicted_slope_db = 0;            ///< slope per decade of range
  double measured_slope_db = 0;             ///< slope per decade of range
  double rank = 0, rank_without_trend = 0;  ///< correlation before and after removing both lines of log10(range)
  double deviation_without_trend_db = 0;    ///< deviation of the difference after removing them
  double far_below = 0;  ///< fraction of points predicted more than 20 dB below the median about the line
  double ceiling = 0, ceiling_without_trend = 0;  ///< for one-look speckle about the prediction itself (E122)
};

/// Compares levels point by point; `seed` draws the ceiling. Throws Error(argument) unless all lists have the same
/// length of three at least, all numbers are finite and ranges > 0.
PointComparison compare_points(const std::vector<double>& predicted_db, const std::vector<double>& measured_db,
                               const std::vector<double>& range, std::uint64_t seed);

/// Returns the levels less their line over log10(range).
std::vector<double> without_range_trend(const std::vector<double>& level_db, const std::vector<double>& range);

}  // namespace insonify
