// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "returns/label_objects.hpp"
#include "returns/ping.hpp"
#include "run/options.hpp"
#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/run_pictures.hpp"
#include "simulate/simulated_ping.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "store/run_directory.hpp"

namespace insonify {

/// A note of pings for a machine: kind, text, pings, first_ping; of a survey the name of its head, too.
nlohmann::ordered_json note_json(const PingNote& note, const std::string& head = "");

/// A ping and its notes, as a cube stores them.
struct NotedPing {
  Ping ping;
  std::vector<PingNote> notes{};
};

/// Writes cube.h5, run.toml with `settings` (settings_as_toml), and fan.png (unless refused) into `directory`. Adds
/// sonar, water, peak memory and the cube's digest to `manifest`.
void write_run(const RunDirectory& directory, const CommonOptions& common, const RunOptions& run,
               const HeadSetup& setup, NotedPing noted, const std::string& settings, nlohmann::ordered_json& manifest,
               const RunPictures& pictures, RunObserver& observer);

/// Draws a picture that a run may lack: where there is no OpenGL, or no memory for it, the data are written all the
/// same, and a note that begins with `lacks` says why. An error of any other kind, such as a full disk, ends the run.
void draw_if_possible(const std::string& lacks, const std::function<void()>& draw, nlohmann::ordered_json& manifest,
                      RunObserver& observer);

/// The text of a run.toml, with `settings` as from settings_as_toml.
std::string run_toml(const RunOptions& run, const HeadSetup& setup, const std::string& settings);

/// A cube of simulated pings of one head, at least one; its water is that of the first.
Cube cube_of(std::vector<Ping> pings, const CommonOptions& common, const RunOptions& run, const HeadSetup& setup);

/// Title of the picture of a ping: sonar, number, range.
std::string picture_title(const std::string& sonar, const Ping& ping);

/// Writes contributors.h5 of a ping while they are found, band by band of beams.
class ContributorWriter : public ContributorSink {
 public:
  /// Has a ping with `options` hand over its contributors, if they ask for any, to this writer, which must outlive the
  /// ping.
  ContributorWriter(const RunDirectory& directory, const SceneCloud& scene, const SonarHead& head,
                    SimulationOptions& options);
  ContributorWriter(const ContributorWriter&) = delete;
  ContributorWriter& operator=(const ContributorWriter&) = delete;

  /// Writes a band of beams.
  void take(const Contributors& band, std::size_t first_beam) override;

  /// Completes the file with the label images of the ping, whose objects are the instances of the scene if it has
  /// them; `manifest` gets a summary.
  void finish(const PixelLabels& labels, const SceneInstances& instances, nlohmann::ordered_json& manifest);

 private:
  std::unique_ptr<ContributorFile> file_;
  int per_pixel_ = 0;
  std::size_t pixels_ = 0;
  double share_ = 0;
};

/// Writes the other files of --keep beside the cube: insonification.ply and .pcd, paths.vtp; `manifest` gets
/// a summary of each.
void write_kept(const RunDirectory& directory, const PingOptions& options, const SceneCloud& scene,
                const PingSetup& setup, const SimulatedPing& ping, const RunPictures& pictures,
                nlohmann::ordered_json& manifest);

}  // namespace insonify
