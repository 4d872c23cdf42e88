#include "beamforming/synthesize.hpp"

#include "beamforming/kept_synthesizers.hpp"
#include "beamforming/narrow_band/planar_synthesizer_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"

namespace insonify {
namespace {

ComplexGrid synthesize_line(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                            const SynthesisOptions& options, KeptSynthesizers& kept) {
  switch (method) {
    case SynthesisMethod::direct:
      return synthesize_direct(echoes, head, medium, options);
    case SynthesisMethod::spectrum:
      return synthesize_spectrum(echoes, head, medium, options);
    case SynthesisMethod::element_exact: {
      const ElementOptions exact{options.tolerance, Wavefront::spherical, options.threads};
      return beam_from_elements(element_series(echoes, head, medium, exact), head, medium, exact);
    }
    case SynthesisMethod::true_delays:
      return kept.true_delays(head, medium, options)->pressure(echoes);
    case SynthesisMethod::incoherent:
      return synthesize_intensity(echoes, head, medium, options).sqrt().cast<std::complex<double>>();
    case SynthesisMethod::gridded:
      break;
  }
  return kept.narrow_band(head, medium, options)->pressure(echoes);
}

}  // namespace

ComplexGrid synthesize(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options, KeptSynthesizers* kept) {
  require_synthesis(echoes, head, medium, options, "synthesize");
  // Many rows would drop one another.
  const std::size_t rows = fan_rows(head.fan).size();
  KeptSynthesizers here(0);
  KeptSynthesizers& from = kept ? *kept : here;
  if (method == SynthesisMethod::gridded && PlanarSynthesizer::suits(head, options))
    return from.planar(head, medium, options)->pressure(echoes);
  const double cutoff = method == SynthesisMethod::direct ? 0 : row_cutoff(options.tolerance, rows);
  return image_by_rows<ComplexGrid>(
      echoes, head, medium, cutoff, options.threads, [&](const Echoes& of_row, const SonarHead& line) {
        return synthesize_line(of_row, line, medium, method, options, rows == 1 ? from : here);
      });
}

ComplexGrid synthesize(const EchoSource& source, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options, KeptSynthesizers* kept) {
  require_synthesis({}, head, medium, options, "synthesize");
  if (source.stored) return synthesize(*source.stored, head, medium, method, options, kept);
  const bool planar = PlanarSynthesizer::suits(head, options);
  if (!streamed(head, method) || (head.column && !planar))
    return synthesize(all_echoes(source), head, medium, method, options, kept);
  KeptSynthesizers here(0);
  KeptSynthesizers& from = kept ? *kept : here;
  if (method == SynthesisMethod::true_delays) return from.true_delays(head, medium, options)->pressure_of(source);
  if (planar) return from.planar(head, medium, options)->pressure_of(source);
  return from.narrow_band(head, medium, options)->pressure_of(source);
}

bool streamed(const SonarHead& head, SynthesisMethod method) {
  const bool line = !head.column && fan_rows(head.fan).size() == 1;
  if (method == SynthesisMethod::true_delays) return line;
  return method == SynthesisMethod::gridded && (head.column ? head.pulse.shape == PulseShape::gaussian : line);
}

}  // namespace insonify
