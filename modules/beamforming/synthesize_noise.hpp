// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Options of synthesize_noise.
struct NoiseOptions {
  std::uint64_t seed = 1;
  std::int64_t ping = 0;  ///< number of the ping; every ping has its own noise
  int threads = 0;        ///< 0: all cores; the result does not depend on it
};

/// Returns the beams formed from noise that is independent in every element, beams x bins [Pa] (E41). Thermal noise is
/// such noise, and so is isotropic noise on half-wavelength elements.
///
///   p(b, n) = (1/N) sum_m w_m exp(-2 pi i (d/lambda)(m - (N-1)/2) u_b) x(m, n),   x = sum_k h_k xi(m, n + k)
///
/// xi is complex normal and depends on (ping, element, bin) alone. The receive filter h has unit energy. It has the
/// shape of the pulse; for a sweep it is the replica of the sweep. The level in a beam is the element level minus 10
/// log10(N^2 / sum w^2). The noise of overlapping beams and of neighbouring bins is correlated.
///
/// Beams of a planar array are formed over the columns first (E56), so beams of different rows are correlated where
/// their column patterns overlap. Rows of a head without a column have separate elements. The noise of a planar array
/// is thermal and self noise; isotropic noise is up to 2 dB weaker (directivity_index_db).
///
/// element_level_db   level of one element in the pulse's band [dB re 1 uPa rms], e.g. thermal_noise_level_db
/// Throws Error for an invalid head or medium, or a level that is not finite.
ComplexGrid synthesize_noise(const SonarHead& head, const Medium& medium, double element_level_db,
                             const NoiseOptions& options = {});

}  // namespace insonify
