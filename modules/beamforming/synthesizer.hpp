// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "beamforming/synthesize.hpp"

namespace insonify {

class ImageEngine;
struct Engine;
template <typename Thing>
class Lazy;

/// Forms the beams of one head in one medium by one method for many images. The first image makes plans, tables,
/// transforms and buffers; later images reuse them. Methods, errors and bytes of an image are those of `synthesize`.
/// Copies share what has been made. Several threads may call `pressure` at once. With true delays the object holds 10
/// to 100 MB, and each working thread holds the blocks of one more image.
class Synthesizer {
 public:
  /// Throws Error for an invalid head, medium or tolerance.
  Synthesizer(SonarHead head, const Medium& medium, SynthesisMethod method = SynthesisMethod::gridded,
              const SynthesisOptions& options = {});

  /// Returns the complex baseband pressure of the echoes, beams x bins [Pa]. Throws Error as `synthesize` does.
  ComplexGrid pressure(const Echoes& echoes) const;
  /// Returns the same for echoes that `stream` makes chunk by chunk. If head and method are not `streamed`, the call
  /// makes and stores all echoes first.
  ComplexGrid pressure(const EchoStream& stream) const;

 private:
  const ImageEngine& kept(const SonarHead& head) const;

  SonarHead head_;
  Medium medium_;
  const Engine* engine_;
  SynthesisOptions options_;
  std::shared_ptr<const Lazy<const ImageEngine>> kept_;  ///< made for the first image of a head, or of its only row
};

}  // namespace insonify
