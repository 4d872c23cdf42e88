// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "beamforming/synthesize.hpp"

namespace insonify {

/// Forms the beams of one head in one medium by one method, image after image: plans, tables, transforms and buffers
/// are made for the first image and used again by all others. Methods and errors are those of `synthesize`, which makes
/// one for a single image; images have the same bytes. A copy shares what is made. `pressure` may be called from
/// several threads. With true delays it holds 10 to 100 MB, and for each thread at work the blocks of one image more.
class Synthesizer {
 public:
  /// Throws Error for an invalid head, medium or tolerance.
  Synthesizer(SonarHead head, const Medium& medium, SynthesisMethod method = SynthesisMethod::gridded,
              const SynthesisOptions& options = {});

  /// Returns the complex baseband pressure of the echoes, beams x bins [Pa]. Throws Error as `synthesize` does.
  ComplexGrid pressure(const Echoes& echoes) const;
  /// Returns the same of echoes that are made chunk by chunk; of a head and method that are not `streamed`, all are
  /// made first.
  ComplexGrid pressure(const EchoStream& stream) const;

 private:
  struct Engines;
  ComplexGrid pressure_of_row(const Echoes& echoes, const SonarHead& row, bool only_row) const;

  SonarHead head_;
  Medium medium_;
  SynthesisMethod method_;
  SynthesisOptions options_;
  std::shared_ptr<Engines> engines_;
};

}  // namespace insonify
