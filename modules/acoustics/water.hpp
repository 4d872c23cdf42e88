#pragma once

namespace insonify {

/// The water between head and scene, the same everywhere.
struct Water {
  double temperature_c = 10;  ///< [deg C]
  double salinity_psu = 35;   ///< [psu]; 0: fresh water
  double depth = 0;           ///< [m], positive down; taken as pressure at 45 deg latitude
  double ph = 8;              ///< acidity on the NBS scale
};

enum class SoundSpeedFormula { unesco, mackenzie };

/// Sound speed [m/s]. UNESCO (Chen-Millero 1977, E1): 0..40 deg C, 0..40 psu, 0..1000 bar, 0.05 m/s. Mackenzie
/// (1981, E2): 2..30 deg C, 25..40 psu, 0..8000 m, 0.07 m/s; 0.8 m/s low in fresh water. Outside these it is an
/// extrapolation. Throws Error for values that are not finite, salinity or depth < 0.
double sound_speed(const Water& water, SoundSpeedFormula formula = SoundSpeedFormula::unesco);

/// Absorption of sound [dB/m] at `frequency` [Hz], Francois and Garrison (1982, E3), with theta = 273 + T as in
/// the paper. "All oceanic conditions", 200 Hz to 1 MHz, about 5-10 %; above 1 MHz an extrapolation in which the
/// pure-water term dominates. Throws Error for frequency <= 0 and for values sound_speed refuses.
double absorption_db_per_m(const Water& water, double frequency);

/// Amplitude absorption about a centre frequency f_c: alpha(f) = a0 + a1 (f - f_c) + a2 (f - f_c)^2.
struct Absorption {
  double a0 = 0;  ///< [Np/m]
  double a1 = 0;  ///< [Np/m/Hz]
  double a2 = 0;  ///< [Np/m/Hz^2]
};

/// Taylor coefficients of absorption_db_per_m about `centre_frequency` [Hz] up to `order` 0, 1 or 2 (E3).
Absorption absorption_about(const Water& water, double centre_frequency, int order);

/// What sound needs to know of the water, worked out once per run.
struct Medium {
  double sound_speed = 1500;  ///< [m/s]
  Absorption absorption;
};

/// Medium of `water` for a pulse about `centre_frequency` [Hz]; absorption to `absorption_order`.
Medium medium_of(const Water& water, double centre_frequency, int absorption_order = 0);

/// Throws Error unless sound speed is finite and > 0 and absorption is finite and >= 0 at the centre frequency.
void require_valid(const Medium& medium, const char* who);

}  // namespace insonify
