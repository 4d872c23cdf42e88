#pragma once
#include <cstdint>

#include "core/grid.hpp"
#include "sampling/range_gate.hpp"

namespace insonify {

/// Time-varied gain of a display (E20): spreading log10(r) + 2 absorption r, r in m. The defaults take nothing back but
/// the spreading of a point's echo; 20 suits a volume, 30 a bottom at grazing incidence.
struct Tvg {
  double spreading = 40;           ///< dB per decade of range
  double absorption_db_per_m = 0;  ///< one way
};

/// Gain of a TVG [dB] at `range` [m].
double gain_db(const Tvg& tvg, double range);

/// Levels with a TVG applied, beams x bins; those at or below `floor_db` stay as they are. With spreading 40 equal to
/// range_compensated_level_db. The ping itself stays linear. Throws Error(argument) if the levels have another number
/// of bins than the gate, or the TVG is not finite.
Grid<float> apply_tvg(Grid<float> level_db, const RangeGate& gate, const Tvg& tvg, double floor_db = -200);

/// Levels that a display shows, from black to white.
struct GreyWindow {
  double min_db = 0;  ///< and below: 0
  double max_db = 0;  ///< and above: the largest value, 255 or 65535
};

/// Grey values of levels (E58), linear in dB: 0 at or below the floor min_db, and nowhere else; steps of (max_db -
/// min_db)/255 or /65535 above, the last one and all that is louder at the largest value.
/// Throws Error(argument) unless the window is finite with min_db < max_db, Error(content) for a level that is not a
/// number.
Grid<std::uint8_t> quantise_8(const Grid<float>& level_db, const GreyWindow& window);
Grid<std::uint16_t> quantise_16(const Grid<float>& level_db, const GreyWindow& window);

/// Level in the middle of the step of a grey value [dB], off by half a step at most for levels within the window; min_db
/// for 0. `bits` is 8 or 16, `value` within it, else Error(argument).
double level_of_grey(std::uint16_t value, int bits, const GreyWindow& window);

}  // namespace insonify
