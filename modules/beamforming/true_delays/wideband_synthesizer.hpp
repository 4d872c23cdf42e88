// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "acoustics/echo_stream.hpp"
#include "beamforming/synthesize.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Complex baseband pressure of many pings of one head as its elements receive it: with true delays, focused at every
/// range (E61, E62), whatever the band, to a relative L2 error below the tolerance (E68). What element_series and
/// beam_from_elements give, at about the cost of gridding:
///
///   1. Time is cut into blocks, shorter the nearer; each echo belongs to one. Its pulse, sampled as finely as its band
///      needs, is gridded once over direction.
///   2. The bend of wavefronts over a block is a short sum of products of one factor along direction and time, one along
///      the rows of harmonics, and powers of frequency (BendSeries). The first multiplies the grid; a transform over
///      direction makes harmonics of it, whose sums for each power are transformed over time; between harmonics the
///      elements are interpolated, frequency by frequency.
///   3. Beams are formed from the elements by the same steps in reverse, with their own sum.
///
/// A head of one beam with a Gaussian pulse reads its responses from tables instead (OneBeam, E134).
///
/// Cost relative to PingSynthesizer: docs/results/accuracy.md. Plans and sums are made at the first ping that needs
/// them. Echoes whose pulses begin nearer than max(3, sqrt(f_c / 2.4 B)) lengths of the array are summed element by
/// element, which is slow; so are those where wavefronts bend too fast for the shortest block or over a long pulse.
/// Error: of fans relative to the level of a block; of 256 elements within 3 m up to 1.7e-4, whatever the tolerance.
/// Sweeps have no sharp band: held by a test at 1e-2.
///
/// Made once per head, medium and tolerance; `pressure` is const and may be called from several threads.
class WidebandSynthesizer {
 public:
  /// Throws Error for an invalid head or medium, a head with several elevations or a column, or a tolerance outside
  /// [1e-5, 0.1].
  WidebandSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});
  ~WidebandSynthesizer();
  WidebandSynthesizer(WidebandSynthesizer&&) noexcept;
  WidebandSynthesizer& operator=(WidebandSynthesizer&&) noexcept;

  /// beams x bins [Pa]; the bits do not depend on the number of threads. Throws Error for a NaN in an echo, named by
  /// its number, and for |u| > 1.
  ComplexGrid pressure(const Echoes& echoes) const;
  /// The same, to the byte, of echoes that are made chunk by chunk, of a head and a scene at rest: delay = 2 range / c.
  /// Chunks are made again for each block that they reach into; memory does not grow with their number.
  ComplexGrid pressure(const EchoStream& stream) const;

  /// |u| of echoes up to which one plan is used; for others there is one of all directions.
  static double usual_extent(const SonarHead& head);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// A WidebandSynthesizer made for this one image. Throws Error as it does.
ComplexGrid synthesize_true_delays(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const SynthesisOptions& options = {});

}  // namespace insonify
