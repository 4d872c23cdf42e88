#pragma once
#include <cmath>
#include <numbers>

namespace insonify {

constexpr double pi = std::numbers::pi;
constexpr double nepers_per_db = std::numbers::ln10 / 20.0;  ///< 1 dB of level as Np of amplitude
constexpr double micropascal = 1e-6;                         ///< reference pressure in water [Pa]

constexpr double radians(double degrees) { return degrees * pi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / pi; }

/// 10 log10(power); -inf for 0.
inline double db_from_power(double power) { return 10.0 * std::log10(power); }
inline double power_from_db(double db) { return std::pow(10.0, db / 10.0); }
/// 20 log10(amplitude); -inf for 0.
inline double db_from_amplitude(double amplitude) { return 20.0 * std::log10(amplitude); }
inline double amplitude_from_db(double db) { return std::pow(10.0, db / 20.0); }

/// Sound pressure level of a complex (analytic, peak-valued) pressure [Pa] in dB re 1 uPa rms (E6).
inline double pressure_level_db(double pressure_magnitude) {
  return db_from_amplitude(pressure_magnitude / std::numbers::sqrt2 / micropascal);
}

/// Fractional part of `cycles` in [-0.5, 0.5]: phase is reduced in double before any trigonometry (E7).
inline double reduced_cycles(double cycles) { return cycles - std::nearbyint(cycles); }

}  // namespace insonify
