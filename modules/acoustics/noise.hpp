#pragma once
#include "acoustics/pulse.hpp"

namespace insonify {

/// Level of thermal noise in the pulse's band [dB re 1 uPa] for an omnidirectional receiver (E18): -15 +
/// 20 log10(f / kHz) + 10 log10(B / Hz). Above about 110 kHz thermal noise dominates the sea's own.
/// Subtract the directivity index of a beam.
double thermal_noise_level_db(const Pulse& pulse);

}  // namespace insonify
