// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

#include "beamforming/numerics/gridding_kernel_internal.hpp"

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time. They do not include
// Eigen, so wide registers are safe; without fused multiply-add all variants give the same bits.
namespace insonify::kernels {

/// Evaluates `count` pieces from `first` on at t in [-1, 1], by Horner's rule; `value` has room for seven more.
template <typename Real>
void evaluate_pieces(const PolynomialPieces<Real>& pieces, std::size_t first, std::size_t count, Real t, Real* value);

/// Adds one echo whose complex pulse is given sample by sample.
template <typename Real>
void grid_sampled_pulse(const Real* pulse_re, const Real* pulse_im, std::size_t rows, Real column_offset,
                        const PolynomialPieces<Real>& columns_of, Real* x_re, Real* x_im, std::size_t stride);

/// Computes sum(n) = sum_k weight[k] grid[row[k] * stride + n] for n < count: one beam from the rows of a grid.
template <typename Real>
void interpolate(const Real* weight, const std::uint32_t* row, std::size_t terms, const Real* grid, std::size_t stride,
                 std::size_t count, double* sum);

}  // namespace insonify::kernels
