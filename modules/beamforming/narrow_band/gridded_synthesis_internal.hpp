// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/beam_transform_internal.hpp"
#include "beamforming/narrow_band/grid_tile_internal.hpp"
#include "beamforming/narrow_band/gridding_plan_internal.hpp"
#include "beamforming/numerics/tile_pool_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

/// An image, and the fraction of the gridded energy that it contains.
struct GriddedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy per beam over that of all gridded pulses: 0.1 for a fan of 500 beams of which 5 receive an
  /// echo. Kernel errors are distributed evenly over all beams, so the smaller this fraction, the larger the relative
  /// error. 1 if there are no echoes.
  double share = 0;
};

/// The gridded synthesis of PingSynthesizer in one precision.
template <typename Real>
class GriddedSynthesis {
 public:
  GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                   KernelTolerance kernels);
  /// Each tile of bins is computed by one thread, which grids its echoes in their order and forms its beams.
  GriddedImage image(const Echoes& echoes) const;
  /// The same of echoes that are not stored: each thread forms the beams of one slab of neighbouring tiles after
  /// another, and visits the chunks that reach into it, in order.
  GriddedImage image(const EchoStream& stream) const;
  const SynthesisChoice& choice() const { return plan_.choice; }

 private:
  GriddingPlan<Real> plan_;
  int threads_;
  BeamTransform<Real> to_beams_;
  mutable TilePool<GridTile<Real>> tiles_;
};

}  // namespace insonify
