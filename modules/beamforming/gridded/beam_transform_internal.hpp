// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "beamforming/gridded/gridding_plan_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

/// Echoes on the grid of a tile of bins, real and imaginary parts: a row per bin, with grid_pad columns on either side.
template <typename Real>
struct GridPlanes {
  Real *re, *im;
  std::size_t stride;
};

/// Second half of the gridded synthesis: from a grid over direction to elements, and from elements to beams.
template <typename Real>
class BeamTransform {
 public:
  /// Keeps a reference to `plan`.
  explicit BeamTransform(const GriddingPlan<Real>& plan);

  /// Writes bins [first, last) of `beams` (indices in the head's fan), times `unit`, and returns their energy [unit^2
  /// bins]. Overwrites the planes of plan.tile_bins rows. `grid` is working memory for plan.grid x plan.grid_row
  /// numbers.
  double run(GridPlanes<Real> planes, std::complex<Real>* grid, std::span<const std::size_t> beams, double unit,
             std::size_t first, std::size_t last, ComplexGrid& pressure) const;

 private:
  void wrap_and_transpose(GridPlanes<Real> planes, std::complex<Real>* grid) const;

  const GriddingPlan<Real>& plan_;
  Fft<Real> to_elements_, to_beams_;
};

}  // namespace insonify
