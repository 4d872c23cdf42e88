// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// Pings a scene that is prepared for this ping alone.
inline SimulatedPing simulate_event(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                                    const Environment& environment, const SimulationOptions& options = {}) {
  return PingSimulator(head, environment, options).ping(PreparedScene(scene, options.threads), event);
}

}  // namespace insonify
