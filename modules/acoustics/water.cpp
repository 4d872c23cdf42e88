#include "acoustics/water.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

void require_valid(const Water& w, const char* who) {
  if (!std::isfinite(w.temperature_c) || w.temperature_c < -4 || w.temperature_c > 100)
    fail(ErrorKind::argument, who, ": temperature_c = ", w.temperature_c, " deg C, must be within -4 and 100");
  if (!std::isfinite(w.salinity_psu) || w.salinity_psu < 0)
    fail(ErrorKind::argument, who, ": salinity_psu = ", w.salinity_psu, " psu, must be >= 0");
  if (!std::isfinite(w.depth) || w.depth < 0) fail(ErrorKind::argument, who, ": depth = ", w.depth, " m, must be >= 0");
  if (!std::isfinite(w.ph) || w.ph < 0 || w.ph > 14)
    fail(ErrorKind::argument, who, ": ph = ", w.ph, ", must be within 0 and 14");
}

/// Pressure above the atmosphere [bar] at `depth` [m], 45 deg latitude (Leroy and Parthiot 1998, standard ocean).
double pressure_bar(double z) {
  return 10 * (1.00818e-2 * z + 2.465e-8 * z * z - 1.25e-13 * z * z * z + 2.8e-19 * z * z * z * z);
}

/// Chen and Millero (1977) as given by Fofonoff and Millard (1983), temperature of 1990 and bar (E1).
double unesco(double t90, double s, double p) {
  const double t = 1.00024 * t90;  // the formula is in the temperature scale of 1968
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

/// Mackenzie (1981) (E2).
double mackenzie(double t, double s, double z) {
  return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * (s - 35) + 1.630e-2 * z +
         1.675e-7 * z * z - 1.025e-2 * t * (s - 35) - 7.139e-13 * t * z * z * z;
}

/// Two relaxations and the pure-water term: alpha [dB/km] = sum_i strength_i f_i f^2 / (f_i^2 + f^2) + water f^2,
/// f in kHz.
struct AbsorptionTerms {
  double boric = 0, boric_khz = 0, magnesium = 0, magnesium_khz = 0, water = 0;
};

/// Francois and Garrison (1982) (E3).
AbsorptionTerms francois_garrison(const Water& w) {
  const double t = w.temperature_c, s = w.salinity_psu, z = w.depth;
  const double c = 1412 + 3.21 * t + 1.19 * s + 0.0167 * z;
  const double theta = 273 + t;
  AbsorptionTerms terms;
  terms.boric = 8.86 / c * std::pow(10, 0.78 * w.ph - 5);
  terms.boric_khz = 2.8 * std::sqrt(s / 35) * std::pow(10, 4 - 1245 / theta);
  terms.magnesium = 21.44 * s / c * (1 + 0.025 * t) * (1 - 1.37e-4 * z + 6.2e-9 * z * z);
  terms.magnesium_khz = 8.17 * std::pow(10, 8 - 1990 / theta) / (1 + 0.0018 * (s - 35));
  const double cold = 4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - t * 1.50e-8));
  const double warm = 3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - t * 6.5e-10));
  terms.water = (t <= 20 ? cold : warm) * (1 - 3.83e-5 * z + 4.9e-10 * z * z);
  return terms;
}

/// Value, slope and half curvature of a relaxation f_r f^2 / (f_r^2 + f^2); zero for f_r = 0 (fresh water).
struct Taylor {
  double value = 0, slope = 0, half_curvature = 0;
};
Taylor relaxation(double f_r, double f) {
  const double d = f_r * f_r + f * f, r3 = f_r * f_r * f_r;
  return {f_r * f * f / d, 2 * r3 * f / (d * d), r3 * (f_r * f_r - 3 * f * f) / (d * d * d)};
}

/// Absorption in dB/km as Taylor coefficients in kHz about `f` [kHz].
Taylor absorption_taylor(const Water& w, double f) {
  const AbsorptionTerms terms = francois_garrison(w);
  const Taylor boric = relaxation(terms.boric_khz, f), magnesium = relaxation(terms.magnesium_khz, f);
  return {terms.boric * boric.value + terms.magnesium * magnesium.value + terms.water * f * f,
          terms.boric * boric.slope + terms.magnesium * magnesium.slope + 2 * terms.water * f,
          terms.boric * boric.half_curvature + terms.magnesium * magnesium.half_curvature + terms.water};
}

}  // namespace

double sound_speed(const Water& water, SoundSpeedFormula formula) {
  require_valid(water, "sound_speed");
  if (formula == SoundSpeedFormula::mackenzie) return mackenzie(water.temperature_c, water.salinity_psu, water.depth);
  return unesco(water.temperature_c, water.salinity_psu, pressure_bar(water.depth));
}

double absorption_db_per_m(const Water& water, double frequency) {
  return absorption_about(water, frequency, 0).a0 / nepers_per_db;
}

Absorption absorption_about(const Water& water, double centre_frequency, int order) {
  require_valid(water, "absorption_about");
  if (!(centre_frequency > 0) || !std::isfinite(centre_frequency))
    fail(ErrorKind::argument, "absorption_about: frequency = ", centre_frequency, " Hz, must be > 0");
  if (order < 0 || order > 2) fail(ErrorKind::argument, "absorption_about: order = ", order, ", must be 0, 1 or 2");
  const Taylor db_per_km = absorption_taylor(water, centre_frequency * 1e-3);
  const double nepers = 1e-3 * nepers_per_db;  // dB/km to Np/m
  return {db_per_km.value * nepers, order >= 1 ? db_per_km.slope * nepers * 1e-3 : 0,
          order >= 2 ? db_per_km.half_curvature * nepers * 1e-6 : 0};
}

Medium medium_of(const Water& water, double centre_frequency, int absorption_order) {
  return {sound_speed(water), absorption_about(water, centre_frequency, absorption_order)};
}

void require_valid(const Medium& medium, const char* who) {
  if (!std::isfinite(medium.sound_speed) || medium.sound_speed <= 0)
    fail(ErrorKind::argument, who, ": sound_speed = ", medium.sound_speed, " m/s, must be > 0");
  const Absorption& a = medium.absorption;
  if (!std::isfinite(a.a0) || !std::isfinite(a.a1) || !std::isfinite(a.a2) || a.a0 < 0)
    fail(ErrorKind::argument, who, ": absorption = ", a.a0 / nepers_per_db, " dB/m, must be >= 0");
}

}  // namespace insonify
