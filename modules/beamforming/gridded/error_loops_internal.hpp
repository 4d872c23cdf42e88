// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
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

/// Shaded sums over the elements of phasors of the difference between the paths from echo and focus (E61, E62): of the
/// narrow-band, far-field pattern (E10); of the carrier, with the focus at the echo, before it and behind it; and of the
/// carrier times the cosine and times i sine of the phase that a frequency off it adds. Sum and difference of the last
/// two are the responses above and below the carrier.
struct EchoSums {
  std::complex<double> narrow, carrier, before, behind, near_cosine, far_cosine, near_sine, far_sine;
};

/// Number of elements that are summed at a time.
inline constexpr std::size_t phasor_lanes = 8;

/// Returns the sums over `count` elements at y [m, along the array], a multiple of phasor_lanes.
EchoSums sum_phasors(const double* y, const double* shading, std::size_t count, const BeamEcho& echo);

}  // namespace insonify::kernels
