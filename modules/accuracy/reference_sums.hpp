// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "acoustics/echoes.hpp"
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Short cuts of the direct sum.
struct WindowedOptions {
  double tolerance = 1e-4;   ///< pulses are cut, and the pattern is interpolated, at this part of their peaks
  double pattern_nulls = 0;  ///< the pattern is cut off at so many null widths; 0: never
  bool nearest_bin = false;  ///< delays are rounded to whole bins; the carrier phase is kept
  int threads = 0;
};

/// Returns a function that computes the direct sum of echoes as other simulators do, for comparison: each echo is added
/// to every beam over the length of its pulse, its weight read from a table of the pattern (cubic interpolation).
/// pattern_nulls and nearest_bin are short cuts of other simulators; their errors do not fall with the tolerance. Cost:
/// echoes x beams x pulse samples. Gaussian pulses without Doppler shift. The function refers to head and medium; its
/// result does not depend on `threads`. Throws Error for an invalid head or medium, a head of several rows, a sweep, or
/// a tolerance outside [1e-12, 1), and the function for Doppler shifts.
std::function<ComplexGrid(const Echoes&)> windowed_synthesizer(const SonarHead& head, const Medium& medium,
                                                               const WindowedOptions& options = {});

/// Returns the direct sum (E12) in long double (64 bits of mantissa on x86-64) with Kahan's compensated sums, for all
/// beams of the head and the listed bins, as beams x bins.size() rounded to double. It checks the referee. Slow;
/// Gaussian pulses without Doppler shift.
ComplexGrid synthesize_extended(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const std::vector<std::size_t>& bins, int threads = 0);

}  // namespace insonify
