// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// An echo from (range, u) in a beam at u_beam, focused at its range, and nearer and farther by the pulse's length [m].
struct BeamEcho {
  double range, u, u_beam, nearer, farther;
  double cycles_per_m;       ///< at the carrier
  double near_off, far_off;  ///< frequencies off the carrier, over it
};

/// What is turned by the difference of the ways that echo and focus have to an element (E61, E62).
struct EchoPhasors {
  enum Row { narrow, carrier, before, behind, near_off, far_off, rows };
  double* cosine[rows];
  double* sine[rows];
};

/// Phasors of the elements at y [m, along the array]: of the narrow-band, far-field pattern (E10), of the carrier with
/// the focus at the echo, before and behind it, and of what the frequencies off the carrier add to the carrier's.
void echo_phasors(const double* y, std::size_t count, const BeamEcho& echo, EchoPhasors phasors);

/// Elements are summed so many at a time.
inline constexpr std::size_t phasor_lanes = 8;

/// Sums over elements: real and imaginary part of the first four rows; of the carrier times cosine and times i sine of
/// a frequency off it, of which those of a frequency above and below the carrier are sum and difference.
struct PhasorSums {
  double row[4][2];
  double by_cosine[2][2], by_sine[2][2];  ///< near_off, far_off
};

/// Sums the phasors of `count` elements, a multiple of phasor_lanes, each times its shading.
PhasorSums sum_phasors(const double* shading, std::size_t count, const EchoPhasors& phasors);

}  // namespace insonify::kernels
