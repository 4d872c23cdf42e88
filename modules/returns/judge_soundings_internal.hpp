// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "returns/bottom_detection.hpp"
#include "returns/bottom_fits_internal.hpp"

namespace insonify {

/// Data that judge_soundings needs of the ping in which the soundings were found.
struct JudgedPing {
  const Ping& ping;
  const Grid<double>& intensity;                       ///< beams x bins [Pa^2]
  const Eigen::Array<double, 1, Eigen::Dynamic>& all;  ///< sum over beams of the intensity of each bin [Pa^2]
  const std::vector<double>& noise;                    ///< noise of each beam [Pa^2]
  std::span<const BottomEcho> echoes;                  ///< predicted echo of each sounding
  double absorption_db_per_m = 0;
  double side_lobe_reach = 0;  ///< largest distance in range between side lobes and their echo [m]
  int threads = 0;
};

/// Sets `reject`. Adds to `deviation` and `quality` the effect of the bottom's relief within the footprint, estimated
/// from the neighbours and the echo.
void judge_soundings(const JudgedPing& judged, BottomSoundings& soundings);

}  // namespace insonify
