// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/reverberation_echoes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::reverberation_tests {

inline const Medium medium{1500, {0.2994626 * nepers_per_db, 0, 0}};
inline const double beam_width = radians(1);
inline const double array_length = 0.885893 * wavelength_900k / beam_width;  // of a uniform line with that -3 dB width
inline const double pulse_energy = 0.469719 / 29.5e3;                        // integral of the squared envelope [s]
inline const double slice = 0.5 * 1500 * pulse_energy;                       // range that sounds at once [m]

inline BeamFan fan_of(double field_deg) {
  return make_fan(static_cast<std::size_t>(field_deg), radians(field_deg), beam_width, radians(20));
}

inline Transmission transmission(std::uint64_t seed = 1, double elevation_width = 0) {
  return {pulse_900k, medium, {.elevation_width = elevation_width, .seed = seed}};
}

inline Environment environment() {
  Environment e;
  e.volume_scattering_db = -70;
  e.surface = SeaSurface{.height = 0, .scattering_strength_db = -30};
  e.bottom = FlatBottom{.height = -10, .lambert_mu = power_from_db(-27)};
  return e;
}

inline Pose at(double x, double y, double z, double yaw_deg = 0, double pitch_deg = 0, double roll_deg = 0) {
  return pose_from_yaw_pitch_roll({x, y, z}, radians(yaw_deg), radians(pitch_deg), radians(roll_deg));
}

}  // namespace insonify::reverberation_tests
