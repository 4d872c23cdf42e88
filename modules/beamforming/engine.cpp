// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/engine.hpp"

#include <algorithm>

#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "beamforming/true_delays/true_delay_engine.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

/// An engine that is a function of echoes, head, medium and options.
template <auto form>
class FunctionEngine final : public ImageEngine {
 public:
  FunctionEngine(const SonarHead& head, const Medium& medium, const SynthesisOptions& options)
      : head_(head), medium_(medium), options_(options) {}
  ComplexGrid pressure(const Echoes& echoes) const override { return form(echoes, head_, medium_, options_); }

 private:
  SonarHead head_;
  Medium medium_;
  SynthesisOptions options_;
};

template <typename Made>
std::unique_ptr<const ImageEngine> made(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  return std::make_unique<const Made>(head, medium, options);
}

ComplexGrid focused_beams(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                          const SynthesisOptions& options) {
  const ElementOptions exact{options.tolerance, Wavefront::spherical, options.threads};
  return beam_from_elements(element_series(echoes, head, medium, exact), head, medium, exact);
}

ComplexGrid expected_pressure(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                              const SynthesisOptions& options) {
  return synthesize_intensity(echoes, head, medium, options).sqrt().cast<std::complex<double>>();
}

bool one_line(const SonarHead& head) { return !head.column && fan_rows(head.fan).size() == 1; }
bool any_head(const SonarHead&) { return true; }
bool no_head(const SonarHead&) { return false; }

using Method = SynthesisMethod;
using Model = ImageModel;

constexpr Engine engine_table[] = {
    {Method::gridded, "gridded", "narrow band, far field", Model::narrow_band, Method::direct, min_gridding_tolerance,
     1, true, false, has_line, GriddedEngine::suits, GriddedEngine::suits, made<GriddedEngine>},
    {Method::true_delays, "true-delays", "wide band and near field, slow within three array lengths",
     Model::true_delays, Method::element_exact, min_true_delay_tolerance, max_element_tolerance, false, false, has_line,
     one_line, one_line, made<TrueDelayEngine>},
    {Method::direct, "direct", "slow reference of gridded", Model::narrow_band, Method::direct, 0, 1, false, true,
     any_head, one_line, no_head, made<FunctionEngine<synthesize_direct>>},
    {Method::spectrum, "spectrum", "slow check of direct, frequency by frequency", Model::narrow_band, Method::direct,
     0, 1, false, false, has_line, one_line, no_head, made<FunctionEngine<synthesize_spectrum>>},
    {Method::element_exact, "element-exact", "slow reference of true-delays", Model::true_delays, Method::element_exact,
     min_element_tolerance, max_element_tolerance, false, false, any_head, one_line, no_head,
     made<FunctionEngine<focused_beams>>},
    {Method::incoherent, "incoherent", "expected level without speckle", Model::expected_power, Method::incoherent, 0,
     1, false, false, any_head, any_head, no_head, made<FunctionEngine<expected_pressure>>}};

}  // namespace

std::span<const Engine> engines() { return engine_table; }

const Engine& engine_of(SynthesisMethod method) { return *std::ranges::find(engine_table, method, &Engine::method); }

const Engine& engine_for(ImageModel model, double tolerance) {
  const auto keeps = [&](const Engine& e) { return e.model == model && tolerance >= e.least_tolerance; };
  const auto found = std::ranges::find_if(engine_table, keeps);
  return found == std::end(engine_table) ? referee_for(model) : *found;
}

const Engine& referee_for(ImageModel model) {
  return *std::ranges::find_if(engine_table,
                               [&](const Engine& e) { return e.model == model && e.referee == e.method; });
}

}  // namespace insonify
