#pragma once
#include <vector>

#include "beamforming/narrow_band/gridding_plan_internal.hpp"

namespace insonify {

/// Relative errors of the kernels over u and over v.
struct PlanarTolerance {
  double u, v;
};

/// Constants of the gridded synthesis of a planar array in one precision (E13, E56). The grid over u is that of a line
/// array. Over v, upwards, it consists of lines: `cycle` of them to one cycle of the phase between neighbours of the
/// column. Each row of beams is a weighted sum of all lines, then the image of a line array.
template <typename Real>
struct PlanarPlan {
  GriddingPlan<Real> across;  ///< the line array, with all beams of the head
  GriddingKernel kernel;      ///< over v
  PolynomialPieces<Real> lines_of;
  std::size_t cycle, lines;  ///< line grid_pad + j is step j of the cycle, with grid_pad more on either side
  double cycles_per_v, element_offset;
  std::vector<FanRow> rows;
  std::vector<Real> weight;  ///< rows x lines

  PlanarPlan(const SonarHead& head, const Medium& medium, double tolerance, PlanarTolerance kernels);

 private:
  void plan_rows(const LineArray& column);
};

}  // namespace insonify
