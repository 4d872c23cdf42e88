// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "sonar/water.hpp"

namespace insonify {
namespace {

struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
};

/// The ranges of a formula's inputs. An input whose range no source states has no limits.
struct Limits {
  const char* formula;
  Range temperature_c, salinity_psu, depth, ph, frequency_khz;
};

Limits limits_of(SoundSpeedFormula formula) {
  if (formula == SoundSpeedFormula::mackenzie) return {"Mackenzie (1981)", {2, 30}, {25, 40}, {0, 8000}, {}, {}};
  if (formula == SoundSpeedFormula::leroy) return {"Leroy et al. (2008)", {-1, 30}, {0, 42}, {0, 12000}, {}, {}};
  return {"UNESCO (Chen and Millero 1977)", {0, 40}, {0, 40}, {0, 9700}, {}, {}};  // 9700 m: 1000 bar
}

Limits limits_of(AbsorptionFormula formula, double frequency_khz) {
  if (formula == AbsorptionFormula::fisher_simmons)
    return {"Fisher and Simmons (1977)", {}, {35, 35}, {}, {8, 8}, {10, 400}};
  if (formula == AbsorptionFormula::ainslie_mccolm)
    return {"Ainslie and McColm (1998)", {-6, 35}, {5, 50}, {0, 7000}, {7.7, 8.3}, {0.1, 1000}};
  if (frequency_khz < 500)
    return {"Francois and Garrison (1982) below 500 kHz", {-2, 22}, {30, 35}, {0, 3500}, {}, {0.2, 1000}};
  return {"Francois and Garrison (1982) from 500 kHz on", {0, 30}, {0, 40}, {0, 10000}, {}, {0.2, 1000}};
}

/// Adds a sentence if `value` is outside `range`.
void judge(std::vector<std::string>& notes, const char* input, double value, const char* unit, const Range& range,
           const char* formula, const char* result) {
  if (value >= range.min && value <= range.max) return;
  std::ostringstream note;
  note << input << " = " << value << unit << ", but " << formula << " holds for " << range.min;
  if (range.min == range.max)
    note << unit << " only";
  else
    note << " to " << range.max << unit;
  note << ": the " << result << " is an extrapolation";
  notes.push_back(note.str());
}

void judge_all(std::vector<std::string>& notes, const Water& w, double frequency_khz, const Limits& limits,
               const char* result) {
  judge(notes, "temperature_c", w.temperature_c, " deg C", limits.temperature_c, limits.formula, result);
  judge(notes, "salinity_psu", w.salinity_psu, " psu", limits.salinity_psu, limits.formula, result);
  judge(notes, "depth", w.depth, " m", limits.depth, limits.formula, result);
  judge(notes, "ph", w.ph, "", limits.ph, limits.formula, result);
  judge(notes, "frequency", frequency_khz, " kHz", limits.frequency_khz, limits.formula, result);
}

}  // namespace

std::vector<std::string> validity_notes(const Water& water, double frequency, SoundSpeedFormula sound_speed_formula,
                                        AbsorptionFormula absorption_formula) {
  require_valid(water, "validity_notes");
  if (!(frequency > 0) || !std::isfinite(frequency))
    fail(ErrorKind::argument, "validity_notes: frequency = ", frequency, " Hz, must be > 0");
  const double khz = 1e-3 * frequency;
  std::vector<std::string> notes;
  judge_all(notes, water, khz, limits_of(sound_speed_formula), "sound speed");
  judge_all(notes, water, khz, limits_of(absorption_formula, khz), "absorption");
  return notes;
}

}  // namespace insonify
