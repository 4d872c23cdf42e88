// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

#include "beamforming/numerics/gridding_kernel_internal.hpp"

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Columns of echoes: delay, direction cosine, amplitude in units of the gridding, Doppler shift.
struct EchoArrays {
  const double *delay, *u, *re, *im, *doppler;
};

/// A grid of samples by direction. Directions are counted from first_u.
struct GaussianGrid {
  double start, step, half, first_row;  ///< time axis [s], half length of pulses [s], first row
  double first_u, cycles_per_u;         ///< cycles of the grid
  double grid, half_width, pad;         ///< steps of a cycle; of the kernel; before the first
  bool half_positions;                  ///< elements stand at half-integers: whole cycles have signs
};

/// `a` of EchoEnvelope as sent (E8), range [m] per delay [s], and absorption.
struct PulseLosses {
  double a_sent, range_per_delay, a0, a1, a2;
};

/// Working arrays with one number per echo. `power` is that of the peak after absorption at the carrier.
struct GaussianState {
  double *re, *im, *turn_re, *turn_im, *ratio, *change, *power;
};

/// Places Gaussian pulses, attenuated and shifted in frequency by absorption and Doppler (E8, E13, E54), on the grid;
/// the state is that of sample `sample` of each.
template <typename Real>
struct GaussianPositions {
  std::uint32_t *row, *column;
  Real* column_offset;
};
template <typename Real>
void place_gaussians(const EchoArrays& echoes, std::size_t count, const GaussianGrid& grid, const PulseLosses& losses,
                     std::size_t sample, GaussianState state, GaussianPositions<Real> positions);

/// Samples of the pulses by recurrence, row by row: sample n of echo i at n count + i. Uses up the state.
template <typename Real>
void sample_gaussians(GaussianState state, std::size_t count, std::size_t rows, Real* pulse_re, Real* pulse_im);

/// Adds the pulses that sample_gaussians sampled, times the kernel of their columns, to the planes (rows x stride).
template <typename Real>
void grid_samples(GaussianPositions<Real> positions, std::size_t count, const Real* pulse_re, const Real* pulse_im,
                  std::size_t rows, const PolynomialPieces<Real>& columns_of, Real* x_re, Real* x_im,
                  std::size_t stride);

/// A time axis, and the half length of pulses on it: half sqrt(max(1, 1 + growth delay)). reached_bins writes the
/// samples [begin, end) within the half length of each delay, clipped to [first, last); begin >= end if there are none.
struct PulseAxis {
  double start, step, half, growth, first, last;
};
void reached_bins(const double* delay, std::size_t count, const PulseAxis& axis, std::uint32_t* begin,
                  std::uint32_t* end);

}  // namespace insonify::kernels
