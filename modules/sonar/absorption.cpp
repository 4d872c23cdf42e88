// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/water.hpp"

namespace insonify {
namespace {

/// Two relaxations and the pure-water term: alpha [dB/km] = sum_i strength_i f_i f^2 / (f_i^2 + f^2) + water f^2,
/// f in kHz.
struct AbsorptionTerms {
  double boric = 0, boric_khz = 0, magnesium = 0, magnesium_khz = 0, water = 0;
};

/// Returns the terms of Francois and Garrison (1982) (E3).
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

/// Returns the terms of Fisher and Simmons (1977), for 35 psu and pH 8, in dB/km and kHz instead of Np/m and Hz (E21).
AbsorptionTerms fisher_simmons(const Water& w) {
  const double t = w.temperature_c, kelvin = 273.1 + t;
  const double p = 1 + gauge_pressure(w) / 101325;  // [atm]
  const double db_per_km = 1e3 / nepers_per_db;     // per Np/m
  AbsorptionTerms terms;
  terms.boric = (1.03e-8 + t * (2.36e-10 - t * 5.22e-12)) * db_per_km * 1e3;
  terms.boric_khz = 1.32 * kelvin * std::exp(-1700 / kelvin);
  terms.magnesium = (5.62e-8 + 7.52e-10 * t) * (1 - 10.3e-4 * p + 3.7e-7 * p * p) * db_per_km * 1e3;
  terms.magnesium_khz = 1.55e4 * kelvin * std::exp(-3052 / kelvin);
  terms.water = (55.9 + t * (-2.37 + t * (4.77e-2 - t * 3.48e-4))) * 1e-15 * (1 - 3.84e-4 * p + 7.57e-8 * p * p) *
                db_per_km * 1e6;
  return terms;
}

/// Returns the terms of Ainslie and McColm (1998) (E22).
AbsorptionTerms ainslie_mccolm(const Water& w) {
  const double t = w.temperature_c, s = w.salinity_psu, z_km = 1e-3 * w.depth;
  AbsorptionTerms terms;
  terms.boric = 0.106 * std::exp((w.ph - 8) / 0.56);
  terms.boric_khz = 0.78 * std::sqrt(s / 35) * std::exp(t / 26);
  terms.magnesium = 0.52 * (1 + t / 43) * (s / 35) * std::exp(-z_km / 6);
  terms.magnesium_khz = 42 * std::exp(t / 17);
  terms.water = 4.9e-4 * std::exp(-(t / 27 + z_km / 17));
  return terms;
}

AbsorptionTerms absorption_terms(const Water& w, AbsorptionFormula formula) {
  if (formula == AbsorptionFormula::fisher_simmons) return fisher_simmons(w);
  return formula == AbsorptionFormula::ainslie_mccolm ? ainslie_mccolm(w) : francois_garrison(w);
}

/// Value, slope and half curvature of a relaxation f_r f^2 / (f_r^2 + f^2); zero for f_r = 0 (fresh water).
struct Taylor {
  double value = 0, slope = 0, half_curvature = 0;
};
Taylor relaxation(double f_r, double f) {
  const double d = f_r * f_r + f * f, r3 = f_r * f_r * f_r;
  return {f_r * f * f / d, 2 * r3 * f / (d * d), r3 * (f_r * f_r - 3 * f * f) / (d * d * d)};
}

/// Returns the Taylor coefficients of the absorption [dB/km] in kHz about `f` [kHz].
Taylor absorption_taylor(const AbsorptionTerms& terms, double f) {
  const Taylor boric = relaxation(terms.boric_khz, f), magnesium = relaxation(terms.magnesium_khz, f);
  return {terms.boric * boric.value + terms.magnesium * magnesium.value + terms.water * f * f,
          terms.boric * boric.slope + terms.magnesium * magnesium.slope + 2 * terms.water * f,
          terms.boric * boric.half_curvature + terms.magnesium * magnesium.half_curvature + terms.water};
}

}  // namespace

double absorption_db_per_m(const Water& water, double frequency, AbsorptionFormula formula) {
  return absorption_about(water, frequency, 0, formula).a0 / nepers_per_db;
}

Absorption absorption_about(const Water& water, double centre_frequency, int order, AbsorptionFormula formula) {
  require_valid(water, "absorption_about");
  if (!(centre_frequency > 0) || !std::isfinite(centre_frequency))
    fail(ErrorKind::argument, "absorption_about: frequency = ", centre_frequency, " Hz, must be > 0");
  if (order < 0 || order > 2) fail(ErrorKind::argument, "absorption_about: order = ", order, ", must be 0, 1 or 2");

  const Taylor db_per_km = absorption_taylor(absorption_terms(water, formula), centre_frequency * 1e-3);
  if (!std::isfinite(db_per_km.value) || db_per_km.value < 0)
    fail(ErrorKind::argument, "absorption_about: the formula gives ", db_per_km.value, " dB/km at ", centre_frequency,
         " Hz, temperature_c = ", water.temperature_c, " deg C, salinity_psu = ", water.salinity_psu,
         " psu, depth = ", water.depth, " m, which is far outside its range; must be >= 0");
  const double nepers = 1e-3 * nepers_per_db;  // dB/km to Np/m
  return {db_per_km.value * nepers, order >= 1 ? db_per_km.slope * nepers * 1e-3 : 0,
          order >= 2 ? db_per_km.half_curvature * nepers * 1e-6 : 0};
}

}  // namespace insonify
