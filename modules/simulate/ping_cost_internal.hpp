#pragma once
#include "simulate/plan_stages_internal.hpp"

namespace insonify {

/// Time on one core and memory of a ping, estimated from numbers of surfels, scatterers, beams, elements and bins.
struct PingCost {
  double seconds = 0, bytes = 0;
};

/// A ping with these settled options.
PingCost cost_of(const PlanFacts& facts, const SimulationOptions& options);

/// How many scatterers it has.
double scatterers_of(const PlanFacts& facts, const SimulationOptions& options);

// What stages add [s].
double seconds_of_scatterers(const PlanFacts& facts, double scatterers);
double seconds_of_own_shapes(const PlanFacts& facts);
double seconds_of_bent_rays(const PlanFacts& facts);
double seconds_of_moved_echoes(const PlanFacts& facts);
double seconds_of_multipath(const PlanFacts& facts);
double seconds_of_true_delays(const PlanFacts& facts);

}  // namespace insonify
