// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "core/grid.hpp"
#include "returns/ping.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Time-varied gain of a display (E20): spreading log10(r) + 2 absorption r, r in m. The default compensates the
/// spreading of a point target only; 20 suits a volume, 30 a bottom at grazing incidence.
struct Tvg {
  double spreading = 40;           ///< dB per decade of range
  double absorption_db_per_m = 0;  ///< one way
};

/// Returns the gain of a TVG [dB] at `range` [m].
double gain_db(const Tvg& tvg, double range);

/// Returns levels with a TVG applied, beams x bins. Levels at or below `floor_db` are unchanged. A spreading of 40
/// gives range_compensated_level_db. The ping itself stays linear. Throws Error(argument) if the number of bins is not
/// that of the gate, or the TVG is not finite.
Grid<float> apply_tvg(Grid<float> level_db, const RangeGate& gate, const Tvg& tvg, double floor_db = silence_db);

/// Range of levels of a display, from black to white.
struct GreyWindow {
  double min_db = 0;  ///< level of grey value 0; lower levels also map to 0
  double max_db = 0;  ///< level of the largest value, 255 or 65535; higher levels also map to it
};

/// Returns the nearest grey value of each level (E58). The scale is linear in dB with steps of (max_db - min_db)/255 or
/// /65535; levels beyond the window give 0 or the largest value. Throws Error(argument) unless the window is finite
/// with min_db < max_db, and Error(content) for a level that is not a number.
Grid<std::uint8_t> quantise_8(const Grid<float>& level_db, const GreyWindow& window);
/// Returns the nearest grey value of each level in 65535 steps, as quantise_8 does in 255.
Grid<std::uint16_t> quantise_16(const Grid<float>& level_db, const GreyWindow& window);

/// Returns the level of a grey value [dB], within half a step of the original for levels in the window. Throws
/// Error(argument) unless `bits` is 8 or 16 and `value` is within its range.
double level_of_grey(std::uint16_t value, int bits, const GreyWindow& window);

}  // namespace insonify
