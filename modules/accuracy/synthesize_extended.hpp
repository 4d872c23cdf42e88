#pragma once
#include <cstddef>
#include <vector>

#include "acoustics/echoes.hpp"
#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

/// The direct sum (E12) in long double (64 bits of mantissa on x86-64) with Kahan's compensated sums, for all beams of
/// the head and the listed bins: it checks the referee. Slow; Gaussian pulses without Doppler shift.
/// Returns beams x bins.size(), rounded to double.
ComplexGrid synthesize_extended(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const std::vector<std::size_t>& bins, int threads = 0);

}  // namespace insonify
