// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "core/grid.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Definition of a shadow.
struct ShadowOptions {
  double below_db = 10;  ///< least level of the bed above a shadow at its range
  double least = 0.5;    ///< shortest shadow [m of slant range]
  double along = 5;      ///< slant range on either side over which the bed is smooth [m]
};

/// The bed and the shadows of one side of a side-scan.
struct SideScanStatistics {
  std::vector<std::optional<double>> first_return{};  ///< first return of each ping [m] (E135)
  double shadow_share = 0;                            ///< fraction of the samples of the bed
  double longest_shadow = 0, longest_from = 0;        ///< slant range: length and begin of the longest shadow [m]
  std::size_t longest_ping = 0;                       ///< row of the longest shadow
  double shadow_depth_db = 0;                         ///< mean intensity of the bed over that of its shadows
};

/// Measures levels [dB], pings x bins; NaN: not measured. The bed begins at the first return of each ping; a shadow is
/// a run of bins whose mean intensity over 3 pings x 9 bins is `below_db` below the bed at their range: the median over
/// ranges within `along` of the median over all pings of that mean (E136). Throws Error(argument) unless there are as
/// many bins as the gate has.
SideScanStatistics side_scan_statistics(const Grid<float>& level_db, const RangeGate& gate,
                                        const ShadowOptions& options = {});

}  // namespace insonify
