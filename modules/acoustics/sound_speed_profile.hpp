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

/// Sound speed at `depth` [m] (E42). The profile must be valid, the depth finite (not checked: it is called often).
double sound_speed_at(const SoundSpeedProfile& profile, double depth);

/// What refraction does to a scene, at most.
struct RefractionBound {
  double range = 0;      ///< error of the apparent range when rays are taken as straight [m]
  double elevation = 0;  ///< and of the angle at the head [rad]
  double level_db = 0;   ///< and of the level [dB], by bending_in_view alone
};

/// What bend_paths could not do by rays.
struct BentPaths {
  std::size_t silenced = 0;  ///< scatterers in a shadow zone
  std::size_t focused = 0;   ///< scatterers near a caustic, whose level is limited
};

}  // namespace insonify
