// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time. They do not include
// Eigen, so wide registers are safe; without fused multiply-add all variants give the same bits.
namespace insonify::kernels {

/// Polynomial coefficients of all columns or rows of one echo: (degree + 1) x lanes, highest power first.
template <typename Real>
struct Pieces {
  const Real* coefficient;
  std::size_t degree, lanes;
};

/// Adds one echo with a complex pulse, of which only rows [first, first + rows) are gridded; x_re and x_im point to the
/// first of them. `scratch` holds 2 (rows + 16) numbers.
void grid_pulse_rows(float re, float im, float row_offset, float column_offset, Pieces<float> pulse_re,
                     Pieces<float> pulse_im, std::size_t first, std::size_t rows, Pieces<float> columns_of,
                     float* scratch, float* x_re, float* x_im, std::size_t stride);
void grid_pulse_rows(double re, double im, double row_offset, double column_offset, Pieces<double> pulse_re,
                     Pieces<double> pulse_im, std::size_t first, std::size_t rows, Pieces<double> columns_of,
                     double* scratch, double* x_re, double* x_im, std::size_t stride);

/// Adds one echo whose complex pulse is given sample by sample.
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, float column_offset,
                        Pieces<float> columns_of, float* x_re, float* x_im, std::size_t stride);
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, double column_offset,
                        Pieces<double> columns_of, double* x_re, double* x_im, std::size_t stride);

/// Computes sum(n) = sum_k weight[k] grid[row[k] * stride + n] for n < count: one beam from the rows of a grid.
void interpolate(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                 std::size_t stride, std::size_t count, double* sum);
void interpolate(const double* weight, const std::uint32_t* row, std::size_t terms, const double* grid,
                 std::size_t stride, std::size_t count, double* sum);

}  // namespace insonify::kernels
