#pragma once
#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/beam_transform_internal.hpp"
#include "beamforming/narrow_band/grid_echoes_internal.hpp"
#include "beamforming/narrow_band/gridded_image_internal.hpp"
#include "beamforming/narrow_band/gridding_plan_internal.hpp"
#include "beamforming/numerics/tile_pool_internal.hpp"

namespace insonify {

/// The gridded synthesis of PingSynthesizer in one precision.
template <typename Real>
class GriddedSynthesis {
 public:
  /// kernel_tolerance   error of the kernel relative to the gridded energy
  GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                   double kernel_tolerance);
  GriddedImage image(const Echoes& echoes) const;
  /// The same of echoes that are not stored: each thread forms the beams of one slab of bins after another, and visits
  /// the chunks that reach into it, in order.
  GriddedImage image(const EchoStream& stream) const;
  const SynthesisChoice& choice() const { return plan_.choice; }
  /// Returns true if the cost model favours the direct sum over gridding for these echoes.
  bool direct_is_cheaper(const Echoes& echoes) const;
  /// The same for so many echoes of a head at rest in all of the gate.
  bool direct_is_cheaper(std::size_t echoes) const;

 private:
  PulseReach reach_of(bool moving) const;
  /// Transforms the gridded tile into beams, bins [first, last) of `pressure`, and returns their energy [unit^2 bins];
  /// then it is empty.
  double form_beams(GridTile<Real>& tile, double unit, std::size_t first, std::size_t last,
                    ComplexGrid& pressure) const;

  GriddingPlan<Real> plan_;
  int threads_;
  BeamTransform<Real> to_beams_;
  std::vector<std::size_t> beams_;  // all of the fan
  mutable TilePool<GridTile<Real>> tiles_;
};

}  // namespace insonify
