// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "core/grid.hpp"
#include "returns/ping.hpp"
#include "returns/quantise.hpp"

namespace insonify {

/// A fan in true geometry, from above: ahead is up, port on the left, the head below the middle of the last row.
struct GreyFan {
  Grid<std::uint8_t> grey;  ///< rows x columns, row 0 the farthest; 0 outside of the fan
  double pixel = 0;         ///< size [m]
};

/// Returns the fan of a ping in grey values, with the gain of a TVG. Pixels have the size max_range / rows; each shows
/// the mean intensity over its area (E168), so that nothing is left out. Throws Error(content) for a ping of several
/// rows of beams, Error(argument) as quantise_8.
GreyFan grey_fan(const Ping& ping, const Tvg& tvg, const GreyWindow& window, int rows);

/// Throws Error(content) naming `who` for a ping of several rows of beams.
void require_one_row(const Ping& ping, const char* who);

}  // namespace insonify
