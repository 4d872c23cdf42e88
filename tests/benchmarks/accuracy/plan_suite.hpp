// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// A scene, a sonar before it, and the water, for the comparison of the plan's bounds with measured effects.
struct PlanCase {
  std::string scene, sonar;
  SceneCloud cloud;
  SonarHead head;
  PingEvent event;
  Environment environment;
  SimulationOptions options;  ///< all effects that the budget decides are out
};

/// Returns fourteen cases of generated scenes and shipped sonars, each with a part of its beams and a short range gate:
/// some 5000 surfels each.
std::vector<PlanCase> plan_cases();

/// A stage that the budget decides, in one case. Levels are 20 log10(1 + e), e the relative L2 norm of the difference
/// that the stage makes to the complex image, of that without it.
struct PlanEffect {
  std::string stage, scene, sonar;
  double bound_db = 0, actual_db = 0;
  double total_db = 0;  ///< change of the image's total energy
  double seconds = 0;   ///< CPU time of the ping with the stage
};

/// Smallest measurable effect [dB]: smaller ones are noise of rounding and tolerance.
constexpr double least_effect_db = 0.005;
/// Largest ratio of a bound to the measured effect.
constexpr double loosest = 3;

/// Returns the effect of forcing in each stage that the budget decides and that has a cause in this case.
std::vector<PlanEffect> plan_effects(const PlanCase& c);

/// Effect of all stages that default options leave out because of the budget: the plan's bound, and the measured
/// effect. True delays of planar arrays, which are in only if forced, are not counted.
struct LeftOut {
  std::string stages;  ///< stages that are out and have a cause, with commas
  double bound_db = 0, actual_db = 0;
};
LeftOut left_out_of_default(const PlanCase& c, double accuracy_db);

}  // namespace insonify
