// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "returns/label_objects.hpp"
#include "returns/ping.hpp"
#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/run_pictures.hpp"
#include "simulate/ping_plan.hpp"
#include "simulate/simulated_ping.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "store/run_directory.hpp"

namespace insonify {

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

}  // namespace insonify
