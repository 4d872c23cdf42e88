// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize.hpp"

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/ping_synthesizer.hpp"
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

bool streamed(const SonarHead& head, SynthesisMethod method) {
  if (method == SynthesisMethod::true_delays) return !head.column && fan_rows(head.fan).size() == 1;
  return method == SynthesisMethod::gridded && PingSynthesizer::suits(head);
}

}  // namespace insonify
