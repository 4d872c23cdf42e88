// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// Simulates one ping of one head and returns the result, with the same bytes as a PingSimulator. For many pings of a
/// head construct a PingSimulator; for many pings of a scene prepare the scene once. Throws Error as PingSimulator.
SimulatedPing simulate_ping(const PreparedScene& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

/// Returns the same for a scene that the call prepares for this ping alone. Throws Error also for an invalid scene.
SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

}  // namespace insonify
