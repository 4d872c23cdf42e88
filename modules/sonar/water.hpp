// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// The water between head and scene, the same everywhere.
struct Water {
  double temperature_c = 10;  ///< [deg C], scale of 1990
  double salinity_psu = 35;   ///< [psu]; 0: fresh water
  double depth = 0;           ///< [m], positive down
  double ph = 8;              ///< acidity on the NBS scale
  double latitude_deg = 45;   ///< latitude [deg], north or south alike: gravity, and so pressure, at depth
};

/// Throws Error unless -4 <= temperature_c <= 100, salinity and depth are finite and >= 0, 0 <= ph <= 14 and
/// -90 <= latitude_deg <= 90.
void require_valid(const Water& water, const char* who);

/// Returns the pressure above that of the atmosphere [Pa] at the depth and latitude of `water`: the standard ocean (0
/// deg C, 35 psu) of Leroy and Parthiot (1998, E24), 0..12000 m. A lake has up to 3 % less.
double gauge_pressure(const Water& water);

/// Formulas of sound_speed.
enum class SoundSpeedFormula { unesco, mackenzie, leroy };

/// Returns the sound speed [m/s].
///   unesco     Chen and Millero (1977, E1): 0..40 deg C, 0..40 psu, 0..1000 bar
///   mackenzie  Mackenzie (1981, E2): 2..30 deg C, 25..40 psu, 0..8000 m; 0.8 m/s low in fresh water
///   leroy      Leroy, Robinson and Goldsmith (2008, E23): -1..30 deg C, 0..42 psu, 0..12000 m, 0.2 m/s
/// At the surface of the sea (2..30 deg C, 30..40 psu) leroy is within 0.2 and mackenzie within 0.31 m/s of unesco.
/// Outside the ranges above it is an extrapolation (validity_notes says so). Throws Error for values require_valid
/// refuses, and where the result is not > 0.
double sound_speed(const Water& water, SoundSpeedFormula formula = SoundSpeedFormula::unesco);

/// Formulas of absorption_db_per_m.
enum class AbsorptionFormula { francois_garrison, fisher_simmons, ainslie_mccolm };

/// Returns the absorption of sound [dB/m] at `frequency` [Hz].
///   francois_garrison  Francois and Garrison (1982, E3), theta = 273 + T as in the paper: 200 Hz to 1 MHz, 5-10 %
///   fisher_simmons     Fisher and Simmons (1977, E21): 10 to 400 kHz; takes no heed of salinity (35) and pH (8)
///   ainslie_mccolm     Ainslie and McColm (1998, E22): within about 10 % of Francois and Garrison, 100 Hz to 1 MHz
/// Above 1 MHz each is an extrapolation in which the pure-water term dominates. At 900 kHz in mild sea water they
/// differ by 8 %: absorption is not known better than that. In fresh water (0 psu) the first and last leave pure water.
/// Throws Error for frequency <= 0, for values require_valid refuses, and where the result is not >= 0 (Fisher and
/// Simmons above about 70 deg C).
double absorption_db_per_m(const Water& water, double frequency,
                           AbsorptionFormula formula = AbsorptionFormula::francois_garrison);

/// Amplitude absorption about a centre frequency f_c: alpha(f) = a0 + a1 (f - f_c) + a2 (f - f_c)^2.
struct Absorption {
  double a0 = 0;  ///< [Np/m]
  double a1 = 0;  ///< [Np/m/Hz]
  double a2 = 0;  ///< [Np/m/Hz^2]

  bool operator==(const Absorption&) const = default;
};

/// Returns the Taylor coefficients of absorption_db_per_m about `centre_frequency` [Hz] up to `order` 0, 1 or 2 (E3,
/// E21, E22).
Absorption absorption_about(const Water& water, double centre_frequency, int order,
                            AbsorptionFormula formula = AbsorptionFormula::francois_garrison);

/// Properties of the water for sound, computed once for each run.
struct Medium {
  double sound_speed = 1500;  ///< [m/s]
  Absorption absorption;

  bool operator==(const Medium&) const = default;
};

/// Returns the medium of `water` for a pulse about `centre_frequency` [Hz]; sound speed by UNESCO, absorption by
/// `formula` to `absorption_order`.
Medium medium_of(const Water& water, double centre_frequency, int absorption_order = 0,
                 AbsorptionFormula formula = AbsorptionFormula::francois_garrison);

/// Throws Error unless sound speed is finite and > 0 and absorption is finite and >= 0 at the centre frequency.
void require_valid(const Medium& medium, const char* who);

/// Returns one sentence for each input outside the range of its formula, with value, unit and range; empty if all
/// inputs are inside. Ranges are those listed at sound_speed and absorption_db_per_m; Francois and Garrison: -2..22 deg
/// C, 30..35 psu, 0..3500 m below 500 kHz, and 0..30 deg C, 0..40 psu, 0..10000 m from there on; Ainslie and McColm:
/// -6..35 deg C, 5..50 psu, 0..7000 m, pH 7.7..8.3. An input is not judged if no source states its range. Throws as
/// absorption_db_per_m does for frequency [Hz] and water.
std::vector<std::string> validity_notes(const Water& water, double frequency,
                                        SoundSpeedFormula sound_speed_formula = SoundSpeedFormula::unesco,
                                        AbsorptionFormula absorption_formula = AbsorptionFormula::francois_garrison);

}  // namespace insonify
