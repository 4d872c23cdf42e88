#include "acoustics/water.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

void require_valid(const Water& w, const char* who) {
  if (!std::isfinite(w.temperature_c) || w.temperature_c < -4 || w.temperature_c > 100)
    fail(ErrorKind::argument, who, ": temperature_c = ", w.temperature_c, " deg C, must be within -4 and 100");
  if (!std::isfinite(w.salinity_psu) || w.salinity_psu < 0)
    fail(ErrorKind::argument, who, ": salinity_psu = ", w.salinity_psu, " psu, must be >= 0");
  if (!std::isfinite(w.depth) || w.depth < 0) fail(ErrorKind::argument, who, ": depth = ", w.depth, " m, must be >= 0");
  if (!std::isfinite(w.ph) || w.ph < 0 || w.ph > 14)
    fail(ErrorKind::argument, who, ": ph = ", w.ph, ", must be within 0 and 14");
  if (!(std::abs(w.latitude_deg) <= 90))
    fail(ErrorKind::argument, who, ": latitude_deg = ", w.latitude_deg, " deg, must be within -90 and 90");
}

double gauge_pressure(const Water& water) {
  require_valid(water, "gauge_pressure");
  const double z = water.depth;
  const double s2 = std::pow(std::sin(radians(water.latitude_deg)), 2);
  // Pressure at 45 degrees [MPa], times gravity at this latitude over gravity at 45 degrees.                (E24)
  const double at_45 = z * (1.00818e-2 + z * (2.465e-8 + z * (-1.25e-13 + z * 2.8e-19)));
  const double gravity = 9.780318 * (1 + s2 * (5.2788e-3 - s2 * 2.36e-5));
  return 1e6 * at_45 * (gravity - 2e-5 * z) / (9.80612 - 2e-5 * z);
}

Medium medium_of(const Water& water, double centre_frequency, int absorption_order, AbsorptionFormula formula) {
  return {sound_speed(water), absorption_about(water, centre_frequency, absorption_order, formula)};
}

void require_valid(const Medium& medium, const char* who) {
  if (!std::isfinite(medium.sound_speed) || medium.sound_speed <= 0)
    fail(ErrorKind::argument, who, ": sound_speed = ", medium.sound_speed, " m/s, must be > 0");
  const Absorption& a = medium.absorption;
  if (!std::isfinite(a.a0) || !std::isfinite(a.a1) || !std::isfinite(a.a2) || a.a0 < 0)
    fail(ErrorKind::argument, who, ": absorption = ", a.a0 / nepers_per_db, " dB/m, must be >= 0");
}

}  // namespace insonify
