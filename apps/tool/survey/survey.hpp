// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/stop_watch.hpp"
#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "run_scenes/open_scene.hpp"
#include "store/mission_file.hpp"
#include "store/survey_run.hpp"
#include "survey/simulate_survey.hpp"
#include "survey/survey_store.hpp"
#include "tool/command/option_list.hpp"
#include "tool/command/progress.hpp"

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

/// Opens the scene of a survey, once for all pings, draws its random poses, and says notes to `observer`. Throws as
/// open_scene, and Error(content) for what scene and mission ask of each other, and for a head that is farther from the
/// scene than it can listen.
std::shared_ptr<const OpenScene> open_survey_scene(SurveySetup& setup, const CommonOptions& common,
                                                   RunObserver& observer);
/// Decides for each head whether its pings merge surfels, and records it for its run.toml.
void decide_detail(const SceneSource& scene, int threads, SurveySetup& setup);

/// Writes run.toml of every head and a copy of the mission into the folder of the survey, unless they are there.
void write_survey_settings(const SurveySetup& setup, const std::string& folder);

/// How far a survey is: a bar with the remaining time on a terminal, and a JSON file for other programs, at most one a
/// second. May be called by several threads.
class SurveyStatus {
 public:
  /// `path`: of the file; `pings`: to be made or kept by this shard, of which `done` are there already.
  SurveyStatus(Progress& progress, std::string path, std::string shard, std::size_t pings, std::size_t done);

  /// `made`: null for a ping that was there already.
  void ping_done(const PingOutcome* made);
  /// Writes the file: running, done, interrupted or failed.
  void write(const std::string& state);

  std::size_t made() const { return made_; }
  std::size_t failed() const { return failed_; }
  double seconds() const { return seconds_; }  ///< until the last write

 private:
  Progress& progress_;
  std::string path_, shard_;
  std::size_t pings_, done_before_, made_ = 0, failed_ = 0;
  double seconds_ = 0, written_ = 0;
  StopWatch watch_;
  std::recursive_mutex guard_;
};

/// Returns whether the folder of a survey holds a block whole.
bool is_done(const SurveySetup& setup, const std::string& folder, const SurveyBlock& block);

/// Reads and writes the blocks of a survey in its folder, and says how far it is.
class SurveyFolder : public SurveyStore {
 public:
  /// `observer` receives what cannot be kept, or taken up again.
  SurveyFolder(const SurveySetup& setup, std::string folder, SurveyStatus& status, RunObserver& observer)
      : setup_(setup), folder_(std::move(folder)), status_(status), observer_(observer) {}

  /// Pings that an interrupted run left; a damaged file counts as none, with a note.
  BlockOutcomes resume(const SurveyBlock& block) override;
  /// Writes a whole block with its mark, or what is done of one that is not whole for `resume`.
  void keep(const SurveyBlock& block, BlockOutcomes& outcomes) override;
  void ping_done(const PingOutcome* made) override;
  bool stopped() override { return is_interrupted(); }
  /// Pings made that hear nothing.
  std::size_t silent() const { return silent_; }
  /// Notes of the pings that were kept, by the number of their head.
  const std::map<std::size_t, std::vector<PingNote>>& notes() const { return notes_; }

 private:
  const SurveySetup& setup_;
  std::string folder_;
  SurveyStatus& status_;
  RunObserver& observer_;
  std::atomic<std::size_t> silent_ = 0;
  std::map<std::size_t, std::vector<PingNote>> notes_;  // one thread at a time keeps
};

}  // namespace insonify::tool
