// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "simulate/resolve_ping.hpp"

namespace insonify {

/// A sample of the scene, pinged without splitting and with unit amplitudes. It gives the expected energy of the echoes
/// in the image, by their place of origin [Pa^2, summed over beams at an echo's peak].
struct SceneSample {
  double in_view = 0;        ///< inside fan, gate and pattern
  double other_ranges = 0;   ///< in the same directions, but farther or nearer than gate and pulse
  double off_azimuth = 0;    ///< beside the sector, received by side lobes
  double off_elevation = 0;  ///< where the elevation pattern is below its floor

  SceneCloud scene;                       ///< the sampled surfels; their areas are scaled to represent all surfels
  Scatterers positions;                   ///< the sampled surfels that are not hidden
  std::vector<double> energy;             ///< energy of each of `positions` [Pa^2, as above]; 0 outside the view
  std::vector<double> power;              ///< energy at one element, without the beams [Pa^2]
  std::vector<double> power_off_azimuth;  ///< power of places off_azimuth; empty if the options exclude them
  std::vector<double> doppler{};          ///< shifts of the carrier of given echoes [Hz]; empty: nothing moves
};

/// Returns given echoes of patches or targets at `positions` as a sample, within the head's gate only. Sets only places,
/// energy, power, doppler and in_view.
SceneSample sample_of(const Scatterers& positions, const Echoes& echoes, const ResolvedPing& ping);

/// Returns a sample of at most 4096 surfels of each kind of place, evenly strided. Each kind is sampled separately, so
/// the result for a part of the scene does not depend on whether other parts were loaded. Only the blocks within reach
/// are visited.
SceneSample sample_scene(const PreparedScene& prepared, const ResolvedPing& ping);

}  // namespace insonify
