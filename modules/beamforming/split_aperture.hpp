// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// One half of a split aperture. The line array is read as two halves; the beams of the halves receive the same echo
/// with a phase difference (E92).
enum class ApertureSide { port, starboard };

/// Returns `head` with the elements of the other half switched off. The result suits every synthesis method and
/// synthesize_noise. If the number of elements is odd, the middle element belongs to neither half. The shading of the
/// half is the shading of the whole array, resampled to the length of the half. Throws Error(argument) naming `who` for
/// a planar array, several rows of beams, or fewer than eight elements.
SonarHead half_aperture(const SonarHead& head, ApertureSide side, const char* who);

/// Returns the phase between the halves [rad], beams x bins: arg(starboard conj(port)) (E92). An echo from direction
/// cosine u has the phase 2 k b (u - u_b), where b is the distance from the middle of the whole array to the middle of
/// a half. The phase is positive for echoes to port of the beam's axis, and 0 for samples without pressure.
Grid<float> phase_between(const ComplexGrid& port, const ComplexGrid& starboard);

}  // namespace insonify
