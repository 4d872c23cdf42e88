// The plan of a ping: each stage of the three tables is judged on a sample of the scene, and those that the budget
// decides are in where their bound exceeds their share.
#include "simulate/plan_ping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "simulate/resolve_ping_internal.hpp"

namespace insonify {

double added_bound(const PlanFacts& facts, double energy) {
  if (energy == 0) return 0;
  const double in_view = facts.sample.in_view;
  return in_view > 0 ? plan_margin * std::sqrt(energy / in_view) : std::numeric_limits<double>::infinity();
}

SonarHead head_of_a_row(const SonarHead& head) {
  SonarHead row = head;
  const std::vector<std::size_t> beams = fan_rows(head.fan).front().beams;
  row.column.reset();
  row.fan.row_width = 0;
  row.fan.azimuth.clear();
  for (const std::size_t b : beams) row.fan.azimuth.push_back(head.fan.azimuth[b]);
  row.fan.elevation.assign(beams.size(), head.fan.elevation[beams.front()]);
  return row;
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
double budget_share(const std::vector<PlanStage>& stages, double accuracy_db) {
  const auto n = std::count_if(stages.begin(), stages.end(), [](auto& s) { return s.by == DecidedBy::budget; });
  return (amplitude_from_db(accuracy_db) - 1) / std::sqrt(static_cast<double>(n));
}

bool is_open(const PlanStage& stage, const SimulationOptions& options) {
  return stage.by == DecidedBy::budget && stage.asked(options) == Choice::as_needed;
}

/// How one row of beams is gridded, or would be if the method is another: those may ask for more than gridding can.
SynthesisChoice gridding_of_a_row(const ResolvedPing& ping) {
  return PingSynthesizer(head_of_a_row(ping.head), ping.sent.medium,
                         {std::max(ping.options.synthesis.tolerance, min_gridding_tolerance), 1})
      .choice();
}

/// One stage, judged: open ones by the budget, which sets `settled`.
PlannedStage plan_stage(const PlanStage& stage, const PlanFacts& facts, double share, SimulationOptions& settled) {
  auto [included, why, bound, only_if_forced] = stage.judge(facts);
  if (stage.by == DecidedBy::budget) {
    const Choice asked = stage.asked(facts.ping.options);
    if (asked != Choice::as_needed) why = asked == Choice::always ? "asked for" : "off by the options";
    included = asked == Choice::always || (asked == Choice::as_needed && bound > share && !only_if_forced);
    Environment unchanged = facts.ping.environment;
    if (asked == Choice::as_needed) stage.force(included, unchanged, settled);
  }
  return {stage.name, stage.by, included, std::move(why), bound, level_of(bound)};
}

}  // namespace

PingPlan plan_of(const PreparedScene& prepared, const ResolvedPing& ping) {
  const SimulationOptions& options = ping.options;
  const PlanFacts facts{prepared.scene(), ping, sample_scene(prepared, ping), gridding_of_a_row(ping)};
  const std::vector<PlanStage> stages = all_stages();
  PingPlan plan;
  plan.options = options;
  plan.synthesis = facts.synthesis;
  plan.share_relative = budget_share(stages, options.accuracy_db);
  plan.share_db = level_of(plan.share_relative);
  double left_out = 0;
  for (const PlanStage& stage : stages) {
    const PlannedStage& planned = plan.stages.emplace_back(plan_stage(stage, facts, plan.share_relative, plan.options));
    if (stage.by == DecidedBy::budget && !planned.included) left_out += planned.bound_relative * planned.bound_relative;
  }
  plan.left_out_db = level_of(std::sqrt(left_out));
  return plan;
}

PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                   const Environment& environment, const SimulationOptions& options) {
  const PreparedScene prepared(scene, options.threads);
  return plan_of(prepared, resolve_ping(prepared.whole(), head, event, environment, options, "plan_ping"));
}

namespace {

/// The options with their open stages judged.
SimulationOptions settled_by(const PlanFacts& facts) {
  const SimulationOptions& options = facts.ping.options;
  const std::vector<PlanStage> stages = all_stages();
  const double share = budget_share(stages, options.accuracy_db);
  SimulationOptions settled = options;
  for (const PlanStage& stage : stages)
    if (is_open(stage, options)) plan_stage(stage, facts, share, settled);
  return settled;
}

}  // namespace

void decide_effects(const PreparedScene& prepared, ResolvedPing& ping) {
  const std::vector<PlanStage> stages = all_stages();
  if (std::none_of(stages.begin(), stages.end(), [&](auto& s) { return is_open(s, ping.options); })) return;
  ping.options = settled_by({prepared.scene(), ping, sample_scene(prepared, ping), {}});
  derive(prepared.whole(), ping);
}

SimulationOptions settled_synthesis(const Scatterers& places, const Echoes& echoes, const SonarHead& head,
                                    const Environment& environment, const SimulationOptions& options) {
  constexpr const char* me = "settled_synthesis";
  Environment water = environment;
  water.surface.reset(), water.bottom.reset(), water.water_level.reset();
  if (environment.profile)
    water.profile = SoundSpeedProfile{{0}, {medium_of(environment, head.pulse.centre_frequency).sound_speed}};
  SimulationOptions synthesis = options;
  synthesis.sampling.outer_elevations = synthesis.sampling.outer_azimuths = Choice::never;
  synthesis.effects.multipath = synthesis.effects.refraction = synthesis.effects.moving = Choice::never;
  const ResolvedPing ping = resolve_ping({}, head, {}, water, synthesis, me);
  const SimulationOptions settled = settled_by({SceneCloud{}, ping, sample_of(places, echoes, ping), {}});
  SimulationOptions result = options;
  result.effects.absorption_order = settled.effects.absorption_order;
  result.synthesis = settled.synthesis;
  return result;
}

void force_stage(const std::string& name, bool included, const PingEvent& event, Environment& environment,
                 SimulationOptions& options) {
  std::string names;
  for (const PlanStage& stage : all_stages()) {
    if (!stage.force) continue;
    names += (names.empty() ? "" : ", ") + std::string(stage.name);
    if (name != stage.name) continue;
    if (const char* obstacle = included && stage.obstacle ? stage.obstacle(environment, options, event) : nullptr)
      fail(ErrorKind::argument, "force_stage: ", name, " cannot be forced in: ", obstacle);
    return stage.force(included, environment, options);
  }
  fail(ErrorKind::argument, "force_stage: '", name, "' cannot be forced; these can: ", names);
}

}  // namespace insonify
