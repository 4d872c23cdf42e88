// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/synthesis_choice.hpp"
#include "beamforming/synthesize.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The smallest tolerance that gridding can keep.
constexpr double min_gridding_tolerance = 1e-13;

/// Synthesizes the complex baseband pressure of many pings of one head by gridding (E13), to a guaranteed relative L2
/// error: each echo adds its pulse, cut at the tolerance, times a kernel (E60) to a grid over direction; per bin an FFT
/// transforms the grid into element series, which are deconvolved and shaded, and transformed and interpolated back to
/// beams with the same kernel. There is no transform along range, hence no wrap-around, and the error is local:
/// relative to the level at each range. Cost: echoes x pulse samples x kernel width + bins x (grid log grid + beams x
/// kernel width). The grid of a planar array (E56) has lines over v too, and each row of beams is a weighted sum of
/// them: echoes x pulse samples x widths of both kernels, and the transforms for each row. Kernel errors are
/// distributed evenly over all beams: for the same tolerance, a fan of many narrow beams needs a wider kernel.
///
/// Constructed once per head, medium and tolerance; `pressure` is const and may be called concurrently.
class PingSynthesizer {
 public:
  /// Whether a head is gridded at once: one row of beams of a line array, or a planar array with Gaussian pulses.
  static bool suits(const SonarHead& head);

  /// Throws Error for an invalid head or medium, a head that does not suit, or a tolerance outside [1e-13, 1).
  PingSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});
  ~PingSynthesizer();
  PingSynthesizer(PingSynthesizer&&) noexcept;
  PingSynthesizer& operator=(PingSynthesizer&&) noexcept;

  /// Returns the image, beams x bins [Pa]. If the image is so weak relative to its echoes (they cancel, or lie outside
  /// of all beams) that the tolerance may be exceeded, it is computed again with a lower one. Throws Error for a NaN in
  /// an echo, with the echo's index, and for echoes of a planar array without v.
  ComplexGrid pressure(const Echoes& echoes) const;
  /// The same of echoes that are made chunk by chunk, of a head and a scene at rest: delay = 2 range / c. Chunks are
  /// made again for each slab of bins that they reach into.
  ComplexGrid pressure(const EchoStream& stream) const;

  /// Returns what the constructor has chosen for head, medium and tolerance.
  SynthesisChoice choice() const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// What a PingSynthesizer chooses for the first row of beams of any head.
SynthesisChoice choice_of_a_row(const SonarHead& head, const Medium& medium, const SynthesisOptions& options);

}  // namespace insonify
