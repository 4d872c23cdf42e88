// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "acoustics/echoes.hpp"
#include "acoustics/environment.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/ping_event.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Returns the plan of simulate_ping for the same arguments. The plan follows from head, environment, options and a
/// sample of the scene (at most 4096 surfels of each kind of place). The ping itself is not simulated.
///
/// Errors are relative L2 norms e of the complex image, stated as levels 20 log10(1 + e); the level of the whole image
/// cannot change by more. The budget is options.accuracy_db. Effects are independent, so their errors add as energies,
/// and each of the n effects that the budget decides may cost e / sqrt(n). An effect is included if its bound is larger
/// than that, unless the options say always or never.
///
/// A bound is twice the amplitude that is expected of the effect for the sample, over all speckle. The factor of two
/// covers what the sample misses. The bound is 0 if an effect has no cause (no boundary, no motion, no profile). A
/// bound above 1 means that the effect changes the image completely. docs/results/plan.md compares bounds with effects.
///
/// Throws Error as simulate_ping does.
PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                   const Environment& environment, const SimulationOptions& options = {});

/// Returns options for the synthesis of given echoes of patches or targets at `positions`. True delays and absorption over
/// the band are decided as by plan_ping; other effects are not considered. The environment's water is used unchanged,
/// without regard to depth. Throws Error as simulate_ping does.
SimulationOptions decided_synthesis(const Scatterers& positions, const Echoes& echoes, const SonarHead& head,
                                    const Environment& environment, const SimulationOptions& options = {});

/// Forces an effect in or out, by its name in the plan. Forcing direct-sum or true-delays out of a ping of another
/// method changes nothing. Throws Error(argument) for an effect that is unknown or cannot be forced, naming those that
/// can, and for one that has no cause in this event and environment, naming what is missing.
void force_stage(const std::string& name, bool included, const PingEvent& event, Environment& environment,
                 SimulationOptions& options);

}  // namespace insonify
