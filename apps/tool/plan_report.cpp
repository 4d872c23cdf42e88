#include "tool/plan_report.hpp"

#include <cmath>

#include <fmt/format.h>

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

std::string bound_text(const PlannedStage& stage) {
  if (stage.included) return "";
  if (std::isinf(stage.bound_relative)) return "not known";
  if (stage.bound_relative == 0) return "0";
  return fmt::format("{:.1e}  {:.2g} dB", stage.bound_relative, stage.bound_db);
}

/// JSON has no infinity: null is no bound.
ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

}  // namespace

ordered_json plan_json(const PingPlan& plan) {
  ordered_json stages = ordered_json::array();
  for (const PlannedStage& s : plan.stages)
    stages.push_back({{"name", s.name},
                      {"included", s.included},
                      {"why", s.why},
                      {"bound_db", number(s.bound_db)},
                      {"bound_relative", number(s.bound_relative)}});
  return {{"stages", stages},
          {"synthesis",
           {{"precision", plan.synthesis.single_precision ? "single" : "double"},
            {"kernel_width", plan.synthesis.kernel_width},
            {"grid", plan.synthesis.grid},
            {"pulse_samples", plan.synthesis.pulse_samples}}},
          {"surfels_in_view", plan.surfels_in_view},
          {"scatterers", std::llround(plan.scatterers)},
          {"seconds_on_one_core", plan.seconds},
          {"memory_mib", plan.mib}};
}

void print_plan(const PingPlan& plan) {
  fmt::print("{:<18} {:<4} {:<20} {}\n", "stage", "", "left out costs", "why");
  for (const PlannedStage& s : plan.stages)
    fmt::print("{:<18} {:<4} {:<20} {}\n", s.name, s.included ? "in" : "out", bound_text(s), s.why);
  fmt::print("synthesis: {} precision, kernel {} of {} grid steps, {} samples per pulse\n",
             plan.synthesis.single_precision ? "single" : "double", plan.synthesis.kernel_width, plan.synthesis.grid,
             plan.synthesis.pulse_samples);
  fmt::print("about {} surfels in view, {:.2g} scatterers, {:.2g} s on one core, {:.0f} MiB\n", plan.surfels_in_view,
             plan.scatterers, plan.seconds, plan.mib);
}

}  // namespace insonify::tool
