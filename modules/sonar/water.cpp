// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/water.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Returns the sound speed of Chen and Millero (1977) by Fofonoff and Millard (1983), with t of 1990, p in bar (E1).
double unesco(double t90, double s, double p) {
  const double t = 1.00024 * t90;  // temperature in the formula's scale of 1968
  const double c0 = 1402.388 + t * (5.03711 + t * (-5.80852e-2 + t * (3.3420e-4 + t * (-1.478e-6 + t * 3.1464e-9))));
  const double c1 = 0.153563 + t * (6.8982e-4 + t * (-8.1788e-6 + t * (1.3621e-7 - t * 6.1185e-10)));
  const double c2 = 3.1260e-5 + t * (-1.7107e-6 + t * (2.5974e-8 + t * (-2.5335e-10 + t * 1.0405e-12)));
  const double c3 = -9.7729e-9 + t * (3.8504e-10 - t * 2.3643e-12);
  const double a0 = 1.389 + t * (-1.262e-2 + t * (7.164e-5 + t * (2.006e-6 - t * 3.21e-8)));
  const double a1 = 9.4742e-5 + t * (-1.2580e-5 + t * (-6.4885e-8 + t * (1.0507e-8 - t * 2.0122e-10)));
  const double a2 = -3.9064e-7 + t * (9.1041e-9 + t * (-1.6002e-10 + t * 7.988e-12));
  const double a3 = 1.100e-10 + t * (6.649e-12 - t * 3.389e-13);
  const double b = -1.922e-2 - 4.42e-5 * t + p * (7.3637e-5 + 1.7945e-7 * t);
  const double d = 1.727e-3 - 7.9836e-6 * p;
  const double pure = c0 + p * (c1 + p * (c2 + p * c3));
  const double salt = a0 + p * (a1 + p * (a2 + p * a3));
  return pure + s * (salt + b * std::sqrt(s) + d * s);
}

/// Returns the sound speed of Mackenzie (1981) (E2).
double mackenzie(double t, double s, double z) {
  return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * (s - 35) + 1.630e-2 * z +
         1.675e-7 * z * z - 1.025e-2 * t * (s - 35) - 7.139e-13 * t * z * z * z;
}

/// Returns the sound speed of Leroy, Robinson and Goldsmith (2008), with t of 1990 and latitude in degrees (E23).
double leroy(double t, double s, double z, double latitude_deg) {
  return 1402.5 + 5 * t - 5.44e-2 * t * t + 2.1e-4 * t * t * t + 1.33 * s - 1.23e-2 * s * t + 8.7e-5 * s * t * t +
         1.56e-2 * z + 2.55e-7 * z * z - 7.3e-12 * z * z * z + 1.2e-6 * z * (latitude_deg - 45) -
         9.5e-13 * t * z * z * z + 3e-7 * t * t * z + 1.43e-5 * s * z;
}

double evaluate(const Water& w, SoundSpeedFormula formula) {
  if (formula == SoundSpeedFormula::mackenzie) return mackenzie(w.temperature_c, w.salinity_psu, w.depth);
  if (formula == SoundSpeedFormula::leroy)
    return leroy(w.temperature_c, w.salinity_psu, w.depth, std::abs(w.latitude_deg));
  return unesco(w.temperature_c, w.salinity_psu, 1e-5 * gauge_pressure(w));
}

}  // namespace

void require_valid(const Water& w, const char* who) {
  const double t = w.temperature_c;
  require(t >= -4 && t <= 100, who, "temperature_c", t, "deg C", "within -4 and 100");
  require(w.salinity_psu >= 0 && std::isfinite(w.salinity_psu), who, "salinity_psu", w.salinity_psu, "psu", ">= 0");
  require(w.depth >= 0 && std::isfinite(w.depth), who, "depth", w.depth, "m", ">= 0");
  require(w.ph >= 0 && w.ph <= 14, who, "ph", w.ph, "", "within 0 and 14");
  require(std::abs(w.latitude_deg) <= 90, who, "latitude_deg", w.latitude_deg, "deg", "within -90 and 90");
}

double gauge_pressure(const Water& water) {
  require_valid(water, "gauge_pressure");
  const double z = water.depth;
  const double s2 = std::pow(std::sin(radians(water.latitude_deg)), 2);
  // Pressure at 45 degrees [MPa], times gravity at this latitude over that at 45 degrees.                   (E24)
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

double sound_speed(const Water& water, SoundSpeedFormula formula) {
  require_valid(water, "sound_speed");
  const double c = evaluate(water, formula);
  if (!std::isfinite(c) || c <= 0)
    fail(ErrorKind::argument, "sound_speed: the formula gives ", c, " m/s at salinity_psu = ", water.salinity_psu,
         " psu, depth = ", water.depth, " m, which is far outside its range; must be > 0");
  return c;
}

}  // namespace insonify
