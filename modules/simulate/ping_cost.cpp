// Cost model of a ping: coefficients in nanoseconds of one core and bytes, fitted to the pings of `plan_table costs` on
// one machine (docs/plan.md).
#include <algorithm>
#include <cmath>
#include <utility>

#include "beamforming/reference/element_series.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"
#include "simulate/ping_cost_internal.hpp"
#include "simulate/ping_stages_internal.hpp"

namespace insonify {
namespace {

// Nanoseconds: per surfel of the scene, per surfel in view, per scatterer, per sample of the image.
constexpr double per_surfel = 150, per_surfel_in_view = 400, per_scatterer = 50, per_sample = 30;
constexpr double per_bent_ray = 300, per_moved_echo = 150, per_leg = 3000;

/// What the cost of synthesis follows from, of one row of beams.
struct Load {
  double echoes, rows, beams, elements, bins, pulse_samples;
  bool own_shapes;  ///< each echo has a pulse of its own
  bool planar;      ///< gridded once for all rows
};

Load load_of(const PlanFacts& facts, const SimulationOptions& options, double echoes) {
  const SonarHead& head = facts.ping.head;
  const auto rows = static_cast<double>(fan_rows(head.fan).size());
  return {echoes,
          rows,
          static_cast<double>(head.fan.beams()) / rows,
          static_cast<double>(head.array.elements()),
          static_cast<double>(head.gate.bins()),
          static_cast<double>(facts.synthesis.pulse_samples),
          options.effects.absorption_order.value_or(0) > 0 || head.pulse.shape != PulseShape::gaussian,
          head.column && head.pulse.shape == PulseShape::gaussian};
}

/// Nanoseconds of one row: transforms of all bins, beams of all bins, pulses of all echoes.
double gridded_row(const Load& load, const SynthesisChoice& choice, double elements_factor = 1) {
  const double grid = elements_factor * static_cast<double>(choice.grid), precision = choice.single_precision ? 0.5 : 1;
  const double width = precision * static_cast<double>(choice.kernel_width);
  const double samples = std::min(load.pulse_samples, load.bins), lanes = choice.kernel_width > 8 ? 16 : 8;
  return load.bins * (grid * (0.3 * std::log2(grid) + 1.7 * precision + 4) + load.beams * (0.31 * width + 6)) +
         load.echoes * (30 + samples * (precision * lanes + (load.own_shapes ? 6 : 0)));
}

/// Gridding sums few echoes directly, and those of few beams.
bool summed_directly(const Load& load, const SynthesisChoice& choice) {
  return load.beams <= 4 || load.echoes <= static_cast<double>(choice.direct_echoes);
}

double summed_row(const Load& load) {
  const double samples = std::min(load.pulse_samples, load.bins);
  return load.echoes * (0.5 * load.elements + 50 * samples + load.beams * (0.4 * samples + 1));
}

/// Series of elements, without the beams of them.
double element_row(const Load& load) {
  return load.echoes * load.elements * (70 + (load.own_shapes ? 70 : 35) * load.pulse_samples);
}

double synthesis_row(const Load& load, const SynthesisChoice& choice, SynthesisMethod method) {
  using enum SynthesisMethod;
  const double all_pairs = load.elements * load.beams;
  switch (method) {
    case direct:
      return load.echoes * load.beams * (0.3 * load.elements + (load.own_shapes ? 2.2 : 0.8) * load.bins);
    case spectrum:
      return load.echoes * load.beams * (2.5 * load.elements + 4 * load.bins);
    case element_exact:
      return element_row(load) + 90 * all_pairs * load.bins;
    case incoherent:
      return 2 * gridded_row(load, choice, 2);  // with twice the digits
    case true_delays:                           // of its own
    case gridded:
      break;
  }
  return summed_directly(load, choice) ? summed_row(load) : gridded_row(load, choice);
}

/// Nanoseconds of a planar array: the transforms of all rows, and pulses that are added to as many lines over v as the
/// kernel is wide.
double gridded_plane(Load load, const SynthesisChoice& choice) {
  const auto width = static_cast<double>(choice.kernel_width);
  const double precision = choice.single_precision ? 0.5 : 1, lanes = choice.kernel_width > 8 ? 16 : 8;
  const double echoes = std::exchange(load.echoes, 0);
  return load.rows * gridded_row(load, choice) +
         echoes * (150 + std::min(load.pulse_samples, load.bins) * width * precision * lanes * 0.4);
}

/// True delays of one row of beams.
WidebandCost true_delay_row(const PlanFacts& facts, const SimulationOptions& options, bool own_shapes) {
  const ResolvedPing& ping = facts.ping;
  const SonarHead row = head_of_a_row(ping.head);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < facts.sample.energy.size(); ++i)
    if (facts.sample.energy[i] > 0) ranges.push_back(facts.sample.places.range[i]);
  Medium medium = ping.sent.medium;
  medium.absorption.a1 = own_shapes ? 1e-12 : 0;
  const bool wide = options.sampling.outer_azimuths == Choice::always;
  const double tolerance = std::clamp(options.synthesis.tolerance, min_true_delay_tolerance, max_element_tolerance);
  return wideband_cost(row, medium, {tolerance, 1}, wide ? 1 : WidebandSynthesizer::usual_extent(row), ranges);
}

double synthesis_seconds(const PlanFacts& facts, const SimulationOptions& options, const Load& load,
                         SynthesisMethod method) {
  if (load.planar && method == SynthesisMethod::gridded) return 1e-9 * gridded_plane(load, facts.synthesis);
  if (method != SynthesisMethod::true_delays) return 1e-9 * load.rows * synthesis_row(load, facts.synthesis, method);
  const WidebandCost cost = true_delay_row(facts, options, load.own_shapes);
  return load.rows * ((load.bins > 0 ? cost.seconds : 0) + load.echoes * cost.seconds_per_echo);
}

}  // namespace

double scatterers_of(const PlanFacts& facts, const SimulationOptions& options) {
  const SceneSample& s = facts.sample;
  return s.scatterers + (options.sampling.outer_azimuths == Choice::always ? s.outer_azimuths : 0) +
         (options.sampling.outer_elevations == Choice::always ? s.outer_elevations : 0);
}

PingCost cost_of(const PlanFacts& facts, const SimulationOptions& options) {
  const double echoes = scatterers_of(facts, options), surfels = static_cast<double>(facts.scene.size());
  const Load load = load_of(facts, options, echoes);
  const double samples = load.rows * load.beams * load.bins;
  PingCost cost;
  cost.seconds = 1e-9 * (per_surfel * surfels + per_surfel_in_view * facts.sample.surfels + per_scatterer * echoes +
                         per_sample * samples) +
                 synthesis_seconds(facts, options, load, options.synthesis.method);
  if (options.outputs.elements) cost.seconds += 1e-9 * element_row(load);
  if (options.effects.multipath == Choice::always) cost.seconds += seconds_of_multipath(facts);
  if (options.effects.refraction == Choice::always && facts.ping.environment.profile)
    cost.seconds += seconds_of_bent_rays(facts);
  if (options.effects.moving == Choice::always && !facts.ping.event.motion.none())
    cost.seconds += seconds_of_moved_echoes(facts);
  // What is stored of all patches stays; else what sampling takes is given back before the image is made. Few echoes are
  // summed directly, and stored for that.
  const SynthesisMethod method = options.synthesis.method;
  const double image =
      method == SynthesisMethod::true_delays ? true_delay_row(facts, options, load.own_shapes).bytes : 0;
  const bool direct = method == SynthesisMethod::gridded && summed_directly(load, facts.synthesis);
  const bool stored = needs_all_patches(facts.ping, options) || options.effects.multipath == Choice::always;
  cost.bytes =
      0x1p20 + (stored ? 90 * surfels + 105 * echoes + 24 * samples + image
                       : std::max(90 * surfels, 14 * surfels + 24 * samples + image + (direct ? 160 * echoes : 0)) +
                             60 * facts.sample.surfels);
  if (options.synthesis.method == SynthesisMethod::element_exact || options.outputs.elements)
    cost.bytes += 80 * load.elements * load.bins;
  return cost;
}

double seconds_of_scatterers(const PlanFacts& facts, double scatterers) {
  Load load = load_of(facts, facts.ping.options, scatterers);
  load.bins = 0;
  return 1e-9 * per_scatterer * scatterers +
         synthesis_seconds(facts, facts.ping.options, load, facts.ping.options.synthesis.method);
}

double seconds_of_own_shapes(const PlanFacts& facts) {
  const SynthesisMethod method = facts.ping.options.synthesis.method;
  Load load = load_of(facts, facts.ping.options, facts.sample.scatterers);
  load.own_shapes = true;
  const double own = synthesis_seconds(facts, facts.ping.options, load, method);
  load.own_shapes = false;
  return own - synthesis_seconds(facts, facts.ping.options, load, method);
}

double seconds_of_bent_rays(const PlanFacts& facts) { return 1e-9 * per_bent_ray * facts.sample.scatterers; }
double seconds_of_moved_echoes(const PlanFacts& facts) { return 1e-9 * per_moved_echo * facts.sample.scatterers; }

double seconds_of_multipath(const PlanFacts& facts) {
  return 1e-9 * per_leg * static_cast<double>(facts.scene.size()) +
         seconds_of_scatterers(facts, 2 * facts.sample.scatterers);
}

double seconds_of_true_delays(const PlanFacts& facts) {
  const Load load = load_of(facts, facts.ping.options, facts.sample.scatterers);
  return synthesis_seconds(facts, facts.ping.options, load, SynthesisMethod::true_delays) -
         synthesis_seconds(facts, facts.ping.options, load, SynthesisMethod::gridded);
}

}  // namespace insonify
