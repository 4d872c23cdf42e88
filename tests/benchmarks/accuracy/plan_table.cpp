// Prints the tables of docs/plan.md: what the plan promises of each stage and what forcing the stage in does, or,
// called with `left-out`, what default pings lack, or with `costs`, what it says of time and memory and what pings take.
#include <algorithm>
#include <cstdio>
#include <string>

#include "plan_costs.hpp"

namespace insonify {
namespace {

void print_effects() {
  std::puts(
      "| stage | scene | sonar | bound | actual | bound / actual | total energy |\n|---|---|---|---|---|---|---|");
  for (const PlanCase& c : plan_cases())
    for (const PlanEffect& e : plan_effects(c)) {
      const double ratio = e.bound_db / std::max(e.actual_db, least_effect_db);
      std::printf("| %s | %s | %s | %.3g dB | %.3g dB | %s%.2g | %+.3f dB |\n", e.stage.c_str(), e.scene.c_str(),
                  e.sonar.c_str(), e.bound_db, e.actual_db, e.actual_db < least_effect_db ? "< " : "", ratio,
                  e.total_db);
    }
}

void print_left_out() {
  std::puts("| scene | sonar | budget | left out | bound | actual |\n|---|---|---|---|---|---|");
  for (const double budget : {0.1, 1.0})
    for (const PlanCase& c : plan_cases()) {
      const LeftOut left = left_out_of_default(c, budget);
      if (left.stages.empty()) continue;
      std::printf("| %s | %s | %g dB | %s | %.2g dB | %.2g dB |\n", c.scene.c_str(), c.sonar.c_str(), budget,
                  left.stages.c_str(), left.bound_db, left.actual_db);
      std::fflush(stdout);
    }
}

void print_costs() {
  std::puts(
      "| ping | sonar | planned | CPU time | ratio | planned | memory | ratio | scatterers, planned / actual |\n"
      "|---|---|---|---|---|---|---|---|---|");
  for (const PlanCase& c : cost_cases()) {
    const PlanCost cost = measure_cost(c);
    std::printf("| %s | %s | %.2g s | %.2g s | %.2f | %.0f MiB | %.0f MiB | %.2f | %.2f of %.3g |\n", cost.what.c_str(),
                c.sonar.c_str(), cost.planned_seconds, cost.seconds, cost.planned_seconds / cost.seconds,
                cost.planned_mib, cost.mib, cost.planned_mib / cost.mib, cost.planned_scatterers / cost.scatterers,
                cost.scatterers);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace insonify

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "effects";
  if (what == "costs")
    insonify::print_costs();
  else if (what == "left-out")
    insonify::print_left_out();
  else
    insonify::print_effects();
}
