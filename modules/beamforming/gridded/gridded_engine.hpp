// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "beamforming/engine.hpp"
#include "beamforming/gridded/synthesis_choice.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The smallest tolerance that gridding can keep.
constexpr double min_gridding_tolerance = 1e-13;

/// Synthesizes the complex baseband pressure of many pings of one head by gridding (E13), to a guaranteed relative L2
/// error:
///
///   1. Each echo adds its pulse, cut at the tolerance, times a kernel (E60) to a grid over direction.
///   2. An FFT per bin transforms the grid into element series, which are deconvolved and shaded.
///   3. A second FFT transforms the series back, and the same kernel interpolates the beams.
///
/// There is no transform along range, so there is no wrap-around, and the error is relative to the level at each range.
/// The cost is echoes x pulse samples x kernel width + bins x (grid log grid + beams x kernel width).
///
/// The grid of a planar array (E56) also has lines over v, and each row of beams is a weighted sum of these lines. The
/// cost is echoes x pulse samples x the widths of both kernels, plus the transforms of each row.
///
/// Kernel errors are distributed evenly over all beams. For the same tolerance a fan of many narrow beams therefore
/// needs a wider kernel.
///
/// Construct one object per head, medium and tolerance. Several threads may call `pressure` at once.
class GriddedEngine final : public ImageEngine {
 public:
  /// Returns whether one grid serves all beams of a head. It does for one row of beams of a line array and for a planar
  /// array with Gaussian pulses.
  static bool suits(const SonarHead& head);

  /// Throws Error for an invalid head or medium, a head that does not suit, or a tolerance outside [1e-13, 1).
  GriddedEngine(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});

  /// Returns the image, beams x bins [Pa]. Echoes that cancel, or that lie outside all beams, make the image weak
  /// compared with its echoes. If the tolerance may then be exceeded, the image is computed again with a lower
  /// tolerance. Throws Error for a NaN in an echo, with the index of the echo, and for echoes of a planar array without
  /// v.
  ComplexGrid pressure(const Echoes& echoes) const override;
  /// Returns the same for echoes that `stream` makes chunk by chunk. Head and scene must be at rest: delay = 2 range /
  /// c. A chunk is made again for each slab of bins that it reaches into.
  ComplexGrid pressure(const EchoStream& stream) const override;

  /// Returns what the constructor has chosen for head, medium and tolerance.
  SynthesisChoice choice() const;

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

/// Returns the parameters that a GriddedEngine chooses for the first row of beams of any head.
SynthesisChoice choice_of_a_row(const SonarHead& head, const Medium& medium, const SynthesisOptions& options);

}  // namespace insonify
