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

/// The plan of simulate_ping for the same arguments, from a sample of the scene (4096 surfels of each kind of place at
/// most), head, environment and options; the ping itself is not simulated.
///
/// Errors are relative L2 norms e of the complex image, given as levels 20 log10(1 + e): the level of the whole image
/// cannot change by more. The budget is options.accuracy_db. It is shared out evenly in squares, since the effects are
/// independent and their errors add as energies: of n stages that it decides, each may cost e / sqrt(n). A stage whose
/// bound is larger is in, all others are out, unless the options say always or never.
///
/// A bound is the effect expected of the sample, over all speckle, with a factor of 2 in amplitude for what the sample
/// does not show. A bound is 0 where an effect has no cause (no boundary, no motion, no profile). bound_relative may
/// exceed 1: then the stage changes the image altogether. docs/results/plan.md compares bounds with effects.
///
/// Throws Error as simulate_ping does.
PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                   const Environment& environment, const SimulationOptions& options = {});

/// The options for synthesizing these echoes, of patches or targets at `places`, with what is open decided as plan_ping
/// decides it: whether true delays and absorption over the band are in. The other stages are no part of it. Of the
/// environment the water counts as it is, whatever its depth. Throws Error as simulate_ping does.
SimulationOptions settled_synthesis(const Scatterers& places, const Echoes& echoes, const SonarHead& head,
                                    const Environment& environment, const SimulationOptions& options = {});

/// Forces a stage in or out, by its name in the plan. Forcing direct-sum or true-delays out of a ping of another method
/// changes nothing. Throws Error(argument) for a stage that is unknown or cannot be forced, naming those that can, and
/// for one that cannot be forced in for this event, naming what is missing.
void force_stage(const std::string& name, bool included, const PingEvent& event, Environment& environment,
                 SimulationOptions& options);

}  // namespace insonify
