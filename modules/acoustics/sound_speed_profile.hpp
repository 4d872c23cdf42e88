// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Sound speed against depth: linear between neighbouring entries, constant beyond the outermost ones.
struct SoundSpeedProfile {
  std::vector<double> depth;        ///< [m], positive down, strictly ascending
  std::vector<double> sound_speed;  ///< [m/s]
};

/// Throws Error unless there is an entry, both columns have one length, depths are finite and ascend strictly and
/// speeds lie within 1300 and 1700 m/s. The message names the entry.
void require_valid(const SoundSpeedProfile& profile, const char* who);

/// Returns the sound speed [m/s] at `depth` [m] (E42). The profile must be valid, the depth finite; neither is checked,
/// since the function is called often.
double sound_speed_at(const SoundSpeedProfile& profile, double depth);

/// The largest errors of a scene whose rays are taken as straight.
struct RefractionBound {
  double range = 0;      ///< error of the apparent range [m]
  double elevation = 0;  ///< error of the angle at the head [rad]
  double level_db = 0;   ///< error of the level [dB]; only refraction_in_view sets it
};

/// Counts of scatterers that rays do not serve.
struct RefractedPaths {
  std::size_t silenced = 0;  ///< scatterers in a shadow zone
  std::size_t focused = 0;   ///< scatterers near a caustic, whose level is limited
};

}  // namespace insonify
