// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "core/grid.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// What counts as the first return of a bottom.
struct FirstReturnOptions {
  double blanking = 1;  ///< [m] from the head on that do not count: the transmission and its ringing
  double window = 0.5;  ///< [m] over which intensities are averaged, before and behind a place
  double step_db = 10;  ///< by which the level behind must exceed that before
};

/// Returns the range [m] at which the bottom begins in a row of levels [dB] of one beam (E135): the first place where the
/// mean intensity over a window behind it exceeds that before it by the step, and within a window of it the bin at which
/// speckle of two means changes most likely. A mean counts as 50 dB below the row's strongest at least, so that side
/// lobes in silent water are no bottom. Nothing if there is none. Throws Error(argument) unless the row has as many
/// levels as the gate has bins.
std::optional<double> first_return(const Grid<float>& row_db, const RangeGate& gate,
                                   const FirstReturnOptions& options = {});

}  // namespace insonify
