// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesizer.hpp"

#include <mutex>
#include <optional>
#include <utility>

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/ping_synthesizer.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"

namespace insonify {
namespace {

/// An object that the first caller makes.
template <typename Made>
class Once {
 public:
  const Made& of(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
    std::call_once(flag_, [&] { made_.emplace(head, medium, options); });
    return *made_;
  }

 private:
  std::once_flag flag_;
  std::optional<Made> made_;
};

}  // namespace

/// What methods make once: each method uses one of them.
struct Synthesizer::Engines {
  Once<PingSynthesizer> narrow_band;
  Once<WidebandSynthesizer> true_delays;
};

Synthesizer::Synthesizer(SonarHead head, const Medium& medium, SynthesisMethod method, const SynthesisOptions& options)
    : head_(std::move(head)),
      medium_(medium),
      method_(method),
      options_(options),
      engines_(std::make_shared<Engines>()) {
  require_synthesis({}, head_, medium_, options_, "synthesize");
}

ComplexGrid Synthesizer::pressure_of_row(const Echoes& echoes, const SonarHead& row, bool only_row) const {
  switch (method_) {
    case SynthesisMethod::direct:
      return synthesize_direct(echoes, row, medium_, options_);
    case SynthesisMethod::spectrum:
      return synthesize_spectrum(echoes, row, medium_, options_);
    case SynthesisMethod::element_exact: {
      const ElementOptions exact{options_.tolerance, Wavefront::spherical, options_.threads};
      return beam_from_elements(element_series(echoes, row, medium_, exact), row, medium_, exact);
    }
    case SynthesisMethod::incoherent:
      return synthesize_intensity(echoes, row, medium_, options_).sqrt().cast<std::complex<double>>();
    // One of many rows is made for this image alone.
    case SynthesisMethod::true_delays:
      return only_row ? engines_->true_delays.of(row, medium_, options_).pressure(echoes)
                      : WidebandSynthesizer(row, medium_, options_).pressure(echoes);
    case SynthesisMethod::gridded:
      break;
  }
  return PingSynthesizer(row, medium_, options_).pressure(echoes);
}

ComplexGrid Synthesizer::pressure(const Echoes& echoes) const {
  require_synthesis(echoes, head_, medium_, options_, "synthesize");
  if (method_ == SynthesisMethod::gridded && PingSynthesizer::suits(head_))
    return engines_->narrow_band.of(head_, medium_, options_).pressure(echoes);
  const std::size_t rows = fan_rows(head_.fan).size();
  const double cutoff = method_ == SynthesisMethod::direct ? 0 : row_cutoff(options_.tolerance, rows);
  return image_by_rows<ComplexGrid>(
      echoes, head_, medium_, cutoff, options_.threads,
      [&](const Echoes& of_row, const SonarHead& row) { return pressure_of_row(of_row, row, rows == 1); });
}

ComplexGrid Synthesizer::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  if (!streamed(head_, method_)) return pressure(all_echoes(stream));
  if (method_ == SynthesisMethod::true_delays)
    return engines_->true_delays.of(head_, medium_, options_).pressure(stream);
  return engines_->narrow_band.of(head_, medium_, options_).pressure(stream);
}

}  // namespace insonify
