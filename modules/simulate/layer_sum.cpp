// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <complex>
#include <numbers>
#include <utility>

#include "acoustics/echo_stream.hpp"
#include "beamforming/engine.hpp"
#include "beamforming/split_aperture.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"
#include "simulate/layer_sum_internal.hpp"

namespace insonify {

namespace {

void average_cells(const ResolvedPing& ping, Ping& image) {
  const RangeGate cells = display_gate(ping.samples, ping.options.outputs.display_bins);
  const auto averaged = [&](const ComplexGridF& pressure) -> ComplexGridF {
    const Grid<double> intensity = pressure.cast<std::complex<double>>().abs2();
    return mean_over_cells(intensity, ping.samples, cells).sqrt().cast<std::complex<float>>();
  };
  image.pressure = averaged(image.pressure);
  for (Layer& layer : image.layers) layer.pressure = averaged(layer.pressure);
  image.gate = cells;
  image.display_cells = true;
}

}  // namespace

Ping ping_of(const ResolvedPing& ping, const RangeGate& gate, ComplexGridF image) {
  Ping made{{ping.event.number, ping.event.time, ping.event.world_from_head}, ping.head.fan, gate, std::move(image)};
  if (ping.options.effects.moving == Choice::always) made.motion = ping.event.motion;
  note_water(ping.sent.medium, made);
  return made;
}

LayerSum::LayerSum(const ResolvedPing& ping, SynthesizerTable& synthesizers)
    : ping_(ping), synthesizers_(synthesizers), incoherent_(gives_power(ping.options.synthesis.method)) {
  // Refused before any work.
  if (ping.options.outputs.split_phase) half_head(ApertureSide::port);
}

std::shared_ptr<const Synthesizer> LayerSum::whole() const {
  const SimulationOptions& o = ping_.options;
  return synthesizers_.of(SynthesizerTable::Part::whole, ping_.head, ping_.sent.medium, o.synthesis.method,
                          {o.synthesis.tolerance, o.threads});
}

std::shared_ptr<const Synthesizer> LayerSum::half(ApertureSide side) const {
  const SimulationOptions& o = ping_.options;
  const auto part =
      side == ApertureSide::port ? SynthesizerTable::Part::port_half : SynthesizerTable::Part::starboard_half;
  // Expected intensities have no phase: halves have the speckle of one realisation.
  const SynthesisMethod method =
      incoherent_ ? engine_for(ImageModel::narrow_band, o.synthesis.tolerance).method : o.synthesis.method;
  return synthesizers_.of(part, half_head(side), ping_.sent.medium, method, {o.synthesis.tolerance, o.threads});
}

template <typename Image>
void LayerSum::add_halves(const Image& image) {
  if (!ping_.options.outputs.split_phase) return;
  for (const ApertureSide side : {ApertureSide::port, ApertureSide::starboard}) {
    ComplexGrid& sum = side == ApertureSide::port ? port_ : starboard_;
    ComplexGrid pressure = image(side);
    if (sum.size() == 0)
      sum = std::move(pressure);
    else
      sum += pressure;
  }
}

template <typename EchoesOrStream>
void LayerSum::add_image(const std::string& name, const EchoesOrStream& echoes) {
  add_pressure(name, echoes.size(), whole()->pressure(echoes));
  add_halves([&](ApertureSide side) { return half(side)->pressure(echoes); });
}

void LayerSum::add(const std::string& name, const Echoes& echoes) {
  add_image(name, echoes);
  const SimulationOptions& o = ping_.options;
  if (!o.outputs.elements) return;
  ElementSeries series =
      element_series(echoes, ping_.head, ping_.sent.medium, {o.synthesis.tolerance, Wavefront::spherical, o.threads});
  if (elements_.pressure.size() > 0) series.pressure += elements_.pressure;
  elements_ = std::move(series);
}

void LayerSum::add(const std::string& name, const EchoStream& stream) {
  if (stream.stored()) return add(name, *stream.stored());
  add_image(name, stream);
}

void LayerSum::add_noise() {
  const SonarHead& head = ping_.head;
  const SimulationOptions& o = ping_.options;
  const double root_mean_square = std::numbers::sqrt2 * amplitude_from_db(ping_.beam_noise_db) * micropascal;
  add_pressure("noise", 0,
               incoherent_ ? ComplexGrid(ComplexGrid::Constant(head.fan.beams(), head.gate.bins(), root_mean_square))
                           : synthesize_noise(head, ping_.sent.medium, ping_.element_noise_db,
                                              {o.seed, ping_.event.number, o.threads}));
  add_halves([&](ApertureSide side) {
    return synthesize_noise(half_head(side), ping_.sent.medium, ping_.element_noise_db,
                            {o.seed, ping_.event.number, o.threads});
  });
}

void LayerSum::add_pressure(const std::string& name, std::size_t echoes, ComplexGrid pressure) {
  report_.push_back({name, echoes});
  if (ping_.options.outputs.layers) layers_.push_back({name, stored_pressure(pressure, "PingSimulator")});
  if (sum_.size() == 0)
    sum_ = std::move(pressure);
  else if (incoherent_)
    sum_ = (sum_.abs2() + pressure.abs2()).sqrt().cast<std::complex<double>>();
  else
    sum_ += pressure;
}

void LayerSum::finish(SimulatedPing& result) {
  result.ping = ping_of(ping_, ping_.head.gate, stored_pressure(sum_, "PingSimulator"));
  result.ping.layers = std::move(layers_);
  result.ping.expected_level = incoherent_;
  if (ping_.options.outputs.display_bins > 0) average_cells(ping_, result.ping);
  if (ping_.options.outputs.split_phase) result.ping.split_phase = phase_between(port_, starboard_);
  result.report.layers = std::move(report_);
  result.outputs.elements = std::move(elements_);
}

}  // namespace insonify
