// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include "beamforming/gridded/brick_loops_internal.hpp"
#include "beamforming/numerics/kernel_lanes_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t most_lines = 16;

template <typename Real>
using Wide = typename Register<Real, 64>::Type;

template <typename Real>
[[gnu::always_inline]] inline void add_weighted(Real* const* brick, std::size_t count, const Real* weight,
                                                std::size_t offset, Wide<Real>* sum) {
  for (std::size_t k = 0; k < count; ++k) {
    Wide<Real> x;
    std::memcpy(&x, brick[k] + offset, sizeof x);
    for (std::size_t r = 0; r < rows_at_once; ++r) sum[r] += weight[k * rows_at_once + r] * x;
  }
}

}  // namespace

template <typename Real>
INSONIFY_CLONES void grid_bricks(BrickEchoes<Real> e, std::size_t first, std::size_t last, std::size_t count,
                                 std::size_t rows, const PolynomialPieces<Real>& columns_of,
                                 const PolynomialPieces<Real>& lines_of, std::size_t lines, std::size_t plane) {
  for (std::size_t i = first; i < last; ++i) {
    Real of_line[most_lines];
    with_kernel(lines_of, e.line_offset[i], [&](const auto& kernel) INSONIFY_INLINE_LAMBDA { kernel.store(of_line); });
    with_kernel(columns_of, e.column_offset[i], [&](const auto& of_column) INSONIFY_INLINE_LAMBDA {
      for (std::size_t k = 0; k < lines; ++k) {
        const Real factor = e.sign[i] * of_line[k];
        Real* to_re = e.brick[i * lines + k];
        Real* to_im = to_re + plane;
        for (std::size_t n = 0; n < rows; ++n, to_re += brick_stride, to_im += brick_stride) {
          of_column.add(e.pulse_re[n * count + i] * factor, to_re);
          of_column.add(e.pulse_im[n * count + i] * factor, to_im);
        }
      }
    });
  }
}

template <typename Real>
INSONIFY_CLONES void weigh_bricks(BrickColumn<Real> bricks, std::size_t offset, Real* rows, std::size_t row_stride) {
  constexpr std::size_t lanes = 64 / sizeof(Real);
  for (std::size_t c = 0; c < brick_columns; c += lanes) {
    Wide<Real> sum[rows_at_once] = {};
    add_weighted(bricks.own, bricks.owns, bricks.own_weight, offset + c, sum);
    if (c < brick_overlap)
      add_weighted(bricks.before, bricks.befores, bricks.before_weight, offset + brick_columns + c, sum);
    for (std::size_t r = 0; r < rows_at_once; ++r) std::memcpy(rows + r * row_stride + c, &sum[r], sizeof sum[r]);
  }
}

#define INSONIFY_LOOPS(Real)                                                                                         \
  template void grid_bricks(BrickEchoes<Real>, std::size_t, std::size_t, std::size_t, std::size_t,                   \
                            const PolynomialPieces<Real>&, const PolynomialPieces<Real>&, std::size_t, std::size_t); \
  template void weigh_bricks(BrickColumn<Real>, std::size_t, Real*, std::size_t)
INSONIFY_LOOPS(float);
INSONIFY_LOOPS(double);

}  // namespace insonify::kernels
