// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/run_files.hpp"
#include "run_scenes/run_pictures.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/ping_simulator.hpp"
#include "simulate/simulated_ping.hpp"
#include "store/run_directory.hpp"

namespace insonify {

/// A ping that is ready: its scene, and the simulator that plans and makes it.
struct ReadyPing {
  PingScene scene;
  PingSimulator simulator;
};
/// Opens the scene of a ping. Ends a range that is the sonar's own where the scene ends, and adds to the notes of the
/// head what fits the scene badly. Throws Error(content) for a scene out of reach; Error(argument) for --draw without
/// anything to draw; Error(runtime) before reading if tiles would not fit into memory (--memory-limit).
ReadyPing load_ping_scene(const PingOptions& options, PingSetup& setup);

/// The contents of the run folder of a ping: how it was made.
struct PingRun {
  const PingOptions& options;
  const PingSetup& setup;
  const SceneCloud& scene;              ///< scene that was pinged
  nlohmann::ordered_json scene_json;    ///< description of the scene, from scene_json
  std::vector<Eigen::Vector3d> places;  ///< places of some surfels, from sampled_places
  PingPlan plan{};
  SceneInstances instances{};        ///< instances of its surfels, if contributors are kept
  std::vector<std::string> notes{};  ///< notes so far
  double load_seconds = 0;
};

/// Writes all files of a run: cube, picture, returns, what is kept beside them, run.toml and manifest. `contributors`
/// is the writer that took those of the ping. Returns the manifest. The folder is still to be committed. Throws
/// Error(file).
nlohmann::ordered_json write_ping_run(RunDirectory& directory, const PingRun& run, SimulatedPing ping,
                                      ContributorWriter& contributors, const RunPictures& pictures,
                                      RunObserver& observer);

/// A ping that is made already, with what made it.
struct PingInMemory {
  const SimulatedPing& ping;  ///< with its contributors, if it keeps them
  const PingSimulator& simulator;
  const PreparedScene& pinged;
  const SceneCloud& whole;  ///< scene of which `pinged` may be a finer sample
  const LoadReport& report;
  const SceneInstances& instances;
  std::optional<Bounds> box{};     ///< box of a scene of parts; absent: that of `whole`
  nlohmann::ordered_json parts{};  ///< list of parts from PartsScene::parts_json; null: none
};
/// Writes the whole run folder of such a ping, options.run.output. Throws Error(file).
void save_ping_run(const PingOptions& options, PingSetup setup, const PingInMemory& of, const RunPictures& pictures);

}  // namespace insonify
