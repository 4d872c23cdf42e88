// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// One ping of one head: PingSimulator in a line, with the same bytes. For many pings of a head make a PingSimulator;
/// for many pings of a scene prepare it once. Throws Error as PingSimulator.
SimulatedPing simulate_ping(const PreparedScene& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

/// The same of a scene that is prepared for this ping alone; throws Error for an invalid scene.
SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options = {});

}  // namespace insonify
