// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/numerics/kernel_lanes_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

#define INSONIFY_INLINE [[gnu::always_inline]] inline

/// Evaluates the polynomials of `count` lanes from `first` on, by Horner's rule.
template <typename Real>
INSONIFY_INLINE void evaluate_some(Pieces<Real> p, std::size_t first, std::size_t count, Real t, Real* value) {
  using Part = typename Register<Real>::Type;
  constexpr std::size_t at_once = sizeof(Part) / sizeof(Real);
  for (std::size_t l = 0; l < count; l += at_once) {
    const Real* c = p.coefficient + first + l;
    Part part, next;
    __builtin_memcpy(&part, c, sizeof part);
    for (std::size_t k = 1; k <= p.degree; ++k) {
      __builtin_memcpy(&next, c + k * p.lanes, sizeof next);
      part = part * t + next;
    }
    __builtin_memcpy(value + l, &part, sizeof part);
  }
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void grid_some(Real re, Real im, Real row_offset, Real column_offset, Pieces<Real> pulse_re,
                               Pieces<Real> pulse_im, std::size_t first, std::size_t rows, Pieces<Real> columns_of,
                               Real* __restrict scratch, Real* x_re, Real* x_im, std::size_t stride) {
  const KernelLanes<lanes, Real> kernel(columns_of, column_offset);
  Real *g_re = scratch, *g_im = scratch + rows + 16;
  evaluate_some(pulse_re, first, rows, row_offset, g_re);
  evaluate_some(pulse_im, first, rows, row_offset, g_im);
  for (std::size_t n = 0; n < rows; ++n) {
    kernel.add(re * g_re[n] - im * g_im[n], x_re + n * stride);
    kernel.add(re * g_im[n] + im * g_re[n], x_im + n * stride);
  }
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void grid_samples(const double* pulse_re, const double* pulse_im, std::size_t rows, Real offset,
                                  Pieces<Real> columns_of, Real* x_re, Real* x_im, std::size_t stride) {
  const KernelLanes<lanes, Real> kernel(columns_of, offset);
  for (std::size_t n = 0; n < rows; ++n) {
    kernel.add(static_cast<Real>(pulse_re[n]), x_re + n * stride);
    kernel.add(static_cast<Real>(pulse_im[n]), x_im + n * stride);
  }
}

template <typename Real>
INSONIFY_INLINE void interpolate_rows(const Real* weight, const std::uint32_t* row, std::size_t terms, const Real* grid,
                                      std::size_t stride, std::size_t count, double* sum) {
  // Blocks of samples stay in registers while the terms are added.
  constexpr std::size_t block = 32;
  std::size_t n = 0;
  for (; n + block <= count; n += block) {
    Real part[block] = {};
    for (std::size_t k = 0; k < terms; ++k) {
      const Real* x = grid + row[k] * stride + n;
      for (std::size_t l = 0; l < block; ++l) part[l] += weight[k] * x[l];
    }
    for (std::size_t l = 0; l < block; ++l) sum[n + l] = static_cast<double>(part[l]);
  }
  for (; n < count; ++n) {
    Real part = 0;
    for (std::size_t k = 0; k < terms; ++k) part += weight[k] * grid[row[k] * stride + n];
    sum[n] = static_cast<double>(part);
  }
}

}  // namespace

INSONIFY_CLONES
void grid_pulse_rows(float re, float im, float row_offset, float column_offset, Pieces<float> pulse_re,
                     Pieces<float> pulse_im, std::size_t first, std::size_t rows, Pieces<float> columns_of,
                     float* scratch, float* x_re, float* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_some<8>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                 stride);
  else
    grid_some<16>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                  stride);
}

INSONIFY_CLONES
void grid_pulse_rows(double re, double im, double row_offset, double column_offset, Pieces<double> pulse_re,
                     Pieces<double> pulse_im, std::size_t first, std::size_t rows, Pieces<double> columns_of,
                     double* scratch, double* x_re, double* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_some<8>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                 stride);
  else
    grid_some<16>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                  stride);
}

INSONIFY_CLONES
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, float offset,
                        Pieces<float> columns_of, float* x_re, float* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_samples<8>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
  else
    grid_samples<16>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
}

INSONIFY_CLONES
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, double offset,
                        Pieces<double> columns_of, double* x_re, double* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_samples<8>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
  else
    grid_samples<16>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
}

INSONIFY_CLONES
void interpolate(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                 std::size_t stride, std::size_t count, double* sum) {
  interpolate_rows(weight, row, terms, grid, stride, count, sum);
}

INSONIFY_CLONES
void interpolate(const double* weight, const std::uint32_t* row, std::size_t terms, const double* grid,
                 std::size_t stride, std::size_t count, double* sum) {
  interpolate_rows(weight, row, terms, grid, stride, count, sum);
}

}  // namespace insonify::kernels
