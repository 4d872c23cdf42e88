#include <complex>
#include <numbers>
#include <utility>

#include "beamforming/synthesize_noise.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "simulate/layer_sum_internal.hpp"

namespace insonify {

LayerSum::LayerSum(const SonarHead& head, const Medium& medium, const SimulationOptions& options)
    : head_(head), medium_(medium), options_(options), incoherent_(options.method == SynthesisMethod::incoherent) {
  if (incoherent_ && options.keep_elements)
    fail(ErrorKind::argument,
         "simulate_ping: keep_elements = true, must be false with method incoherent: elements hear pressures, and an ",
         "expected intensity has none; use method gridded");
}

void LayerSum::add(const std::string& name, const Echoes& echoes) {
  add_pressure(name, echoes.size(),
               synthesize(echoes, head_, medium_, options_.method, {options_.tolerance, options_.threads}));
  if (!options_.keep_elements) return;
  ElementSeries series =
      element_series(echoes, head_, medium_, {options_.tolerance, Wavefront::spherical, options_.threads});
  if (elements_.pressure.size() > 0) series.pressure += elements_.pressure;
  elements_ = std::move(series);
}

void LayerSum::add_noise(const Environment& environment) {
  const double element_level_db = element_noise_level_db(environment, head_.pulse);
  if (!incoherent_) {
    add_pressure("noise", 0,
                 synthesize_noise(head_, medium_, element_level_db, {options_.seed, options_.ping, options_.threads}));
    return;
  }
  const double root_mean_square =
      std::numbers::sqrt2 * amplitude_from_db(element_level_db - array_gain_db(head_)) * micropascal;
  add_pressure("noise", 0, ComplexGrid::Constant(head_.fan.beams(), head_.gate.bins(), root_mean_square));
}

void LayerSum::add_pressure(const std::string& name, std::size_t echoes, const ComplexGrid& pressure) {
  if (sum_.size() == 0)
    sum_ = pressure;
  else if (incoherent_)
    sum_ = (sum_.abs2() + pressure.abs2()).sqrt().cast<std::complex<double>>();
  else
    sum_ += pressure;
  report_.push_back({name, echoes});
  if (options_.keep_layers) layers_.push_back({name, stored_pressure(pressure, "simulate_ping")});
}

void LayerSum::finish(const Pose& world_from_head, SimulatedPing& result) {
  result.ping = {options_.ping,     options_.time, world_from_head,
                 head_.fan,         head_.gate,    stored_pressure(sum_, "simulate_ping"),
                 std::move(layers_)};
  result.ping.expected_level = incoherent_;
  result.layers = std::move(report_);
  result.elements = std::move(elements_);
}

}  // namespace insonify
