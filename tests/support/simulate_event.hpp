// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// A ping of a scene that is prepared for it alone.
inline SimulatedPing simulate_event(const SceneCloud& scene, const SonarHead& head, const PingEvent& event,
                                    const Environment& environment, const SimulationOptions& options = {}) {
  return PingSimulator(head, environment, options).ping(PreparedScene(scene, options.threads), event);
}

}  // namespace insonify
