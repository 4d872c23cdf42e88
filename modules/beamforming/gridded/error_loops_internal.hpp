// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// An echo from (range, u) in a beam at u_beam, focused at its range, and nearer and farther by the pulse's length [m].
struct BeamEcho {
  double range, u, u_beam, nearer, farther;
  double cycles_per_m;       ///< cycles of the received carrier, with the Doppler shift of the echo [1/m]
  double narrow_cycles;      ///< cycles of the carrier of the head, which the narrow-band image uses [1/m]
  double near_off, far_off;  ///< frequencies off the received carrier, over it
};

/// Phasors of the difference between the paths from echo and focus to each element (E61, E62), one row per use.
struct EchoPhasors {
  enum Row { narrow, carrier, before, behind, near_off, far_off, rows };
  double* cosine[rows];
  double* sine[rows];
};

/// Computes the phasors of `count` elements at y [m, along the array]. The rows are: the narrow-band, far-field pattern
/// (E10); the carrier with the focus at the echo, before it and behind it; and the phase that each frequency off the
/// carrier adds to the phase of the carrier.
void echo_phasors(const double* y, std::size_t count, const BeamEcho& echo, EchoPhasors phasors);

/// Number of elements that are summed at a time.
inline constexpr std::size_t phasor_lanes = 8;

/// Sums over elements. `row` holds the real and imaginary parts of the first four rows. `by_cosine` and `by_sine` hold
/// the sums of the carrier times the cosine and times i sine of a frequency off it; their sum and difference are the
/// responses above and below the carrier.
struct PhasorSums {
  double row[4][2];
  double by_cosine[2][2], by_sine[2][2];  ///< near_off, far_off
};

/// Sums the phasors of `count` elements, a multiple of phasor_lanes, each times its shading.
PhasorSums sum_phasors(const double* shading, std::size_t count, const EchoPhasors& phasors);

}  // namespace insonify::kernels
