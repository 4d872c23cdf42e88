// Cost model of a ping: coefficients in nanoseconds of one core and bytes, fitted to the pings of `plan_table costs` on
// one machine (docs/plan.md).
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/ping_cost_internal.hpp"
#include "simulate/ping_stages_internal.hpp"

namespace insonify {
namespace {

// Nanoseconds: per surfel of the scene, per surfel in view, per scatterer, per sample of the image.
constexpr double per_surfel = 550, per_surfel_in_view = 900, per_scatterer = 200, per_sample = 105;
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
          options.effects.absorption_order > 0 || head.pulse.shape != PulseShape::gaussian,
          head.column && head.pulse.shape == PulseShape::gaussian};
}

/// Nanoseconds of one row: transforms of all bins, beams of all bins, pulses of all echoes.
double gridded_row(const Load& load, const SynthesisChoice& choice, double elements_factor = 1) {
  const double grid = elements_factor * static_cast<double>(choice.grid), precision = choice.single_precision ? 0.5 : 1;
  const double width = precision * static_cast<double>(choice.kernel_width);
  const double samples = std::min(load.pulse_samples, load.bins), lanes = choice.kernel_width > 8 ? 16 : 8;
  return load.bins * (grid * (0.3 * std::log2(grid) + 1.7 * precision + 4) + load.beams * (0.31 * width + 6)) +
         load.echoes * (70 + samples * (precision * lanes + (load.own_shapes ? 20 : 0)));
}

double synthesis_row(const Load& load, const SynthesisChoice& choice, SynthesisMethod method) {
  using enum SynthesisMethod;
  const double all_pairs = load.elements * load.beams;
  switch (method) {
    case direct:
      return load.echoes * load.beams * (0.4 * load.elements + (load.own_shapes ? 3.2 : 1.2) * load.bins);
    case spectrum:
      return load.echoes * load.beams * (2.5 * load.elements + 4 * load.bins);
    case element_exact:
      return load.echoes * load.elements * (100 + (load.own_shapes ? 100 : 50) * load.pulse_samples) +
             130 * all_pairs * load.bins;
    case true_delays:
      return 11 * gridded_row(load, choice);
    case incoherent:
      return gridded_row(load, choice, 2);
    case gridded:
      break;
  }
  return gridded_row(load, choice);
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

double synthesis_seconds(const Load& load, const SynthesisChoice& choice, SynthesisMethod method) {
  if (load.planar && method == SynthesisMethod::gridded) return 1e-9 * gridded_plane(load, choice);
  return 1e-9 * load.rows * synthesis_row(load, choice, method);
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
                 synthesis_seconds(load, facts.synthesis, options.synthesis.method);
  if (options.effects.multipath == Choice::always) cost.seconds += seconds_of_multipath(facts);
  if (options.effects.refraction == Choice::always && facts.ping.environment.profile)
    cost.seconds += seconds_of_bent_rays(facts);
  if (options.effects.moving == Choice::always && !options.effects.motion.none())
    cost.seconds += seconds_of_moved_echoes(facts);
  // What is stored of all patches stays; else what sampling takes is given back before the image is made.
  cost.bytes = 0x1p21 + (needs_all_patches(facts.ping, options)
                             ? 90 * surfels + 105 * echoes + 32 * samples
                             : std::max(90 * surfels, 14 * surfels + 24 * samples) + 60 * facts.sample.surfels);
  if (options.synthesis.method == SynthesisMethod::element_exact) cost.bytes += 80 * load.elements * load.bins;
  return cost;
}

double seconds_of_scatterers(const PlanFacts& facts, double scatterers) {
  Load load = load_of(facts, facts.ping.options, scatterers);
  load.bins = 0;
  return 1e-9 * per_scatterer * scatterers +
         synthesis_seconds(load, facts.synthesis, facts.ping.options.synthesis.method);
}

double seconds_of_own_shapes(const PlanFacts& facts) {
  const SynthesisMethod method = facts.ping.options.synthesis.method;
  Load load = load_of(facts, facts.ping.options, facts.sample.scatterers);
  load.own_shapes = true;
  const double own = synthesis_seconds(load, facts.synthesis, method);
  load.own_shapes = false;
  return own - synthesis_seconds(load, facts.synthesis, method);
}

double seconds_of_bent_rays(const PlanFacts& facts) { return 1e-9 * per_bent_ray * facts.sample.scatterers; }
double seconds_of_moved_echoes(const PlanFacts& facts) { return 1e-9 * per_moved_echo * facts.sample.scatterers; }

double seconds_of_multipath(const PlanFacts& facts) {
  return 1e-9 * per_leg * static_cast<double>(facts.scene.size()) +
         seconds_of_scatterers(facts, 2 * facts.sample.scatterers);
}

double seconds_of_true_delays(const PlanFacts& facts) {
  const Load load = load_of(facts, facts.ping.options, facts.sample.scatterers);
  return synthesis_seconds(load, facts.synthesis, SynthesisMethod::true_delays) -
         synthesis_seconds(load, facts.synthesis, SynthesisMethod::gridded);
}

}  // namespace insonify
