// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/results/plan.md: what the plan promises of each stage and what forcing the stage in does,
// or, called with `left-out`, what default pings lack.
#include <algorithm>
#include <cstdio>
#include <string>

#include "plan_suite.hpp"

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

}  // namespace
}  // namespace insonify

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "effects";
  if (what == "left-out")
    insonify::print_left_out();
  else
    insonify::print_effects();
}
