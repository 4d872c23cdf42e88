// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "core/grid.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Statistics of an image in a band of range.
struct RangeBand {
  double from = 0, to = 0;        ///< [m]
  std::size_t pixels = 0;         ///< number of pixels with a level; below 100 the other numbers are 0
  double mean_level_db = 0;       ///< level of the mean intensity
  double amplitude_contrast = 0;  ///< see SpeckleStatistics
  double deviation_db = 0;
  double width_beams = 0, width_bins = 0;  ///< CorrelationWidths of the response
};

/// Returns statistics (E123) of equal bands of the gate. Levels [dB] of beams (or pings) x bins; NaN: none. Throws
/// Error(argument) unless there are as many bins as the gate has, and at least one band of as many bins at most.
std::vector<RangeBand> range_bands(const Grid<float>& level_db, const RangeGate& gate, std::size_t bands = 5);

}  // namespace insonify
