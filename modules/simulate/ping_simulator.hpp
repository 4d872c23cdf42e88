// SPDX-License-Identifier: BSD-3-Clause
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

/// One head in one environment, ready to ping any scene from any pose. Head and options are checked once. The first
/// ping makes the tables, transforms and buffers that form the beams; later pings use them again and have the same
/// bytes as without them. Several threads may call all functions at once. Copies share tables and buffers.
class PingSimulator {
 public:
  /// Throws Error(argument) for an invalid head or option, and for multipath without surface or bottom.
  PingSimulator(SonarHead head, Environment environment, SimulationOptions options = {});

  /// Returns a simulator of the same head and environment with other options; both share tables and buffers. Throws as
  /// the constructor.
  PingSimulator with(SimulationOptions options) const;

  /// Returns the head given to the constructor.
  const SonarHead& head() const;
  /// Returns the environment given to the constructor.
  const Environment& environment() const;
  /// Returns the options given to the constructor.
  const SimulationOptions& options() const;

  /// Returns the plan of a ping: the effects that it will compute and omit (plan_ping). Nothing is simulated.
  PingPlan plan(const PreparedScene& scene, const PingEvent& event) const;

  /// Returns the numbers of surfels and scatterers that a ping will sample, or of rays that it will cast. Nothing is
  /// simulated.
  SamplingReport count(const PreparedScene& scene, const PingEvent& event) const;

  /// Simulates a ping and returns the result; ping_simulator.cpp shows the whole signal path. Effects set to as_needed
  /// are computed if omitting them would exceed their share of options().accuracy_db. Effects without a cause in the
  /// environment are skipped. The result does not depend on the number of threads. Throws Error for an invalid event, a
  /// head at or above the surface, and a profile without a surface.
  SimulatedPing ping(const PreparedScene& scene, const PingEvent& event) const;
  /// Simulates the same ping, with the same bytes, and sets `plan` to its plan, for which the ping is resolved once.
  SimulatedPing ping(const PreparedScene& scene, const PingEvent& event, PingPlan& plan) const;

  /// Returns the part of a scene that a ping needs: surfels that can return an echo or hide others. They alone give the
  /// same ping.
  InsonifiedRegion reach(const WholeScene& scene, const PingEvent& event) const;

 private:
  struct Shared;
  explicit PingSimulator(std::shared_ptr<Shared> shared);
  ResolvedPing resolve(const WholeScene& scene, const PingEvent& event) const;
  SimulatedPing ping(const PreparedScene& scene, const PingEvent& event, PingPlan* plan) const;
  SimulatedPing ping(const PreparedScene& scene, const ResolvedPing& decided) const;

  std::shared_ptr<Shared> shared_;
};

}  // namespace insonify
