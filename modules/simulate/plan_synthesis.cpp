// Stages of the plan that are ways of forming beams.
#include <algorithm>

#include "beamforming/narrow_band/narrow_band_error.hpp"
#include "beamforming/reference/element_series.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

/// Sets the direct sum, or leaves it for gridding if it is the one in force; another method stays as it is.
void force_direct_sum(bool included, Environment&, SimulationOptions& options) {
  SynthesisMethod& method = options.synthesis.method;
  if (included)
    method = SynthesisMethod::direct;
  else if (method == SynthesisMethod::direct)
    method = SynthesisMethod::gridded;
}

const char* sums_intensities(const Environment&, const SimulationOptions& options, const PingEvent&) {
  return options.synthesis.method == SynthesisMethod::incoherent ? "method incoherent adds intensities, not pressures"
                                                                 : nullptr;
}

StageVerdict judge_direct_sum(const PlanFacts& facts) {
  const bool direct = facts.ping.options.synthesis.method == SynthesisMethod::direct;
  return {direct, direct ? "asked for" : "gridding keeps the tolerance", facts.ping.options.synthesis.tolerance};
}

/// Of what is in view, and of what side lobes hear unless it is out by the options.
double narrow_band_bound(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  const NarrowBandError error(ping.head, ping.sent.medium.sound_speed);
  const SceneSample& sample = facts.sample;
  const NarrowBandError::Sums inside = error.of(sample.places, sample.power, ping.options.threads),
                              beside = error.of(sample.places, sample.power_off_azimuth, ping.options.threads);
  return added_bound(facts, inside.image > 0 ? (inside.error + beside.error) / inside.image * facts.sample.in_view : 0);
}

StageVerdict judge_true_delays(const PlanFacts& facts) {
  if (facts.ping.options.synthesis.method == SynthesisMethod::incoherent)
    return {false, "intensities have no delays across the array", 0};
  const bool planar = facts.ping.head.column.has_value();
  return {false,
          planar ? "a planar array is summed row by row for them, at that cost: only by --with true-delays"
                 : "elements receive wide bands and near echoes at other times: one pattern does not hold",
          narrow_band_bound(facts), planar};
}

/// What the plan does where the narrow-band image is not good enough.
void force_true_delays(bool included, Environment&, SimulationOptions& options) {
  auto& [method, tolerance, true_delays] = options.synthesis;
  true_delays = chosen(included);
  if (!included) {
    if (method == SynthesisMethod::true_delays || method == SynthesisMethod::element_exact)
      method = SynthesisMethod::gridded;
    return;
  }
  const bool fast = tolerance >= min_true_delay_tolerance;  // finer than that only the referee is
  method = fast ? SynthesisMethod::true_delays : SynthesisMethod::element_exact;
  tolerance = std::min(tolerance, max_element_tolerance);
}

/// A method given by name is what it is; gridding leaves it to `true_delays`.
Choice asked_true_delays(const SimulationOptions& options) {
  switch (options.synthesis.method) {
    case SynthesisMethod::gridded:
      return options.synthesis.true_delays;
    case SynthesisMethod::true_delays:
    case SynthesisMethod::element_exact:
      return Choice::always;
    default:
      return Choice::never;
  }
}

StageVerdict judge_double_precision(const PlanFacts& facts) {
  const bool single = facts.synthesis.single_precision;
  const SynthesisSettings& synthesis = facts.ping.options.synthesis;
  return {synthesis.method == SynthesisMethod::direct || !single,
          single ? "the tolerance leaves room for single precision" : "the tolerance needs it", synthesis.tolerance};
}

constexpr PlanStage stages[] = {
    {"direct-sum", DecidedBy::choice, judge_direct_sum, force_direct_sum, sums_intensities},
    {"true-delays", DecidedBy::budget, judge_true_delays, force_true_delays, sums_intensities, asked_true_delays},
    {"double-precision", DecidedBy::scene, judge_double_precision}};

}  // namespace

std::span<const PlanStage> synthesis_stages() { return stages; }

}  // namespace insonify
