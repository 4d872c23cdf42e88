// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "run/run_observer.hpp"
#include "run/survey_heads.hpp"
#include "run_scenes/open_scene.hpp"
#include "store/mission_file.hpp"
#include "store/survey_run.hpp"
#include "survey/simulate_survey.hpp"
#include "tool/command/common_options.hpp"

namespace insonify::tool {

/// Options of `survey`.
struct SurveyOptions {
  CommonOptions common;
  std::string mission, output;
  std::string shard = "0/1";
  int pings_per_block = 0;  ///< 0: as the folder has them, else as many as fill 32 MiB, at most 64
  bool plan = false;
};

/// A mission with its sonars: all that the survey does, but for the scene.
struct SurveySetup {
  MissionFile file;
  std::vector<PingSetup> heads;
  std::optional<Survey> survey;
  std::vector<SurveyBlock> blocks;
  SurveyRun run;
  std::vector<std::string> notes;  ///< on the way
};

/// Reads the mission and what it names, but for the scene, of which only the digest is taken. Throws Error(content)
/// with the file for a mission that cannot be: pings too close to one another, a head above the surface.
SurveySetup set_up_survey(const SurveyOptions& options);

/// Returns the bytes of a ping's image in the cube: of pressures, or of the levels of display cells and their labels.
std::size_t image_bytes(const PingSetup& ping);

/// Opens the scene of a survey, once for all pings, draws its random poses, and says notes to `observer`. Throws as open_scene, and
/// Error(content) for what scene and mission ask of each other, and for a head that is farther from the scene than it
/// can listen.
std::shared_ptr<const OpenScene> open_survey_scene(SurveySetup& setup, const CommonOptions& common,
                                                   RunObserver& observer);
/// Decides for each head whether its pings merge surfels, and records it for its run.toml.
void decide_detail(const SceneSource& scene, int threads, SurveySetup& setup);

}  // namespace insonify::tool
