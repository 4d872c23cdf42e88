// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "store/mission_file.hpp"
#include "store/survey_run.hpp"
#include "survey/simulate_survey.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify::tool {

/// Options of `survey`.
struct SurveyOptions {
  CommonOptions common;
  std::string mission, output;
  std::string shard = "0/1";
  int pings_per_block = 0;  ///< 0: as the folder has them, else as many as fill 32 MiB, at most 64
  bool plan = false;
};

/// A head of the mission, ready to ping at any pose.
struct SurveyHead {
  PingOptions options;  ///< sonar, scene and settings as for a ping
  PingSetup setup;
};

/// A mission with its sonars: all that the survey does, but for the scene.
struct SurveySetup {
  MissionFile file;
  std::vector<SurveyHead> heads;
  std::optional<Survey> survey;
  std::vector<SurveyBlock> blocks;
  SurveyRun run;
  std::vector<std::string> notes;  ///< on the way
};

/// Reads the mission and what it names, but for the scene, of which only the digest is taken. Throws Error(content)
/// with the file for a mission that cannot be: pings too close to one another, a head above the surface.
SurveySetup set_up_survey(const SurveyOptions& options);

/// Returns the bytes of a ping's image in the cube: of pressures, or of the levels of display cells.
std::size_t image_bytes(const PingSetup& ping);

/// The scene of a survey: loaded and prepared once. Parts of a scene that move or are drawn are placed for every ping. Of a mesh or tiles every ping takes what it needs; tiles are kept
/// for the pings after, 256 MiB of them at most.
class SurveyScene : public SceneSource {
 public:
  /// Throws as load_scene, and Error(content) for a head that is farther from the scene than it can listen.
  SurveyScene(const SurveySetup& setup, const CommonOptions& common, RunObserver& observer);
  SurveyScene(const SurveyScene&) = delete;
  SurveyScene& operator=(const SurveyScene&) = delete;

  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Whether all pings have the same scene.
  bool is_shared() const { return prepared_ != nullptr; }
  /// Coordinate system that the scene's file states, as FileMeaning has it; empty: none.
  const std::string& system() const;

 private:
  /// Loads a scene of parts; returns its box at the first ping.
  Bounds load_parts(const SurveySetup& setup, const CommonOptions& common, RunObserver& observer);

  PingOptions options_;  // of a ping
  std::optional<PartsOfPings> parts_;
  LoadedScene loaded_;
  std::optional<TiledScene> tiles_;
  std::shared_ptr<const PreparedScene> prepared_;  // absent: every ping has a scene of its own
};

}  // namespace insonify::tool
