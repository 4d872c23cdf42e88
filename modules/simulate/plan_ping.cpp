// The plan of a ping: each stage of the three tables is judged on a sample of the scene. Costs one pass over 20 000
// surfels at most, and for the bound of true delays one over the array's pattern.
#include "simulate/plan_ping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {

double relative_amplitude(const PlanFacts& facts, double power) {
  if (power == 0) return 0;
  const double in_view = facts.sample.in_view;
  return in_view > 0 ? plan_margin * std::sqrt(power / in_view) : std::numeric_limits<double>::infinity();
}

namespace {

std::vector<PlanStage> all_stages() {
  std::vector<PlanStage> all;
  for (const auto group : {geometry_stages(), effect_stages(), synthesis_stages()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

/// How one row of beams is gridded, or would be if the method is another: those may ask for more than gridding can.
SynthesisChoice gridding_of_a_row(const ResolvedPing& ping) {
  SonarHead row = ping.head;
  row.column.reset();
  row.fan.row_width = 0;
  std::fill(row.fan.elevation.begin(), row.fan.elevation.end(), row.fan.elevation[0]);
  return PingSynthesizer(row, ping.sent.medium, {std::max(ping.options.synthesis.tolerance, min_gridding_tolerance), 1})
      .choice();
}

/// Rough costs: 0.6 us per scatterer for sampling and echoes, 0.1 us per scatterer and row for gridding, and the
/// transforms of all bins.
void estimate_costs(const PlanFacts& facts, PingPlan& plan) {
  const SonarHead& head = facts.ping.head;
  plan.surfels_in_view = facts.sample.surfels;
  plan.scatterers = facts.sample.scatterers;
  const auto rows = static_cast<double>(fan_rows(head.fan).size()), bins = static_cast<double>(head.gate.bins());
  const auto beams = static_cast<double>(head.fan.beams()), surfels = static_cast<double>(facts.scene.size());
  plan.seconds = 2e-8 * surfels + 6e-7 * plan.scatterers + rows * (1e-7 * plan.scatterers + 6e-6 * bins);
  plan.mib = (120 * plan.scatterers + 40 * beams * bins + 45 * surfels) / 0x1p20;
}

}  // namespace

PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                   const Environment& environment, const SimulationOptions& options) {
  require_valid(scene, "plan_ping");
  const ResolvedPing ping = resolve_ping(whole_of(scene), head, world_from_head, environment, options, "plan_ping");
  const PlanFacts facts{scene, ping, sample_scene(scene, ping), gridding_of_a_row(ping)};
  PingPlan plan;
  plan.synthesis = facts.synthesis;
  for (const PlanStage& stage : all_stages()) {
    auto [included, why, bound] = stage.judge(facts);
    if (included) bound = 0;
    plan.stages.push_back({stage.name, included, std::move(why), bound, db_from_amplitude(1 + bound)});
  }
  estimate_costs(facts, plan);
  return plan;
}

void force_stage(const std::string& name, bool included, Environment& environment, SimulationOptions& options) {
  std::string names;
  for (const PlanStage& stage : all_stages()) {
    if (!stage.force) continue;
    names += (names.empty() ? "" : ", ") + std::string(stage.name);
    if (name != stage.name) continue;
    if (const char* obstacle = included && stage.obstacle ? stage.obstacle(environment, options) : nullptr)
      fail(ErrorKind::argument, "force_stage: ", name, " cannot be forced in: ", obstacle);
    return stage.force(included, environment, options);
  }
  fail(ErrorKind::argument, "force_stage: '", name, "' cannot be forced; these can: ", names);
}

}  // namespace insonify
