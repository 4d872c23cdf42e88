// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/run_pictures.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// A ping that is ready: its scene, and the simulator that plans and makes it.
struct ReadyPing {
  PingScene scene;
  PingSimulator simulator;
};
/// Opens the scene of a ping. Ends a range that is the sonar's own where the scene ends, and adds to the notes of the
/// head what fits the scene badly. Throws Error(content) for a scene out of reach; Error(argument) for --draw without
/// anything to draw; Error(runtime) before reading if tiles would not fit into memory (--memory-limit).
ReadyPing load_ping_scene(PingSetup& setup);

/// Loads the scene of a ping, pings it and writes its whole run folder; `observer` receives steps and notes. Returns the
/// manifest. Throws as load_ping_scene, PingSimulator::ping and RunFolder.
nlohmann::ordered_json make_ping_run(PingSetup setup, const RunPictures& pictures, RunObserver& observer);

}  // namespace insonify
