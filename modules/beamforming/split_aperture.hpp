// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Half of a split aperture: a line array read as two, whose beams see the same echo with a phase between them (E92).
enum class ApertureSide { port, starboard };

/// Returns `head` with the elements of the other half silent, for any synthesis and for synthesize_noise; of an odd
/// number of elements the middle one belongs to neither half. The half has the shading of the whole, resampled to its
/// length. Throws Error(argument) naming `who` for a planar array, several rows of beams, or fewer than eight elements.
SonarHead half_aperture(const SonarHead& head, ApertureSide side, const char* who);

/// Phase between the halves [rad], beams x bins: arg(starboard conj(port)) = 2 k b (u - u_b) of an echo from u, b from
/// the middle of the whole array to that of a half, positive towards port; 0 where there is nothing (E92).
Grid<float> phase_between(const ComplexGrid& port, const ComplexGrid& starboard);

}  // namespace insonify
