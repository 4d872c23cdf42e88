// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

constexpr std::size_t grid_pad = 16;  ///< padding steps on either side of a grid over u or v

/// Relative errors of the kernels over u and, of planar arrays, over v.
struct KernelTolerance {
  double u, v;
};

/// The grid over v of a planar array (E13, E56), upwards. `cycle` lines cover one cycle of the phase between neighbours
/// of the column, and each line is a grid over u. A weighted sum of all lines gives a row of beams, which is then the
/// image of a line array.
template <typename Real>
struct ColumnPlan {
  GriddingKernel kernel;
  PolynomialPieces<Real> pieces;
  std::size_t cycle, lines;  ///< line grid_pad + j is step j of the cycle; grid_pad lines pad either side
  double cycles_per_v, element_offset;
  std::vector<Real> weight;  ///< rows x lines

  ColumnPlan(const SonarHead& head, const Medium& medium, const std::vector<FanRow>& rows, double kernel_tolerance);
};

}  // namespace insonify
