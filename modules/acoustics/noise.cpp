// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/noise.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

void require_frequency(double frequency, const char* who) {
  if (!std::isfinite(frequency) || frequency <= 0)
    fail(ErrorKind::argument, who, ": frequency = ", frequency, " Hz, must be > 0");
}

double thermal(double f_khz) { return -15 + 20 * std::log10(f_khz); }  // (E18)

}  // namespace

double thermal_noise_spectrum_level_db(double frequency) {
  require_frequency(frequency, "thermal_noise_spectrum_level_db");
  return thermal(frequency * 1e-3);
}

double wind_noise_spectrum_level_db(double frequency, double wind_speed) {
  require_frequency(frequency, "wind_noise_spectrum_level_db");
  if (!std::isfinite(wind_speed) || wind_speed < 0)
    fail(ErrorKind::argument, "wind_noise_spectrum_level_db: wind_speed = ", wind_speed, " m/s, must be >= 0");
  const double f_khz = frequency * 1e-3;
  return 50 + 7.5 * std::sqrt(wind_speed) + 20 * std::log10(f_khz) - 40 * std::log10(f_khz + 0.4);  // (E25)
}

double ambient_noise_spectrum_level_db(double frequency, double wind_speed) {
  return db_from_power(power_from_db(thermal_noise_spectrum_level_db(frequency)) +
                       power_from_db(wind_noise_spectrum_level_db(frequency, wind_speed)));  // (E26)
}

double ambient_noise_level_db(const Pulse& pulse, double wind_speed) {
  require_valid(pulse, "ambient_noise_level_db");
  return ambient_noise_spectrum_level_db(pulse.centre_frequency, wind_speed) + db_from_power(noise_bandwidth(pulse));
}

double thermal_noise_level_db(const Pulse& pulse) {
  return thermal(pulse.centre_frequency * 1e-3) + db_from_power(noise_bandwidth(pulse));
}

}  // namespace insonify
