// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate_ping.hpp"

#include "core/stop_watch.hpp"

namespace insonify {

SimulatedPing simulate_ping(const PreparedScene& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options) {
  return PingSimulator(head, environment, options).ping(scene, {world_from_head});
}

SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options) {
  const PingSimulator simulator(head, environment, options);
  StopWatch watch;
  const PreparedScene prepared(scene, options.threads);
  const double seconds = watch.lap();
  SimulatedPing result = simulator.ping(prepared, {world_from_head});
  result.report.seconds.sampling += seconds;
  return result;
}

}  // namespace insonify
