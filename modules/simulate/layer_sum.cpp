#include <algorithm>
#include <complex>
#include <numbers>
#include <utility>

#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/split_aperture.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "core/units.hpp"
#include "simulate/layer_sum_internal.hpp"

namespace insonify {

LayerSum::LayerSum(const ResolvedPing& ping, KeptSynthesizers* kept)
    : ping_(ping), kept_(kept), incoherent_(ping.options.synthesis.method == SynthesisMethod::incoherent) {
  if (ping.options.outputs.split_phase) split_ = split_aperture(ping.head, "simulate_ping");
}

void LayerSum::add(const std::string& name, const Echoes& echoes) {
  const SimulationOptions& o = ping_.options;
  const Medium& medium = ping_.sent.medium;
  const double tolerance = o.synthesis.tolerance;
  add_pressure(name, echoes.size(),
               synthesize(echoes, ping_.head, medium, o.synthesis.method, {tolerance, o.threads}, kept_));
  add_halves([&](const SplitAperture& split, ApertureSide side) {
    if (o.synthesis.method == SynthesisMethod::true_delays)
      return synthesize(echoes, with_one_half(ping_.head, split, side), medium, o.synthesis.method,
                        {tolerance, o.threads}, kept_);
    return half_pressure(echoes, split, side, medium, {std::max(tolerance, min_gridding_tolerance), o.threads});
  });
  if (!o.outputs.elements) return;
  ElementSeries series = element_series(echoes, ping_.head, medium, {tolerance, Wavefront::spherical, o.threads});
  if (elements_.pressure.size() > 0) series.pressure += elements_.pressure;
  elements_ = std::move(series);
}

void LayerSum::add(const std::string& name, const EchoSource& source) {
  if (source.stored) return add(name, *source.stored);
  const SimulationOptions& o = ping_.options;
  const Medium& medium = ping_.sent.medium;
  const SynthesisOptions synthesis{o.synthesis.tolerance, o.threads};
  add_pressure(name, source.size(), synthesize(source, ping_.head, medium, o.synthesis.method, synthesis, kept_));
  add_halves([&](const SplitAperture& split, ApertureSide side) {
    if (o.synthesis.method == SynthesisMethod::true_delays)
      return synthesize(source, with_one_half(ping_.head, split, side), medium, o.synthesis.method, synthesis, kept_);
    return half_pressure(source, split, side, medium, synthesis);
  });
}

void LayerSum::add_noise() {
  const SonarHead& head = ping_.head;
  const SimulationOptions& o = ping_.options;
  const double root_mean_square = std::numbers::sqrt2 * amplitude_from_db(ping_.beam_noise_db) * micropascal;
  add_pressure("noise", 0,
               incoherent_
                   ? ComplexGrid(ComplexGrid::Constant(head.fan.beams(), head.gate.bins(), root_mean_square))
                   : synthesize_noise(head, ping_.sent.medium, ping_.element_noise_db, {o.seed, o.ping, o.threads}));
  add_halves([&](const SplitAperture& split, ApertureSide side) {
    return synthesize_noise(with_one_half(head, split, side), ping_.sent.medium, ping_.element_noise_db,
                            {o.seed, o.ping, o.threads});
  });
}

void LayerSum::add_halves(const std::function<ComplexGrid(const SplitAperture&, ApertureSide)>& image) {
  if (!split_) return;
  for (const ApertureSide side : {ApertureSide::port, ApertureSide::starboard}) {
    ComplexGrid& sum = side == ApertureSide::port ? port_ : starboard_;
    ComplexGrid pressure = image(*split_, side);
    if (sum.size() == 0)
      sum = std::move(pressure);
    else
      sum += pressure;
  }
}

void LayerSum::add_pressure(const std::string& name, std::size_t echoes, ComplexGrid pressure) {
  report_.push_back({name, echoes});
  if (ping_.options.outputs.layers) layers_.push_back({name, stored_pressure(pressure, "simulate_ping")});
  if (sum_.size() == 0)
    sum_ = std::move(pressure);
  else if (incoherent_)
    sum_ = (sum_.abs2() + pressure.abs2()).sqrt().cast<std::complex<double>>();
  else
    sum_ += pressure;
}

void LayerSum::finish(SimulatedPing& result) {
  result.ping = {ping_.options.ping, ping_.options.time, ping_.view.world_from_head,
                 ping_.head.fan,     ping_.head.gate,    stored_pressure(sum_, "simulate_ping"),
                 std::move(layers_)};
  result.ping.expected_level = incoherent_;
  note_water(ping_.sent.medium, result.ping);
  if (split_) result.ping.split_phase = phase_between(port_, starboard_);
  result.layers = std::move(report_);
  result.elements = std::move(elements_);
}

}  // namespace insonify
