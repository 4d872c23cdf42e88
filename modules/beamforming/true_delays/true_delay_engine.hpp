// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "beamforming/engine.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The smallest tolerance that true delays keep.
constexpr double min_true_delay_tolerance = 1e-5;

/// Synthesizes the complex baseband pressure of many pings of one head with true delays, focused at every range (E61,
/// E62), for any bandwidth. The relative L2 error is below the tolerance (E68). The image is that of element_series and
/// beam_from_elements, at about the cost of gridding:
///
///   1. Time is cut into blocks, which are shorter at shorter ranges. Each echo belongs to one block. Its pulse is
///   sampled as finely as its band needs and gridded once over direction.
///   2. The wavefront curvature over a block is a short sum of products (CurvatureSeries): a factor along direction and
///   time, a factor along the rows of harmonics, and powers of frequency. The first factor multiplies the grid. A
///   transform over direction gives harmonics, and their sums for each power are transformed over time. The elements
///   are interpolated between harmonics, frequency by frequency.
///   3. The same steps in reverse, with a second sum, form the beams from the elements.
///
/// For a head of one beam with a Gaussian pulse, responses are read from tables instead (OneBeam, E134).
///
/// Cost relative to GriddedEngine: docs/results/accuracy.md. The first ping that needs plans and sums makes them. Two
/// kinds of echoes are summed element by element, which is slow: echoes whose pulses begin nearer than max(3, sqrt(f_c
/// / 2.4 B)) lengths of the array, and echoes where the wavefront curvature changes too fast for the shortest block or
/// over a long pulse.
///
/// The error of a fan is relative to the level of a block. The error of 256 elements within 3 m reaches 1.7e-4,
/// whatever the tolerance. Sweeps have no sharp band; a test holds them to 1e-2. At 1e-5, bands that reach to 0.95 of the
/// carrier leave 1.1e-5 on fans of 130 degrees. Echoes whose Doppler shifts the band or the curvature does not bear cost
/// up to twice as much, and those nearby are summed element by element (E191).
///
/// Construct one object per head, medium and tolerance. Several threads may call `pressure` at once.
class TrueDelayEngine final : public ImageEngine {
 public:
  /// Throws Error for an invalid head or medium, a head with several elevations or a column, or a tolerance outside
  /// [1e-5, 0.1].
  TrueDelayEngine(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});

  /// Returns the image, beams x bins [Pa]. The bits do not depend on the number of threads. Throws Error for a NaN in
  /// an echo, with the number of the echo, and for |u| > 1.
  ComplexGrid pressure(const Echoes& echoes) const override;
  /// Returns the same bytes for echoes that `stream` makes chunk by chunk. Head and scene must be at rest: delay = 2
  /// range / c. A chunk is made again for each block that it reaches into; memory does not grow with the number of
  /// chunks.
  ComplexGrid pressure(const EchoStream& stream) const override;

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

}  // namespace insonify
