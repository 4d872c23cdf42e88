// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>

#include "acoustics/environment.hpp"
#include "sampling/insonified_region.hpp"
#include "scene/prepared_scene.hpp"
#include "simulate/ping_event.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/simulated_ping.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_spec.hpp"

namespace insonify {

struct ResolvedPing;
class PingSimulator;

/// Source of the scenes of pings: one scene in memory, or the part of a larger scene that each ping needs.
class SceneSource {
 public:
  virtual ~SceneSource() = default;
  /// Returns the scene for this ping: the whole scene, or at least the part that simulator.reach names. Several threads
  /// may call it at once.
  virtual std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator,
                                                         const PingEvent& event) const = 0;
  /// Returns true if levels of detail are stored with the scene, and scene_for cuts them as the simulator asks.
  virtual bool has_levels() const { return false; }
};

/// One head in one environment, ready to ping any scene from any pose. Head and options are checked once. The first
/// ping makes the tables, transforms and buffers that form the beams; later pings use them again and have the same
/// bytes as without them. Several threads may call all functions at once. Copies share tables and buffers.
class PingSimulator {
 public:
  /// Throws Error(argument) for an invalid head or option, and for multipath without surface or bottom.
  PingSimulator(SonarHead head, Environment environment, SimulationOptions options = {});
  /// Makes the head of a sonar in the water of its environment (slowest_sound). Throws as make_head, too.
  PingSimulator(const SonarSpec& sonar, Environment environment, SimulationOptions options = {});

  /// Returns a simulator of the same head and environment with other options; both share tables and buffers. Throws as
  /// the constructor.
  PingSimulator with(SimulationOptions options) const;
  /// Returns a simulator of the same head and options in another environment; both share tables and buffers, which
  /// serve pings in the same water. Throws as the constructor.
  PingSimulator in(Environment environment) const;

  /// Returns a simulator for so many pings of a scene that are like `event`. Where options leave it open whether
  /// surfels are merged, and pings give display cells, it is decided (E185): they are if that leaves at most half of
  /// the surfels within reach, if the pings save more time than levels of detail take to make, and if the expected
  /// level of the event stays within 0.1 dB in every tenth of its ranges. The decision follows from the arguments
  /// alone. Without one, options stay as they are. Of a scene that has levels any number of pings counts, of pressures
  /// too, and nodes stand for the surfels. Throws Error as ping, and what the source throws.
  PingSimulator for_many(std::size_t pings, const SceneSource& source, const PingEvent& event) const;
  /// Returns the same for pings of a scene in memory.
  PingSimulator for_many(std::size_t pings, const PreparedScene& scene, const PingEvent& event) const;

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
