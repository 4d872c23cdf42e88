#pragma once
#include <memory>

#include "acoustics/environment.hpp"
#include "sampling/insonified_region.hpp"
#include "scene/prepared_scene.hpp"
#include "simulate/ping_event.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/simulated_ping.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

struct ResolvedPing;

/// One head in one environment, ready to ping any scene from any place. Head and options are checked once; plans, tables,
/// transforms and buffers that form the beams are made in the first ping and used again by those that follow, with the same
/// bytes. All functions may be called from several threads at once. A copy shares what is made.
class PingSimulator {
 public:
  /// Throws Error(argument) for an invalid head or option, and for multipath without surface or bottom.
  PingSimulator(SonarHead head, Environment environment, SimulationOptions options = {});

  /// The head given to the constructor.
  const SonarHead& head() const;
  /// The environment given to the constructor.
  const Environment& environment() const;
  /// The options given to the constructor.
  const SimulationOptions& options() const;

  /// What a ping will compute and leave out, as plan_ping; nothing is simulated.
  PingPlan plan(const PreparedScene& scene, const PingEvent& event) const;

  /// Counts the surfels and scatterers that a ping will sample; of rays, those that are cast. Nothing is simulated.
  SamplingReport count(const PreparedScene& scene, const PingEvent& event) const;

  /// Simulates a ping: the whole signal path, which reads in ping_simulator.cpp. Effects set to as_needed are computed where
  /// the plan of the ping needs them for options().accuracy_db; effects without a cause in the environment are skipped. The
  /// result does not depend on the number of threads. Throws Error for an invalid event, and for an environment that this
  /// head cannot stand in: at or above the surface, a profile without one.
  SimulatedPing ping(const PreparedScene& scene, const PingEvent& event) const;

  /// The part of a scene that a ping can hear or that can hide what it hears: the surfels in there give the same ping.
  InsonifiedRegion reach(const WholeScene& scene, const PingEvent& event) const;

 private:
  struct Shared;
  ResolvedPing resolve(const WholeScene& scene, const PingEvent& event) const;
  SimulatedPing ping(const PreparedScene& scene, const ResolvedPing& decided) const;

  std::shared_ptr<Shared> shared_;
};

}  // namespace insonify
