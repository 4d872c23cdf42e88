// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>

#include "acoustics/echoes.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "returns/contributors.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Echoes of surfels with their origin.
struct SurfelEchoes {
  const Echoes& echoes;                   ///< must have upward direction cosines v
  std::span<const std::uint32_t> surfel;  ///< surfel of every echo, index in the scene
  std::span<const LegPair> legs{};        ///< legs of every echo; empty: all direct
  /// Of echoes by way of two surfaces, the surfel that sound met before `surfel`; empty: they met one surface.
  std::span<const std::uint32_t> before{};
};

/// Options of find_contributors.
struct ContributorOptions {
  int per_pixel = 4;      ///< contributors listed per pixel, 1 to 255
  double floor_db = -60;  ///< contributions may be omitted below this energy re the peak of beam or pulse [dB]
  double max_mib = 4096;  ///< memory limit of the result [MiB]; larger requests are refused
  int threads = 0;        ///< 0: all cores; the result does not depend on it
};

/// Memory that find_contributors takes for so many pixels [MiB].
double contributor_mib(std::size_t pixels, int per_pixel);

/// Returns the strongest contributors of every pixel, by the energy that each alone would have there (E63):
///
///   E(b, n) = sum_p |A_p|^2 |B_b(u_p, v_p)|^2 |G_p(2 r_n / c - delay_p)|^2
///
/// over the echoes p of one surfel (all its parts) with one pair of legs out and back: the same surfel by way of a
/// boundary, or after another surfel, is another contributor. A, B and G are those of the synthesis (E7, E10, E12, E14, E48, E56): spreading,
/// scattering with the speckle amplitude of the patch, patterns, and frequency-dependent absorption. Phases between
/// echoes are ignored: shares are those of expected energies for independent phases, and add up to 1 over all
/// contributors. Noise and reverberation do not come from surfels and are not included.
///
/// scene     provides ids and materials
/// echoes    all echoes of the scene's surfels, direct and by way of boundaries
/// returns   beams x bins x per_pixel entries, strongest first, equal ones by ascending surfel and leg; elevation is
///           that of the surfel's strongest echo with these legs
///
/// Accurate to 2e-5 of a contributor's own peak, except that parts of a contributor for which beam (or row of beams) or
/// pulse is below floor_db of its peak may be omitted from list and total. Beams are those of the far field at the
/// centre frequency, also if the synthesis was element-exact. Cost: echoes x beams above the floor, some 5 ns each;
/// each row of a head with several rows weights all echoes again. Memory: 31 bytes per entry and 20 per pixel. Throws
/// Error(argument) for invalid arguments, echoes that are not finite or lack v or surfel, and if the memory would
/// exceed max_mib.
Contributors find_contributors(const SceneCloud& scene, std::span<const SurfelEchoes> echoes, const SonarHead& head,
                               const Medium& medium, const ContributorOptions& options = {});

}  // namespace insonify
