#pragma once
#include <cstddef>

#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Echo power that a sample of the scene would send, by where it stands: sums of |echo|^2 [Pa^2], before occlusion.
struct SceneSample {
  double in_view = 0;           ///< inside fan, gate and pattern
  double beyond_gate = 0;       ///< in these directions, but farther or nearer than gate and pulse
  double off_elevation = 0;     ///< weighted by the elevation pattern where it is below the sampled floor
  double off_azimuth = 0;       ///< beside the sector, with the elevation pattern alone
  double anywhere = 0;          ///< of the whole scene, seen broadside, without pattern
  double in_view_farthest = 0;  ///< range of the farthest surfel in view [m]; 0: none
  double in_view_nearest = 0;   ///< of the nearest [m]
  double scatterers = 0;        ///< after splitting, estimated
  std::size_t surfels = 0;      ///< in view, estimated
  std::size_t back_facing = 0;  ///< in view but turned away, estimated
  Scatterers places;            ///< range, azimuth and elevation of the sampled surfels in view
};

/// Adds up 20 000 surfels at most, evenly strided.
SceneSample sample_scene(const SceneCloud& scene, const ResolvedPing& ping);

}  // namespace insonify
