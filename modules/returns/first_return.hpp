// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "core/grid.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Definition of the first return of a bottom.
struct FirstReturnOptions {
  double blanking = 1;  ///< ranges up to this [m] are ignored: the transmission and its ringing
  double window = 0.5;  ///< length [m] of the windows before and behind a range, over which intensities are averaged
  double step_db = 10;  ///< least level behind over the level before [dB]
};

/// Returns the range [m] at which the bottom begins in a row of levels [dB] of one beam (E135). The first step finds
/// the first range at which the mean intensity over a window behind it exceeds the mean before it by step_db. The
/// second step searches a window around that range for the bin at which speckle most likely changes from one mean to
/// another. Means count as at least 50 dB below the row's strongest level, so that side lobes in silent water are not a
/// bottom. Returns nothing if there is no bottom. Throws Error(argument) unless the row has one level per bin of the
/// gate.
std::optional<double> first_return(const Grid<float>& row_db, const RangeGate& gate,
                                   const FirstReturnOptions& options = {});

}  // namespace insonify
