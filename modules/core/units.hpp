// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <numbers>

namespace insonify {

constexpr double pi = std::numbers::pi;
constexpr double nepers_per_db = std::numbers::ln10 / 20.0;  ///< 1 dB of level in Np of amplitude
constexpr double micropascal = 1e-6;                         ///< reference pressure in water [Pa]

/// Returns an angle in radians.
constexpr double radians(double degrees) { return degrees * pi / 180.0; }
/// Returns an angle in degrees.
constexpr double degrees(double radians) { return radians * 180.0 / pi; }

/// Returns 10 log10(power); -inf for 0.
inline double db_from_power(double power) { return 10.0 * std::log10(power); }
/// Returns 10^(db / 10).
inline double power_from_db(double db) { return std::pow(10.0, db / 10.0); }
/// Returns 20 log10(amplitude); -inf for 0.
inline double db_from_amplitude(double amplitude) { return 20.0 * std::log10(amplitude); }
/// Returns 10^(db / 20).
inline double amplitude_from_db(double db) { return std::pow(10.0, db / 20.0); }

/// Returns the sound pressure level [dB re 1 uPa rms] of a complex (analytic, peak-valued) pressure of this magnitude
/// [Pa] (E6).
inline double pressure_level_db(double pressure_magnitude) {
  return db_from_amplitude(pressure_magnitude / std::numbers::sqrt2 / micropascal);
}

/// Returns `cycles` reduced to [-0.5, 0.5] by a whole number: phases are reduced in double before any trigonometry
/// (E7).
inline double reduced_cycles(double cycles) { return cycles - std::nearbyint(cycles); }

}  // namespace insonify
