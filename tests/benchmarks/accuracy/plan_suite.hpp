// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// A scene, a sonar before it, and the water: what bounds of the plan are compared with effects on.
struct PlanCase {
  std::string scene, sonar;
  SceneCloud cloud;
  SonarHead head;
  PingEvent event;
  Environment environment;
  SimulationOptions options;  ///< all that the budget decides is out
};

/// Fourteen cases of generated scenes and shipped sonars, each with a part of its beams and a short range gate: some
/// 5000 surfels each.
std::vector<PlanCase> plan_cases();

/// A stage that the budget decides, in one case. Levels are 20 log10(1 + e), e the relative L2 norm of the difference
/// that the stage makes to the complex image, of that without it.
struct PlanEffect {
  std::string stage, scene, sonar;
  double bound_db = 0, actual_db = 0;
  double total_db = 0;  ///< change of the image's total energy
  double seconds = 0;   ///< of CPU of the ping with it
};

/// What can be measured: effects below it are noise of rounding and tolerance [dB].
constexpr double least_effect_db = 0.005;
/// How loose a bound may be.
constexpr double loosest = 3;

/// The effect of forcing each stage in that the budget decides and that has a cause in this case.
std::vector<PlanEffect> plan_effects(const PlanCase& c);

/// What a ping of default options lacks but for this budget: what the plan says that it is at most, and what it is. True
/// delays of planar arrays, which are in only if forced, are not counted.
struct LeftOut {
  std::string stages;  ///< that are out and have a cause, with commas
  double bound_db = 0, actual_db = 0;
};
LeftOut left_out_of_default(const PlanCase& c, double accuracy_db);

}  // namespace insonify
