// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// The insonification of one surfel by pings (E97).
struct CoveredSurfel {
  std::uint32_t id = 0;                                      ///< SceneCloud::id
  std::uint32_t pings = 0;                                   ///< number of pings that insonified it
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        ///< world [m]
  float grazing_angle = 0;                                   ///< largest grazing angle [rad]; pi/2: normal incidence
  float range = 0;                                           ///< least range [m]
  double intensity = 0;                                      ///< sum over the pings [Pa^2] of the mean square (E64)
  float level_db = -std::numeric_limits<float>::infinity();  ///< highest level (E64) [dB re 1 uPa]
  float scattering_db = -std::numeric_limits<
      float>::infinity();  ///< highest backscattering strength of the surface [dB re 1 m^2 per m^2] (E74)
  float cell_level_db = -std::numeric_limits<
      float>::infinity();  ///< highest level of a resolution cell filled with its surface (E74) [dB re 1 uPa]

  bool operator==(const CoveredSurfel&) const = default;
};

/// Options of coverage_of.
struct CoverageOptions {
  /// A part of a surfel counts as insonified if the surfel's best beam responds to it with at least this level [dB].
  /// This excludes parts that were sampled beside the fan because of side lobes. The elevation pattern of a head with
  /// one row is not included, because it already limits what is sampled.
  double min_response_db = -20;
  int threads = 0;  ///< 0: all cores
};

/// Returns the surfels that a ping insonified, by ascending id. A surfel is insonified if one of its parts is among
/// `scatterers` (i.e. visible), inside the range gate and within a beam. The level of a surfel is that of all its parts
/// together, without speckle, in the beam with the largest response to its first part (E64):
///
///   10 log10( sum_p 1/2 <|A_p|^2> |B_b(u_p, v_p)|^2 exp(-4 a0 r_p) / (1 uPa)^2 )
///
/// <|A_p|^2> is the mean intensity of the direct echo (E7; all patterns but the beam's), B_b the beam's response (E10,
/// E56) and a0 the absorption at the centre frequency. For one part on a beam's axis the level is SL - 2 TL + TS, TS =
/// 10 log10 sigma. The level grows with the surfel's area, so it depends on the density of the cloud. Two other results
/// do not (E74):
///
///   scattering_db = 10 log10( sum_p sigma_p / sum_p S_p )
///   cell_level_db = 10 log10( sum_p 1/2 <|A_p|^2> exp(-4 a0 r_p) / (1 uPa)^2 / sum_p S_p x S_cell )
///   S_cell        = min(dr / sin(incidence), 2 sqrt(2 r dr)) x r du / cos(azimuth)
///
/// sigma_p and S_p are the cross-sections and areas of the parts. dr is the equivalent width of the pulse's intensity
/// in range, du that of the beam's in direction cosine. A picture of intensity shows cell_level_db on an even surface;
/// this is exact for a horizontal surface under a level head.
///
/// scatterers  visible scatterers of `scene`, as returned by find_scatterers
///
/// Throws Error(argument) for a surfel or material that the scene does not have, a min_response_db that is not <= 0,
/// and an invalid head or medium.
std::vector<CoveredSurfel> coverage_of(const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
                                       const Medium& medium, const CoverageOptions& options = {});

/// Adds the results of further pings for the same surfel: pings and intensities add up; of the others the best is kept.
void add(CoveredSurfel& to, const CoveredSurfel& more);

/// Adds `more` to `to`, both by ascending id. Sums depend in their last bits on the order of the calls.
void add(std::vector<CoveredSurfel>& to, const std::vector<CoveredSurfel>& more);

}  // namespace insonify
