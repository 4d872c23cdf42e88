// SPDX-License-Identifier: BSD-3-Clause
// The plan of a ping: each stage of the three tables is judged on a sample of the scene, and those that the budget
// decides are in where their bound exceeds their share.
#include "simulate/plan_ping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "beamforming/gridded/gridded_engine.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

double bound_of_added_echoes(const PlanFacts& facts, double energy) {
  if (energy == 0) return 0;
  const double in_view = facts.sample.in_view;
  return in_view > 0 ? plan_margin * std::sqrt(energy / in_view) : std::numeric_limits<double>::infinity();
}

const char* decided_by_name(DecidedBy by) {
  return by == DecidedBy::budget ? "budget" : by == DecidedBy::choice ? "choice" : "scene";
}

namespace {

std::vector<PlanStage> all_stages() {
  std::vector<PlanStage> all;
  for (const auto group : {geometry_stages(), effect_stages(), synthesis_stages()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

double level_of(double relative_error) { return db_from_amplitude(1 + relative_error); }

/// The part of the budget that each stage may cost: even in squares.
double budget_share(const std::vector<PlanStage>& stages, const PlanFacts& facts) {
  const auto n = std::count_if(stages.begin(), stages.end(), [&](auto& s) {
    return s.by == DecidedBy::budget && (!s.shares_if_caused || s.cause(facts.cause()));
  });
  return (amplitude_from_db(facts.ping.options.accuracy_db) - 1) / std::sqrt(static_cast<double>(n));
}

bool is_open(const PlanStage& stage, const SimulationOptions& options) {
  return stage.by == DecidedBy::budget && stage.requested(options) == Choice::as_needed;
}

/// Returns true if a stage is decided for each ping: an open one, or phases of display cells that may be drawn.
bool to_decide(const PlanStage& stage, const SimulationOptions& options) {
  return is_open(stage, options) || (stage.reason && draws_cells(options));
}

/// How one row of beams is gridded, or would be if the method is another: those may ask for more than gridding can.
SynthesisChoice gridding_of_a_row(const ResolvedPing& ping) {
  if (!has_line(ping.head)) return {};
  return choice_of_a_row(ping.head, ping.sent.medium,
                         {std::max(ping.options.synthesis.tolerance, min_gridding_tolerance), 1});
}

/// A row judged: an open one by its share of the budget, which sets `decided`.
PlannedStage judge(const PlanStage& stage, const PlanFacts& facts, double share, SimulationOptions& decided) {
  const SimulationOptions& options = facts.ping.options;
  const PlanCause cause = facts.cause(decided);
  const bool caused = stage.cause(cause), by_budget = stage.by == DecidedBy::budget;
  const double bound = stage.bound && (caused || !by_budget) ? stage.bound(facts) : 0;
  const char* with = stage.reason && caused ? stage.reason(cause) : stage.with;
  PlannedStage judged{stage.name, stage.by, caused, caused ? with : stage.without, bound, level_of(bound)};
  if (stage.reason && draws_cells(options)) {
    Environment unchanged = facts.ping.environment;
    stage.force(caused, unchanged, decided);
    if (caused && stage.adapt) stage.adapt(cause, decided);
  }
  if (is_open(stage, options)) {
    const bool too_dear = stage.only_if_forced && stage.only_if_forced(facts);
    judged.included = (bound > share || (caused && stage.needed && stage.needed(facts))) && !too_dear;
    if (too_dear)
      judged.why += "; a planar array is summed row by row for it, at that cost: only by --with " + judged.name;
    Environment unchanged = facts.ping.environment;
    stage.force(judged.included, unchanged, decided);
  } else if (by_budget) {
    judged.included = stage.requested(options) == Choice::always;
    judged.why = judged.included ? "asked for" : "off by the options";
  }
  return judged;
}

/// The stages, or only those that are open, judged: open ones by the budget, which sets `decided`.
std::vector<PlannedStage> judge_stages(const PlanFacts& facts, bool only_open, SimulationOptions& decided) {
  const std::vector<PlanStage> stages = all_stages();
  const double share = budget_share(stages, facts);
  std::vector<PlannedStage> judged;
  for (const PlanStage& stage : stages)
    if (!only_open || to_decide(stage, facts.ping.options)) judged.push_back(judge(stage, facts, share, decided));
  serve_array(facts.ping.head, decided);
  return judged;
}

/// The options with what is open decided.
SimulationOptions decided_by(const PlanFacts& facts) {
  SimulationOptions decided = facts.ping.options;
  judge_stages(facts, true, decided);
  return decided;
}

}  // namespace

PingPlan plan_of(const PreparedScene& prepared, const ResolvedPing& ping) {
  const PlanFacts facts{prepared.scene(), ping, sample_scene(prepared, ping), gridding_of_a_row(ping)};
  PingPlan plan;
  plan.options = ping.options;
  plan.synthesis = facts.synthesis;
  plan.share_relative = budget_share(all_stages(), facts);
  plan.share_db = level_of(plan.share_relative);
  plan.stages = judge_stages(facts, false, plan.options);
  double left_out = 0;
  for (const PlannedStage& stage : plan.stages)
    if (stage.by == DecidedBy::budget && !stage.included) left_out += stage.bound_relative * stage.bound_relative;
  plan.left_out_db = level_of(std::sqrt(left_out));
  return plan;
}

PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                   const Environment& environment, const SimulationOptions& options) {
  const PreparedScene prepared(scene, options.threads);
  ResolvedPing ping = resolve_ping(prepared.whole(), head, event, environment, options, "plan_ping");
  ping.sent.surfaces = surfaces_of(ping.sent, scene.materials);
  find_smooth(scene, ping);
  return plan_of(prepared, ping);
}

void decide_effects(const PreparedScene& prepared, ResolvedPing& ping) {
  const std::vector<PlanStage> stages = all_stages();
  if (std::none_of(stages.begin(), stages.end(), [&](auto& s) { return to_decide(s, ping.options); })) return;
  ping.options = decided_by({prepared.scene(), ping, sample_scene(prepared, ping), {}});
  derive(prepared.whole(), ping);
}

SimulationOptions decided_synthesis(const Scatterers& positions, const Echoes& echoes, const SonarHead& head,
                                    const Environment& environment, const SimulationOptions& options) {
  constexpr const char* me = "decided_synthesis";
  Environment water = environment;
  water.surface.reset(), water.bottom.reset(), water.water_level.reset();
  if (environment.profile)
    water.profile = SoundSpeedProfile{{0}, {medium_of(environment, head.pulse.centre_frequency).sound_speed}};
  SimulationOptions synthesis = options;
  synthesis.sampling.outer_elevations = synthesis.sampling.outer_azimuths = Choice::never;
  synthesis.effects.multipath = synthesis.effects.mirrors = Choice::never;
  synthesis.effects.refraction = synthesis.effects.moving = Choice::never;
  const ResolvedPing ping = resolve_ping({}, head, {}, water, synthesis, me);
  const SimulationOptions decided = decided_by({SceneCloud{}, ping, sample_of(positions, echoes, ping), {}});
  SimulationOptions result = options;
  result.effects.absorption_order = decided.effects.absorption_order;
  result.synthesis = decided.synthesis;
  return result;
}

void force_stage(const std::string& name, bool included, const PingEvent& event, Environment& environment,
                 SimulationOptions& options) {
  // The scene is not known yet: its materials may be a cause for what can be forced in.
  SceneCloud unknown;
  unknown.materials[0].mirror = 1;
  std::string names;
  for (const PlanStage& stage : all_stages()) {
    if (!stage.force) continue;
    names += (names.empty() ? "" : ", ") + std::string(stage.name);
    if (name != stage.name) continue;
    Environment forced_environment = environment;
    SimulationOptions forced = options;
    stage.force(included, forced_environment, forced);
    if (included && !stage.cause({unknown, forced_environment, forced, event}))
      fail(ErrorKind::argument, "force_stage: ", name, " cannot be forced in: ", stage.without);
    environment = std::move(forced_environment), options = std::move(forced);
    return;
  }
  fail(ErrorKind::argument, "force_stage: '", name, "' cannot be forced; these can: ", names);
}

}  // namespace insonify
