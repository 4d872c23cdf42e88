// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "acoustics/mirror.hpp"
#include "acoustics/sound_speed_profile.hpp"
#include "sonar/pulse.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// The sea surface: a plane in the world, with waves on it.
struct SeaSurface {
  double height = 0;                   ///< world z [m]
  std::optional<double> rms_height{};  ///< rms height of the waves [m]; absent: fully developed sea in the wind
  /// Backscatter [dB re 1 m^2 per m^2]; absent: no reverberation from it.
  std::optional<double> scattering_strength_db{};
};

/// A flat sea bed below what was captured, or instead of it. Defaults: medium sand of the APL-UW handbook (1994).
struct FlatBottom {
  double height = 0;                   ///< world z [m]
  double density_ratio = 1.845;        ///< sediment to water
  double sound_speed_ratio = 1.1782;   ///< sediment to water
  double loss = 0.01624;               ///< imaginary to real part of the wavenumber in the sediment
  double rms_height = 0;               ///< rms height of its relief [m]
  std::optional<double> lambert_mu{};  ///< [1/sr]; absent: no reverberation from it
};

/// Everything around head and scene. An absent part has no effect and costs nothing.
struct Environment {
  Water water;  ///< with the depth of the head; below a known surface, environment_at sets the depth
  std::optional<double>
      water_level{};  ///< world z of the surface, from which depth counts, where it has no other effect [m]
  SoundSpeedFormula sound_speed_formula = SoundSpeedFormula::unesco;
  AbsorptionFormula absorption_formula = AbsorptionFormula::francois_garrison;
  std::optional<SoundSpeedProfile> profile{};  ///< absent: one sound speed everywhere, straight rays
  std::optional<SeaSurface> surface{};
  std::optional<FlatBottom> bottom{};
  std::optional<double> volume_scattering_db{};  ///< backscatter of the water itself [dB re 1 m^2 per m^3]
  std::optional<double> wind_speed{};            ///< 10 m above the sea [m/s]: waves and noise; absent: neither
  std::optional<double> self_noise_db{};         ///< spectrum level of platform and electronics at an element
                                                 ///< [dB re 1 uPa^2/Hz]
  std::vector<Mirror> mirrors{};
  std::optional<Tank> tank{};  ///< a box instead of `surface` and `bottom`
};

/// Returns the mirrors, with the planes of the tank.
std::vector<Mirror> mirrors_of(const Environment& environment);

/// Throws Error naming the value, its unit and its rule.
void require_valid(const Environment& environment, const char* who);

/// Returns the world z of the surface [m], from which depth counts: that of `surface` or of the tank, else water_level;
/// empty if all are absent.
std::optional<double> surface_height(const Environment& environment);

/// Returns the depth [m] of a head at world z `head_height` [m]: below the surface if that is known, else water.depth.
/// It is rounded to a millimetre: neither rounding errors nor a slow tide give each ping water and tables of its own.
double head_depth(const Environment& environment, double head_height);

/// Throws Error(argument), naming `who`, for a profile whose sound speed changes with depth if the surface is unknown.
void require_depths_known(const Environment& environment, const char* who);

/// Returns the environment with water.depth at a head of world height `head_height` [m] (head_depth). Throws
/// Error(argument) with the remedy, naming `who`: for a head at or above the surface; for a water.depth other than 0
/// that is more than 1 cm off that depth; and as require_depths_known.
Environment environment_at(const Environment& environment, double head_height, const char* who);

/// Returns the lowest sound speed [m/s] at any depth: of the profile; without a profile, of the water at the surface,
/// where pressure is lowest; without a surface, of medium_of. Range bins that are fine enough for it are fine enough at
/// every depth.
double slowest_sound(const Environment& environment);

/// Returns the medium at the head for a pulse about `centre_frequency` [Hz]. If there is a profile, the sound speed is
/// the profile's at water.depth.
Medium medium_of(const Environment& environment, double centre_frequency, int absorption_order = 0);

/// Returns the level of all noise at one element in the pulse's band [dB re 1 uPa]: thermal noise (E18), and the noise
/// of wind (E25) and platform where given. Throws Error for an invalid pulse or environment.
double element_noise_level_db(const Environment& environment, const Pulse& pulse);

}  // namespace insonify
