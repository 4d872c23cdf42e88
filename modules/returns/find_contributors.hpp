#pragma once
#include <cstdint>
#include <span>

#include "acoustics/echoes.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "returns/contributors.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Echoes that came from surfels.
struct SurfelEchoes {
  const Echoes& echoes;                   ///< with their directions upwards v
  std::span<const std::uint32_t> surfel;  ///< of every echo, index in the scene
  std::span<const LegPair> legs{};        ///< of every echo; empty: all direct
};

struct ContributorOptions {
  int per_pixel = 4;       ///< kept of every pixel, 1 to 255
  double floor_db = -60;   ///< energy re a beam's and a pulse's peak below which a contribution may be left out
  double most_mib = 4096;  ///< of memory, above which the work is refused
  int threads = 0;         ///< 0: all cores; the result does not depend on it
};

/// The strongest contributors of every pixel, by the energy that each would leave there alone (E63):
///
///   E(b, n) = sum_p |A_p|^2 |B_b(u_p, v_p)|^2 |G_p(2 r_n / c - delay_p)|^2
///
/// over the echoes p of one surfel (all its parts) by one pair of legs out and back: a surfel that is also heard by way of
/// a boundary is another contributor there. A, B and G are those of the synthesis (E7, E10, E12, E14, E48, E56): spreading,
/// scattering with the speckle amplitude of the patch, patterns, and absorption frequency by frequency. Phases between
/// echoes do not count: shares are those of expected energies, as of echoes whose phases are independent, and add up to 1
/// over all contributors. Noise and reverberation come from no surfel and are not among them.
///
/// scene     gives id and material; `heard` are the echoes of its surfels, direct ones and others
/// returns   beams x bins x per_pixel entries, strongest first, of equal ones that of the lower surfel and leg first;
///           elevation is that of the surfel's strongest echo by this leg
///
/// Exact to 2e-5 of a contributor's own peak, but that those parts of a contributor may be missing for which the beam (or
/// the row of beams) or the pulse is below floor_db of its peak: their energy counts neither for the list nor for the total.
/// Beams are those of the far field at the centre frequency, also where the synthesis was element-exact.
/// Cost: echoes x beams within the floor, some 5 ns each; rows of a head with several weigh all echoes anew. Memory: 31 bytes
/// per entry and 16 per pixel. Throws Error(argument) for invalid arguments, echoes that are not finite or lack v or surfel,
/// and where the memory would exceed most_mib, naming the size.
Contributors find_contributors(const SceneCloud& scene, std::span<const SurfelEchoes> heard, const SonarHead& head,
                               const Medium& medium, const ContributorOptions& options = {});

}  // namespace insonify
