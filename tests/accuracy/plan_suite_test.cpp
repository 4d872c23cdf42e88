// SPDX-License-Identifier: BSD-3-Clause
// The plan's promise over the suite of docs/results/plan.md: no effect exceeds its bound, and no bound is idle.
#include "benchmarks/accuracy/plan_suite.hpp"

#include <gtest/gtest.h>

#include "support/sanitizers.hpp"

using namespace insonify;

TEST(PlanSuite, effects_are_below_their_bounds_and_above_a_third_of_them) {
  int measured = 0;
  for (const PlanCase& c : plan_cases())
    for (const PlanEffect& e : plan_effects(c)) {
      const std::string what = e.stage + ", " + e.scene + ", " + e.sonar;
      EXPECT_LE(e.actual_db, e.bound_db + 1e-3) << what;
      EXPECT_LE(e.bound_db, loosest * std::max(e.actual_db, least_effect_db)) << what;
      measured += e.actual_db > least_effect_db;
    }
  EXPECT_GE(measured, 30);
}

// All that is left out together costs no more than the budget.
TEST(PlanSuite, default_pings_are_those_with_everything_in_within_the_budget) {
  int lacking = 0;
  for (const PlanCase& c : plan_cases())
    for (const double budget : {0.1, 1.0}) {
      const LeftOut left = left_out_of_default(c, budget);
      EXPECT_LE(left.actual_db, budget) << c.scene << ", " << c.sonar << ": " << left.stages;
      EXPECT_LE(left.actual_db, left.bound_db + 1e-3) << c.scene << ", " << c.sonar << ": " << left.stages;
      EXPECT_LE(left.bound_db, loosest * std::max(left.actual_db, least_effect_db)) << c.scene << ", " << c.sonar;
      lacking += !left.stages.empty();
    }
  EXPECT_GE(lacking, 12);
}
