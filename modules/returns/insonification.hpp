#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Coverage of a scene by pings, one entry per surfel in every array; for surfels without hits only `hits` is
/// meaningful.
struct Insonification {
  std::size_t pings = 0;             ///< number of pings added
  std::vector<std::uint32_t> hits;   ///< number of pings that insonified the surfel
  std::vector<float> level_db;       ///< highest level (E64) [dB re 1 uPa]
  std::vector<float> scattering_db;  ///< of the surface itself, highest [dB re 1 m^2 per m^2] (E74)
  std::vector<float> cell_level_db;  ///< highest level of a resolution cell full of this surface (E74) [dB re 1 uPa]
  std::vector<float>
      grazing_angle;         ///< largest angle between surface and direction of sound [rad]; pi/2: normal incidence
  std::vector<float> range;  ///< least range [m]

  /// Returns the number of surfels of the scene.
  std::size_t size() const { return hits.size(); }
};

/// Options of add_ping and insonified_surfels.
struct InsonificationOptions {
  /// Lowest response [dB] of a surfel's best beam to a part of it for the part to count as insonified, which excludes
  /// parts sampled beside the fan because of side lobes. The elevation pattern of a head with one row is not included:
  /// it limits what is sampled.
  double min_response_db = -20;
  int threads = 0;  ///< 0: all cores
};

/// A surfel that a ping insonified.
struct InsonifiedSurfel {
  std::uint32_t surfel = 0;  ///< index in the scene
  double intensity = 0;      ///< mean square of the pressure, of its level (E64) [Pa^2]
  float grazing_angle = 0;   ///< largest over its parts [rad]
  float range = 0;           ///< least over its parts [m]
};

/// The surfels that add_ping counts for one ping, in the order of their first scatterers; errors as of that.
std::vector<InsonifiedSurfel> insonified_surfels(const SceneCloud& scene, const Scatterers& scatterers,
                                                 const SonarHead& head, const Medium& medium,
                                                 const InsonificationOptions& options = {});

/// Adds the coverage of one ping. A surfel is insonified if a part of it is among `scatterers` (i.e. visible), inside
/// the range gate and within a beam. Its level is that of all its parts together, without speckle, in the beam with the
/// largest response to its first part (E64):
///
///   10 log10( sum_p 1/2 <|A_p|^2> |B_b(u_p, v_p)|^2 exp(-4 a0 r_p) / (1 uPa)^2 )
///
/// with the mean intensity <|A_p|^2> of the direct echo (E7; all patterns but the beam's), the beam's response B_b
/// (E10, E56) and the absorption a0 at the centre frequency. For one part on a beam's axis this is SL - 2 TL + TS, TS =
/// 10 log10 sigma. It grows with the surfel's area, so it depends on the density of the cloud. Two others do not (E74):
///
///   scattering_db = 10 log10( sum_p sigma_p / sum_p S_p )
///   cell_level_db = 10 log10( sum_p 1/2 <|A_p|^2> exp(-4 a0 r_p) / (1 uPa)^2 / sum_p S_p x S_cell )
///   S_cell        = min(dr / sin(incidence), 2 sqrt(2 r dr)) x r du / cos(azimuth)
///
/// with the cross-sections sigma_p and areas S_p of the parts, the equivalent widths of the pulse's intensity in range,
/// dr, and of the beam's in direction cosine, du. cell_level_db is what a picture of intensity shows on an
/// even surface, exact for a horizontal one under a level head. All are the highest of the pings.
///
/// map         empty, or a previous result for the same scene; unchanged if an error is thrown
/// scatterers  visible patches of `scene`, as returned by find_scatterers
///
/// Throws Error(argument) for a map of another scene, a surfel or material that the scene does not have, a
/// min_response_db that is not <= 0, and an invalid head or medium.
void add_ping(Insonification& map, const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
              const Medium& medium, const InsonificationOptions& options = {});

}  // namespace insonify
