// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/echo_stream.hpp"
#include "beamforming/gridded/beam_transform_internal.hpp"
#include "beamforming/gridded/grid_tile_internal.hpp"
#include "beamforming/gridded/gridding_plan_internal.hpp"
#include "beamforming/numerics/tile_pool_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

/// An image, and the fraction of the gridded energy that it contains.
struct GriddedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// sqrt(mean energy per beam / energy of all gridded pulses): 0.1 if 5 of 500 beams receive an echo. Kernel errors
  /// are distributed evenly over all beams, so a smaller value means a larger relative error. 1 if there are no echoes.
  double share = 0;
};

/// The gridded synthesis of GriddedEngine in one precision.
template <typename Real>
class GriddedSynthesis {
 public:
  GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                   KernelTolerance kernels);
  /// Returns the image. One thread computes each tile of bins: it grids the echoes in their order and forms the beams.
  GriddedImage image(const Echoes& echoes) const;
  /// Returns the same for echoes that are not stored. Each thread takes one slab of neighbouring tiles after another,
  /// visits the chunks that reach into the slab in order, and forms the beams.
  GriddedImage image(const EchoStream& stream) const;
  const SynthesisChoice& choice() const { return plan_.choice; }

 private:
  GriddingPlan<Real> plan_;
  int threads_;
  BeamTransform<Real> to_beams_;
  mutable TilePool<GridTile<Real>> tiles_;
};

}  // namespace insonify
