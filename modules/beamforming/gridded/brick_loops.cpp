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

template <std::size_t lanes, typename Real>
[[gnu::always_inline]] inline void grid_bricks_by(const BrickEchoes<Real>& e, std::size_t first, std::size_t last,
                                                  std::size_t count, std::size_t rows, Pieces<Real> columns_of,
                                                  Pieces<Real> lines_of, std::size_t lines, std::size_t plane) {
  for (std::size_t i = first; i < last; ++i) {
    const KernelLanes<lanes, Real> of_column(columns_of, e.column_offset[i]);
    Real of_line[most_lines];
    if (lines_of.lanes == 8)
      KernelLanes<8, Real>(lines_of, e.line_offset[i]).store(of_line);
    else
      KernelLanes<16, Real>(lines_of, e.line_offset[i]).store(of_line);
    for (std::size_t k = 0; k < lines; ++k) {
      const Real factor = e.sign[i] * of_line[k];
      Real* to_re = e.brick[i * lines + k];
      Real* to_im = to_re + plane;
      for (std::size_t n = 0; n < rows; ++n, to_re += brick_stride, to_im += brick_stride) {
        of_column.add(e.pulse_re[n * count + i] * factor, to_re);
        of_column.add(e.pulse_im[n * count + i] * factor, to_im);
      }
    }
  }
}

template <typename Real>
[[gnu::always_inline]] inline void add_weighted(Real* const* brick, std::size_t count, const Real* weight,
                                                std::size_t offset, Wide<Real>* sum) {
  for (std::size_t k = 0; k < count; ++k) {
    Wide<Real> x;
    std::memcpy(&x, brick[k] + offset, sizeof x);
    for (std::size_t r = 0; r < rows_at_once; ++r) sum[r] += weight[k * rows_at_once + r] * x;
  }
}

template <typename Real>
[[gnu::always_inline]] inline void weigh(const BrickColumn<Real>& bricks, std::size_t offset, Real* rows,
                                         std::size_t row_stride) {
  constexpr std::size_t lanes = 64 / sizeof(Real);
  for (std::size_t c = 0; c < brick_columns; c += lanes) {
    Wide<Real> sum[rows_at_once] = {};
    add_weighted(bricks.own, bricks.owns, bricks.own_weight, offset + c, sum);
    if (c < brick_overlap)
      add_weighted(bricks.before, bricks.befores, bricks.before_weight, offset + brick_columns + c, sum);
    for (std::size_t r = 0; r < rows_at_once; ++r) std::memcpy(rows + r * row_stride + c, &sum[r], sizeof sum[r]);
  }
}

}  // namespace

INSONIFY_CLONES
void grid_bricks(BrickEchoes<float> echoes, std::size_t first, std::size_t last, std::size_t count, std::size_t rows,
                 Pieces<float> columns_of, Pieces<float> lines_of, std::size_t lines, std::size_t plane) {
  if (columns_of.lanes == 8)
    grid_bricks_by<8>(echoes, first, last, count, rows, columns_of, lines_of, lines, plane);
  else
    grid_bricks_by<16>(echoes, first, last, count, rows, columns_of, lines_of, lines, plane);
}

INSONIFY_CLONES
void grid_bricks(BrickEchoes<double> echoes, std::size_t first, std::size_t last, std::size_t count, std::size_t rows,
                 Pieces<double> columns_of, Pieces<double> lines_of, std::size_t lines, std::size_t plane) {
  if (columns_of.lanes == 8)
    grid_bricks_by<8>(echoes, first, last, count, rows, columns_of, lines_of, lines, plane);
  else
    grid_bricks_by<16>(echoes, first, last, count, rows, columns_of, lines_of, lines, plane);
}

INSONIFY_CLONES
void weigh_bricks(BrickColumn<float> bricks, std::size_t offset, float* rows, std::size_t row_stride) {
  weigh(bricks, offset, rows, row_stride);
}

INSONIFY_CLONES
void weigh_bricks(BrickColumn<double> bricks, std::size_t offset, double* rows, std::size_t row_stride) {
  weigh(bricks, offset, rows, row_stride);
}

}  // namespace insonify::kernels
