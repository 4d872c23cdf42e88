#include "beamforming/synthesize.hpp"

#include "acoustics/echo_stream.hpp"
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
  const bool line = !head.column && fan_rows(head.fan).size() == 1;
  if (method == SynthesisMethod::true_delays) return line;
  return method == SynthesisMethod::gridded && (head.column ? head.pulse.shape == PulseShape::gaussian : line);
}

}  // namespace insonify
