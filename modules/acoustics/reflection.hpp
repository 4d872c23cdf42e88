// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>

#include "acoustics/environment.hpp"

namespace insonify {

/// Returns the plane-wave pressure reflection coefficient of a fluid sediment with absorption (Rayleigh, E45) at
/// `grazing` [rad].
///
///   R = (m sin g - q) / (m sin g + q),  q = sqrt(n^2 - cos^2 g),  n = (1 + i loss) / sound_speed_ratio
///
/// with m the density ratio. Never more than 1 in size; -1 at grazing 0, unless the sediment is as fast as water and
/// without loss. Shear waves, layers and grains that are not small against the wavelength are left out: sand and mud.
/// Throws Error unless 0 <= grazing <= pi / 2.
std::complex<double> bottom_reflection(const FlatBottom& bottom, double grazing);

/// Returns the plane-wave pressure reflection coefficient (E148) of a thick elastic solid in water of `density`
/// [kg/m^3] and `sound_speed` [m/s], `cosine` that of incidence against the normal:
///
///   R = (Z - Zw) / (Z + Zw),  Zw = rho_w c_w / cosine,  Z = Zp cos^2(2 s) + Zs sin^2(2 s)
///
/// Zp and Zs are the impedances rho c / cos of both waves inside, at the angles p and s of Snell's law (Brekhovskikh
/// and Lysanov, Fundamentals of Ocean Acoustics, section 4.2). Waves that cannot enter fade: a root has Im >= 0. No
/// loss inside; -1 at cosine 0. Throws Error unless 0 <= cosine <= 1, density and pressure_speed > 0, shear_speed >= 0.
std::complex<double> reflection_coefficient(const ElasticSolid& solid, double cosine, double density,
                                            double sound_speed);

/// Density of sea water [kg/m^3] for reflections; fresh water has 2.6 % less.
inline constexpr double sea_water_density = 1026;

/// Returns the rms height of the waves of a fully developed sea [m] (E46): 0.00561 s^2/m U^2 with U the wind speed
/// [m/s] 10 m above the sea. From the spectrum of Pierson and Moskowitz (1964), a = 0.0081, b = 0.74, U19 the wind at
/// 19.5 m: h = sqrt(a / b) U19^2 / (2 g), which is H_s = 4 h = 0.21 U19^2 / g; U19 = 1.026 U as Stewart, Introduction
/// to Physical Oceanography, ch. 16, takes it. Long swell from elsewhere is not in it, and a sea of short fetch is
/// lower. Throws Error unless wind_speed is finite and >= 0.
double rms_wave_height(double wind_speed);

/// Returns the rms height of the waves on the surface [m]: the given height, else that of the environment's wind, else
/// 0.
double rms_wave_height(const Environment& environment);

/// Returns the factor on the amplitude of a coherent reflection by relief of `rms_height` [m] (Eckart 1953, E47):
/// exp(-2 (k h sin g)^2), k the wavenumber [rad/m]. Heights are normally distributed and slopes gentle; what is lost
/// here is scattered, not absorbed.
double coherent_reflection_loss(double wavenumber, double rms_height, double grazing);

}  // namespace insonify
