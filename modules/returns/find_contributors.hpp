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

/// Echoes of surfels with their origins.
struct SurfelEchoes {
  const Echoes& echoes;                   ///< must have upward direction cosines v
  std::span<const std::uint32_t> surfel;  ///< surfel of every echo, index in the scene
  std::span<const LegPair> legs{};        ///< legs of every echo; empty: all direct
  /// For double echoes, the surfel that the sound met before `surfel`; empty: the echoes met one surface.
  std::span<const std::uint32_t> before{};
};

/// Options of find_contributors.
struct ContributorOptions {
  int per_pixel = 4;      ///< contributors listed per pixel, 1 to 255
  double floor_db = -60;  ///< contributions below this energy relative to the peak of beam or pulse may be omitted [dB]
  double max_mib = 4096;  ///< memory limit of the result [MiB]; larger requests are refused
  int threads = 0;        ///< 0: all cores; the result does not depend on it
};

/// Returns the memory that find_contributors takes for `pixels` pixels [MiB].
double contributor_mib(std::size_t pixels, int per_pixel);

/// Returns the strongest contributors of every pixel. They are ranked by the energy of each contributor alone (E63):
///
///   E(b, n) = sum_p |A_p|^2 |B_b(u_p, v_p)|^2 |G_p(2 r_n / c - delay_p)|^2
///
/// The sum is over the echoes p of one surfel (all its parts) with one pair of legs out and back. The same surfel by
/// way of a boundary, or after another surfel, is another contributor. A, B and G are those of the synthesis (E7, E10,
/// E12, E14, E48, E56): spreading, scattering with the speckle amplitude of the scatterer, patterns, and
/// frequency-dependent absorption. Phases between echoes are ignored, so the shares are those of expected energies for
/// independent phases; they add up to 1 over all contributors. Noise and reverberation do not come from surfels and are
/// not included.
///
/// scene     provides ids and materials
/// echoes    all echoes of the scene's surfels, direct and by way of boundaries
/// returns   beams x bins x per_pixel entries, strongest first; equal ones by ascending surfel and legs. The elevation
///           is that of the surfel's strongest echo with these legs.
///
/// Accurate to 2e-5 of a contributor's own peak. Parts of a contributor for which the beam (or row of beams) or the
/// pulse is below floor_db of its peak may be missing from list and total. The beams are those of the far field at the
/// centre frequency, even if the synthesis was element-exact. The cost is echoes x beams above the floor, about 5 ns
/// each; each row of a head with several rows weights all echoes again. The memory is 31 bytes per entry and 20 per
/// pixel. Throws Error(argument) for invalid arguments, for echoes that are not finite or lack v or surfel, and if the
/// memory would exceed max_mib.
Contributors find_contributors(const SceneCloud& scene, std::span<const SurfelEchoes> echoes, const SonarHead& head,
                               const Medium& medium, const ContributorOptions& options = {});

}  // namespace insonify
