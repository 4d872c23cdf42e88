// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "acoustics/sound_paths.hpp"
#include "returns/label_objects.hpp"
#include "returns/ping.hpp"
#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/open_scene.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/ping_simulator.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/simulated_ping.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "store/run_directory.hpp"

namespace insonify {

/// Draws the pictures of a run folder: its writer links no package that draws.
class RunPictures {
 public:
  virtual ~RunPictures() = default;
  /// Draws a ping as a fan into the PNG at `path`. Throws Error(runtime) where nothing can be drawn, Error(file).
  virtual void draw_fan(const Ping& ping, const std::string& title, const std::string& path) const = 0;
  /// Writes sound paths as lines of ParaView, with level and bounces. Throws Error(file).
  virtual void write_paths(const SoundPaths& paths, const std::string& path) const = 0;
};

/// Numbers of a file of data for a machine: key, value, status and source of each.
nlohmann::ordered_json numbers_json(const std::vector<SourcedNumber>& numbers);

/// A note of pings for a machine: kind, text, pings, first_ping; of a survey the name of its head, too.
nlohmann::ordered_json note_json(const PingNote& note, const std::string& head = "");

/// Draws a picture that a run may lack: where there is no OpenGL, or no memory for it, the data are written all the
/// same, and a note that begins with `lacks` says why. An error of any other kind, such as a full disk, ends the run.
void draw_if_possible(const std::string& lacks, const std::function<void()>& draw, nlohmann::ordered_json& manifest,
                      RunObserver& observer);

/// The text of a run.toml, with `settings` as from settings_as_toml.
std::string run_toml(const PingSetup& setup, const std::string& settings);

/// A cube of simulated pings of one head, at least one; its water is that of the first.
Cube cube_of(std::vector<Ping> pings, const PingSetup& setup);

/// Title of the picture of a ping: sonar, number, range.
std::string picture_title(const std::string& sonar, const Ping& ping);

// The parts of a ping's manifest, its notes, and its plan.

/// Returns what was read of a scene, and what it became.
nlohmann::ordered_json scene_json(const LoadReport& report, const SceneCloud& scene);
/// Adds to a manifest what a ping was made of: surfels, scatterers and returns, holes, layers, motion, peak level.
void describe_ping(const SimulatedPing& ping, const PingSetup& setup, nlohmann::ordered_json& manifest);

/// Returns the notes on head, water, place and scene of a ping, before it is made.
std::vector<std::string> notes_before(const PingSetup& setup, const LoadReport& report);

/// Notes on the result: a silent ping, refraction, multipath without any echo. `positions` as from sampled_positions.
std::vector<std::string> ping_notes(const SimulatedPing& ping, const PingSetup& setup,
                                    const std::vector<Eigen::Vector3d>& positions);

/// The plan for the manifest: stages with name, included, why, bound_db, bound_relative (null: no bound), and the
/// parameters of the synthesis.
nlohmann::ordered_json plan_json(const PingPlan& plan);

/// The folder of a run while it is written. Contributors of a ping are written while they are found, band by band.
class RunFolder : public ContributorSink {
 public:
  /// Begins the folder that the run of `setup` names, in which none of `inputs` is replaced. All arguments must outlive
  /// the object. Throws as RunDirectory.
  RunFolder(const PingSetup& setup, const std::vector<std::string>& inputs, const RunPictures& pictures,
            RunObserver& observer);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Returns the options by which a ping of a scene hands its contributors, if it keeps any, to this folder.
  SimulationOptions options_for(const SceneCloud& scene);
  /// Writes the contributors of a band of beams.
  void take(const Contributors& band, std::size_t first_beam) override;

  /// Writes all files of a ping: cube, picture, returns, what is kept beside them, run.toml and manifest, which is
  /// returned. Objects of labels are the instances of the scene, if it has them; `load_seconds`: time of loading it.
  /// Throws Error(file).
  nlohmann::ordered_json write(SimulatedPing ping, const PingPlan& plan, const PingScene& scene,
                               const SceneInstances& instances, double load_seconds = 0);
  /// Writes cube, run.toml with `settings` (settings_as_toml) and picture of an image; adds sonar, water, peak memory
  /// and the cube's digest to `manifest`. Throws Error(file).
  void write_image(Ping image, std::vector<PingNote> notes, const std::string& settings,
                   nlohmann::ordered_json& manifest);
  /// Writes the manifest, the last file. Throws Error(file).
  void finish(const nlohmann::ordered_json& manifest);
  /// Gives the folder its name. Throws Error(file).
  void commit() { directory_.commit(); }

 private:
  void write_kept(const SimulatedPing& ping, const SceneCloud& scene, const SceneInstances& instances,
                  nlohmann::ordered_json& manifest);

  const PingSetup& setup_;
  const RunPictures& pictures_;
  RunObserver& observer_;
  RunDirectory directory_;
  std::unique_ptr<ContributorFile> contributors_;
  std::size_t pixels_ = 0;  ///< pixels with contributors
  double share_ = 0;        ///< sum of the shares of their contributors
};

/// A ping that is ready: its scene, and the simulator that plans and makes it.
struct ReadyPing {
  PingScene scene;
  PingSimulator simulator;
};
/// Opens the scene of a ping. Ends a range that is the sonar's own where the scene ends, and adds to the notes of the
/// head what fits the scene badly. Throws Error(content) for a scene out of reach; Error(argument) for --draw without
/// anything to draw; Error(runtime) before reading if tiles would not fit into memory (--memory-limit).
ReadyPing load_ping_scene(PingSetup& setup);

/// Loads the scene of a ping, pings it and writes its whole run folder; `observer` receives steps and notes. Returns
/// the manifest. Throws as load_ping_scene, PingSimulator::ping and RunFolder.
nlohmann::ordered_json make_ping_run(PingSetup setup, const RunPictures& pictures, RunObserver& observer);

}  // namespace insonify
