// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sonar/pulse.hpp"

namespace insonify {

// Spectrum levels: dB re 1 uPa^2/Hz at `frequency` [Hz], for an omnidirectional receiver. They throw Error for a
// frequency that is not finite and > 0, or a wind speed [m/s] that is not finite and >= 0.

/// Returns the level of thermal agitation of the water (E18): -15 + 20 log10(f / kHz), Mellen (1952). Within 0.3 dB of
/// 4 pi k T rho f^2 / c in water of 10 deg C. Exceeds the wind's noise above 42 kHz in calm, 110 kHz at 5 m/s, 165 kHz
/// at 10 m/s and 224 kHz at 15 m/s.
double thermal_noise_spectrum_level_db(double frequency);

/// Returns the level of breaking waves and spray (E25): 50 + 7.5 sqrt(w) + 20 log10(f / kHz) - 40 log10(f / kHz + 0.4),
/// w the wind speed [m/s]. The form is that given for Coates (1990) in the literature of underwater communication and
/// in public simulators (ns-3); recalled from those, not read in the book. Calm (0 m/s) keeps its 50 dB term.
double wind_noise_spectrum_level_db(double frequency, double wind_speed);

/// Returns the power sum of thermal noise and wind noise (E26). Ships and turbulence, which matter below 1 kHz, are
/// left out.
double ambient_noise_spectrum_level_db(double frequency, double wind_speed);

/// Returns the level of the ambient noise in the pulse's band [dB re 1 uPa] (E26): the spectrum level at the centre
/// frequency + 10 log10(B / Hz), B = noise_bandwidth(pulse). Low by at most 0.7 dB (wind) or 0.2 dB (thermal) for bands
/// up to half the centre frequency wide. Subtract the directivity index of a beam. Throws Error for an invalid pulse or
/// wind speed.
double ambient_noise_level_db(const Pulse& pulse, double wind_speed);

/// Returns the level of thermal noise alone in the pulse's band [dB re 1 uPa] for an omnidirectional receiver (E18):
/// -15 + 20 log10(f / kHz) + 10 log10(B / Hz), B = noise_bandwidth(pulse). Subtract the directivity index of a beam.
double thermal_noise_level_db(const Pulse& pulse);

}  // namespace insonify
