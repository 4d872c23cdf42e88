// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize.hpp"

#include "acoustics/echo_stream.hpp"
#include "beamforming/engine.hpp"
#include "beamforming/synthesizer.hpp"

namespace insonify {

ComplexGrid synthesize(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options) {
  return Synthesizer(head, medium, method, options).pressure(echoes);
}

ComplexGrid synthesize(const EchoStream& stream, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options) {
  return Synthesizer(head, medium, method, options).pressure(stream);
}

bool streamed(const SonarHead& head, SynthesisMethod method) { return engine_of(method).streams(head); }

}  // namespace insonify
