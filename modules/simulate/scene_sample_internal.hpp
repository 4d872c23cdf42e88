// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "simulate/resolve_ping.hpp"

namespace insonify {

/// A sample of the scene, pinged without splitting and with unit amplitudes: the expected energy of the echoes in the
/// image, by where they come from [Pa^2, summed over beams at an echo's peak].
struct SceneSample {
  double in_view = 0;        ///< inside fan, gate and pattern
  double other_ranges = 0;   ///< in these directions, but farther or nearer than gate and pulse
  double off_azimuth = 0;    ///< beside the sector: what side lobes receive
  double off_elevation = 0;  ///< where the elevation pattern is below its floor

  SceneCloud scene;                       ///< the surfels, with areas scaled up to stand for all
  Scatterers places;                      ///< those of them that are not hidden
  std::vector<double> energy;             ///< of each of `places` [Pa^2, as above]; 0 outside the view
  std::vector<double> power;              ///< the same at one element, without the beams [Pa^2]
  std::vector<double> power_off_azimuth;  ///< of those off_azimuth; empty if these are out by the options
};

/// Given echoes of patches or targets at `places` as such a sample, of the head's gate alone: only places, energy,
/// power and in_view are set.
SceneSample sample_of(const Scatterers& places, const Echoes& echoes, const ResolvedPing& ping);

/// Samples at most 4096 surfels of each kind of place, evenly strided. Kinds are sampled one by one: what a part of the
/// scene gives does not depend on whether other parts were loaded. Only the blocks within reach are visited.
SceneSample sample_scene(const PreparedScene& prepared, const ResolvedPing& ping);

}  // namespace insonify
