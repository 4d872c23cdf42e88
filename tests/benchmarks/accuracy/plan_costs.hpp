#pragma once
#include <functional>
#include <string>
#include <vector>

#include "plan_suite.hpp"

namespace insonify {

/// Cases of every method and of large and small scenes, images and numbers of scatterers.
std::vector<PlanCase> cost_cases();

/// What the plan says of a case, and what it takes on one thread.
struct PlanCost {
  std::string what;
  double planned_seconds = 0, seconds = 0;  ///< of CPU
  double planned_mib = 0, mib = 0;          ///< the ping's peak, beside the scene
  double planned_scatterers = 0, scatterers = 0;
};
PlanCost measure_cost(const PlanCase& c);

}  // namespace insonify
