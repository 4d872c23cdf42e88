// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesizer.hpp"

#include <utility>

#include "acoustics/echo_stream.hpp"
#include "beamforming/engine.hpp"
#include "beamforming/numerics/lazy_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"

namespace insonify {

Synthesizer::Synthesizer(SonarHead head, const Medium& medium, SynthesisMethod method, const SynthesisOptions& options)
    : head_(std::move(head)),
      medium_(medium),
      engine_(&engine_of(method)),
      options_(options),
      kept_(std::make_shared<Lazy<const ImageEngine>>()) {
  require_synthesis({}, head_, medium_, options_, "synthesize");
  if (!engine_->suits(head_)) require_one_row(head_, "synthesize");
}

const ImageEngine& Synthesizer::kept(const SonarHead& head) const {
  return kept_->get([&] { return engine_->make(head, medium_, options_); });
}

ComplexGrid Synthesizer::pressure(const Echoes& echoes) const {
  require_synthesis(echoes, head_, medium_, options_, "synthesize");
  if (engine_->whole_head(head_)) return kept(head_).pressure(echoes);
  const std::size_t rows = fan_rows(head_.fan).size();
  const double cutoff = engine_->receives_all_rows ? 0 : row_cutoff(options_.tolerance, rows);
  // One of many rows is made for this image alone.
  return image_by_rows<ComplexGrid>(
      echoes, head_, medium_, cutoff, options_.threads, [&](const Echoes& of_row, const SonarHead& row) {
        return rows == 1 ? kept(row).pressure(of_row) : engine_->make(row, medium_, options_)->pressure(of_row);
      });
}

ComplexGrid Synthesizer::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  if (!engine_->streams(head_)) return pressure(all_echoes(stream));
  return kept(head_).pressure(stream);
}

}  // namespace insonify
