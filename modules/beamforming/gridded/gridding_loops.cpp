// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/numerics/kernel_lanes_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {

template <typename Real>
INSONIFY_CLONES void evaluate_pieces(const PolynomialPieces<Real>& p, std::size_t first, std::size_t count, Real t,
                                     Real* value) {
  using Part = typename Register<Real>::Type;
  constexpr std::size_t at_once = sizeof(Part) / sizeof(Real);
  for (std::size_t l = 0; l < count; l += at_once) {
    const Real* c = p.coefficient.data() + first + l;
    Part part, next;
    __builtin_memcpy(&part, c, sizeof part);
    for (std::size_t k = 1; k <= p.degree; ++k) {
      __builtin_memcpy(&next, c + k * p.lanes, sizeof next);
      part = part * t + next;
    }
    __builtin_memcpy(value + l, &part, sizeof part);
  }
}

template <typename Real>
INSONIFY_CLONES void grid_sampled_pulse(const Real* pulse_re, const Real* pulse_im, std::size_t rows,
                                        Real column_offset, const PolynomialPieces<Real>& columns_of, Real* x_re,
                                        Real* x_im, std::size_t stride) {
  with_kernel(columns_of, column_offset, [&](const auto& kernel) INSONIFY_INLINE_LAMBDA {
    for (std::size_t n = 0; n < rows; ++n) {
      kernel.add(pulse_re[n], x_re + n * stride);
      kernel.add(pulse_im[n], x_im + n * stride);
    }
  });
}

template <typename Real>
INSONIFY_CLONES void interpolate(const Real* weight, const std::uint32_t* row, std::size_t terms, const Real* grid,
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

#define INSONIFY_LOOPS(Real)                                                                                          \
  template void evaluate_pieces(const PolynomialPieces<Real>&, std::size_t, std::size_t, Real, Real*);                \
  template void grid_sampled_pulse(const Real*, const Real*, std::size_t, Real, const PolynomialPieces<Real>&, Real*, \
                                   Real*, std::size_t);                                                               \
  template void interpolate(const Real*, const std::uint32_t*, std::size_t, const Real*, std::size_t, std::size_t,    \
                            double*)
INSONIFY_LOOPS(float);
INSONIFY_LOOPS(double);

}  // namespace insonify::kernels
