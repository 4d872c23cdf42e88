// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// The soundings of a swath, as arrays of one length.
struct SwathPoints {
  std::size_t pings = 0;                  ///< number of pings that made them
  std::vector<Eigen::Vector3d> position;  ///< [m], z up
  std::vector<double> angle;              ///< angle from straight down [rad], positive to starboard
  std::vector<double> level_db;           ///< NaN: not known
  std::vector<double> deviation;          ///< predicted standard deviation of z [m]; NaN: not known
};

/// Statistics of a swath within a band of angles.
struct SwathBand {
  std::size_t soundings = 0;
  double per_ping = 0;      ///< soundings for each ping and degree: the coverage
  double level_db = 0;      ///< level of the mean intensity; NaN without levels
  double deviation_db = 0;  ///< standard deviation of levels; NaN with fewer than two
};

/// Two swaths within a band of angles.
struct SwathAngleBand {
  double from = 0, to = 0;  ///< [rad]
  SwathBand a, b;
};

/// Returns what two swaths are like in bands of angles of this width [rad], from port to starboard (E212): coverage,
/// level and deviation. Bands without soundings of either are left out. Throws Error(argument) unless width > 0.
std::vector<SwathAngleBand> compare_by_angle(const SwathPoints& a, const SwathPoints& b, double width);

/// Differences of mean heights, A less B, in cells that hold at least two soundings of each.
struct SwathCellComparison {
  std::size_t cells = 0;                 ///< number of cells compared
  std::size_t cells_a = 0, cells_b = 0;  ///< numbers of cells that hold soundings of each
  double bias = 0;                       ///< mean difference [m]
  double deviation = 0;                  ///< standard deviation of differences [m]; NaN of one cell
  double predicted = 0;                  ///< rms of the predicted standard deviations of the differences [m]
  double normalised = 0;  ///< standard deviation of differences over predictions, less the bias; 1: as predicted
  double within_95 = 0;   ///< share of differences less the bias within 1.96 predicted deviations
  double largest = 0;     ///< largest difference [m], without its sign
};

/// Compares two swaths in cells of a horizontal grid [m] (E213). The prediction of a cell's mean height is that of
/// independent soundings: sqrt(sum of squares of their deviations) / n, with the sample's own deviation for soundings
/// that state none. Without a common cell `cells` is 0 and all else is NaN. Throws Error(argument) unless cell > 0.
SwathCellComparison compare_swath_cells(const SwathPoints& a, const SwathPoints& b, double cell);

}  // namespace insonify
