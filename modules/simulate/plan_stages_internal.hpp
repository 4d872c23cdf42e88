// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <span>
#include <string>

#include "simulate/ping_plan.hpp"
#include "simulate/scene_sample_internal.hpp"
#include "sonar/receive_array.hpp"

/// The stages of a plan, group by group. A new stage is a row in the table of its group, in the order of the plan.
///
/// The budget: options.accuracy_db as a relative error, shared evenly in squares among the rows that the budget decides
/// (budget_share). A stage of a larger bound is in. Nowhere else is a threshold.
namespace insonify {

/// The arguments of a planned ping.
struct PlanCause {
  const SceneCloud& scene;
  const Environment& environment;
  const SimulationOptions& options;
  const PingEvent& event;
  bool single_precision = false;               ///< tiles and transforms are in single precision
  double samples_per_cell = 0;                 ///< samples per cell of a display
  double max_range = 0, range_resolution = 0;  ///< greatest range, and resolution, of the head [m]
  bool has_line = true;                        ///< the beams are those of a line or plane
};

/// The data from which stages are judged.
struct PlanFacts {
  const SceneCloud& scene;
  const ResolvedPing& ping;
  SceneSample sample;
  SynthesisChoice synthesis;  ///< for one row of beams

  /// Returns what the ping is asked for.
  PlanCause cause() const { return cause(ping.options); }
  /// Returns the same for other options.
  PlanCause cause(const SimulationOptions& options) const {
    const double cells = std::max(1, options.outputs.display_bins);
    return {scene,
            ping.environment,
            options,
            ping.event,
            synthesis.single_precision,
            static_cast<double>(ping.samples.bins()) / cells,
            ping.head.gate.max_range,
            range_resolution(ping.head.pulse, ping.sent.medium.sound_speed),
            insonify::has_line(ping.head)};
  }
};

/// Factor in amplitude between the error expected of the sample and its bound.
constexpr double plan_margin = 2;

/// Bound of an effect that adds independent echoes of this energy to the image, relative to what is in view; infinite
/// if nothing is.
double bound_of_added_echoes(const PlanFacts& facts, double energy);

/// Bound of an effect that changes the echoes of the sample: `change(i)` is the squared error of the echo of place i,
/// relative to its energy, expected over speckle.
template <typename Change>
double bound_of_changed_echoes(const PlanFacts& facts, const Change& change) {
  const SceneSample& s = facts.sample;
  double energy = 0;
  for (std::size_t i = 0; i < s.energy.size(); ++i)
    if (s.energy[i] > 0) energy += s.energy[i] * change(i);
  return energy > 0 ? bound_of_added_echoes(facts, energy) : 0;
}

/// Returns the error of omitting double echoes: their expected energy (E158) over all pairs of some 500 places of the
/// sample, as if nothing stood between them. This is a bound for Lambert's law. For laws with lobes, which the sample
/// may miss, it is an estimate.
double double_echo_bound(const PlanFacts& facts);

/// Returns what straight legs cost double echoes in the profile of the environment, from pairs of some 50 places of the
/// sample.
struct StraightDoubleEchoes {
  double bound = 0;  ///< relative error of the image by it; 0 if double echoes are not asked for
  double range = 0;  ///< largest error of the apparent range [m] of those above -40 dB of the largest
};
/// Returns it, by rays of all three legs (refracted_pairs).
StraightDoubleEchoes straight_double_echoes(const PlanFacts& facts);

/// Returns the echoes of the sample by their mean power, of the moving head and parts (E44).
Echoes moved_echoes(const PlanFacts& facts);

/// A row of the plan.
struct PlanStage {
  const char* name;
  DecidedBy by;
  /// Returns whether the stage has a cause, or is asked for. Without a cause the stage has no bound and cannot be
  /// forced in.
  bool (*cause)(const PlanCause&);
  /// Texts: the reason why the stage is in, or may be, and the reason why it is not.
  const char *with, *without;
  /// Relative error of the image without it; nullptr: 0.
  double (*bound)(const PlanFacts&) = nullptr;
  /// Sets the options, or takes the cause out of the environment, so that the stage is in or out; nullptr: it cannot.
  void (*force)(bool included, Environment&, SimulationOptions&) = nullptr;
  /// Returns the setting of the stage in the options. The budget decides on the stage if the setting is as_needed.
  Choice (*requested)(const SimulationOptions&) = nullptr;
  /// Returns whether the stage is too expensive for the budget to include it; nullptr: never.
  bool (*only_if_forced)(const PlanFacts&) = nullptr;
  /// Takes a share of the budget only where there is a cause.
  bool shares_if_caused = false;
  /// Returns whether the budget includes the stage at any bound; nullptr: never.
  bool (*needed)(const PlanFacts&) = nullptr;
  /// Returns why the stage is in, by its cause; nullptr: `with`. Causes are those of the options as the stages
  /// before are decided.
  const char* (*reason)(const PlanCause&) = nullptr;
  /// Adapts the options to the stage where the plan has put it in by a reason; nullptr: not at all.
  void (*adapt)(const PlanCause&, SimulationOptions&) = nullptr;
};

std::span<const PlanStage> geometry_stages();
std::span<const PlanStage> effect_stages();
std::span<const PlanStage> synthesis_stages();

/// Causes that do not depend on the ping.
constexpr bool always(const PlanCause&) { return true; }
constexpr bool never(const PlanCause&) { return false; }

/// Decides all effects that the options of a ping leave as_needed, as plan_ping does, and derives all dependent values
/// again. Only undecided effects are judged, at a cost that grows with the region within the head's reach.
void decide_effects(const PreparedScene& prepared, ResolvedPing& ping);

/// The plan of a ping.
PingPlan plan_of(const PreparedScene& prepared, const ResolvedPing& ping);

}  // namespace insonify
