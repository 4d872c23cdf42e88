// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

#include "beamforming/numerics/gridding_kernel_internal.hpp"

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

constexpr std::size_t brick_columns = 64, brick_overlap = 16;        // of lanes that begin in the columns
constexpr std::size_t brick_stride = brick_columns + brick_overlap;  // of the rows of a brick
constexpr std::size_t rows_at_once = 6;                              // of beams

/// Echoes on the grid of a planar array, one entry per echo in every array; samples as GaussianBatch.
template <typename Real>
struct BrickEchoes {
  Real* const* brick;  ///< brick at its first row and column, `lines` of them per echo; imaginary parts `plane` on
  const Real* column_offset;  ///< t in [-1, 1] for the polynomials of the columns
  const Real* line_offset;    ///< t in [-1, 1] for the polynomials of the lines
  const Real* sign;           ///< sign due to whole cycles: +1 or -1
  const Real *pulse_re, *pulse_im;
};

/// Adds pulse(row) x kernel(column) x kernel(line) of echoes [first, last) of `count` to their bricks, `rows` samples
/// each.
template <typename Real>
void grid_bricks(BrickEchoes<Real> echoes, std::size_t first, std::size_t last, std::size_t count, std::size_t rows,
                 const PolynomialPieces<Real>& columns_of, const PolynomialPieces<Real>& lines_of, std::size_t lines,
                 std::size_t plane);

/// Bricks of one block of columns, line by line, and those of the block before it, whose overlap reaches into this one.
template <typename Real>
struct BrickColumn {
  Real* const* own;
  std::size_t owns;
  Real* const* before;
  std::size_t befores;
  const Real *own_weight, *before_weight;  ///< brick x rows_at_once
};

/// Sets rows_at_once rows, `row_stride` apart, of brick_columns numbers: sum of weight x brick, `offset` numbers after
/// its beginning.
template <typename Real>
void weigh_bricks(BrickColumn<Real> bricks, std::size_t offset, Real* rows, std::size_t row_stride);

}  // namespace insonify::kernels
