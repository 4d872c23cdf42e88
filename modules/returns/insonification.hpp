#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// What pings heard of a scene, surfel by surfel: coverage. One entry per surfel of the scene in every array; of a surfel
/// that was never heard only `hits` means anything.
struct Insonification {
  std::size_t pings = 0;             ///< that were added
  std::vector<std::uint32_t> hits;   ///< pings that heard the surfel
  std::vector<float> level_db;       ///< highest of them (E64) [dB re 1 uPa]
  std::vector<float> grazing_angle;  ///< steepest, between surface and sound [rad]; pi/2: normal incidence
  std::vector<float> range;          ///< nearest [m]

  std::size_t size() const { return hits.size(); }
};

struct InsonificationOptions {
  /// What the beam that hears a surfel best may take off a part of it at most [dB] for the part to count as heard; keeps
  /// out what is sampled beside the fan for the sake of side lobes. The elevation pattern of a head with one row does not
  /// count: that goes as far as was sampled.
  double least_response_db = -20;
  int threads = 0;  ///< 0: all cores
};

/// Adds what one ping heard. A surfel is heard if a part of it is among `scatterers` (so nothing hides it), stands inside
/// the range gate, and a beam looks at it. Its level is that of all its parts together, without speckle, in the beam that
/// hears its first part best (E64):
///
///   10 log10( sum_p 1/2 <|A_p|^2> |B_b(u_p, v_p)|^2 exp(-4 a0 r_p) / (1 uPa)^2 )
///
/// with the mean intensity <|A_p|^2> of the direct echo (E7; all patterns but the beam's), the beam's response B_b (E10, E56)
/// and the absorption a0 of the centre frequency. For one part on a beam's axis that is SL - 2 TL + TS: 10 log10(sigma).
/// It grows with the surfel's area: clouds of other density give other levels.
///
/// map         empty, or what this function made of the same scene; left alone where an error is thrown
/// scatterers  what the head sees of `scene`, as find_scatterers gives it
///
/// Throws Error(argument) for a map of another scene, a surfel or material that the scene does not have, a
/// least_response_db that is not <= 0, and an invalid head or medium.
void add_ping(Insonification& map, const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
              const Medium& medium, const InsonificationOptions& options = {});

}  // namespace insonify
