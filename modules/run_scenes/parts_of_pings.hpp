// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "run/options.hpp"
#include "run_scenes/parts_scene.hpp"
#include "survey/parts_source.hpp"

namespace insonify {

/// What the draws of a scene of parts follow from.
struct RunDraws {
  std::uint64_t seed = 1;
  DrawRule rule;
};
/// Returns seed and draws of the pings of a run directory, or of the folder of a survey's head: those of the mission
/// beside it, else those of its run.toml. Defaults without either. Throws as load_ping_settings and
/// load_survey_randomisation.
RunDraws draws_of_run(const std::string& run);

/// Returns the bytes that tiles may take: --memory-limit [GiB], or for 0 the available memory.
double memory_for_tiles(double limit_gib);

/// How scenes for pings are loaded.
struct PartsOfPingsOptions {
  RunDraws draws;
  int threads = 0;            ///< 0: all cores
  double memory_limit = 0;    ///< [GiB] of tiles for one ping; 0: what is available
  bool drawn_at_will = true;  ///< moments with any draw are asked for; else only those of draws.rule
};

/// A scene of parts as each ping finds it: by its time and its draw. All that pings, shows or compares such a scene asks
/// here. Several threads may ask at once.
class PartsOfPings : public SceneSource {
 public:
  /// Throws as PartsScene.
  explicit PartsOfPings(const std::string& path, const PartsOfPingsOptions& options = {});

  /// Returns the parts with what was read of them.
  const PartsScene& scene() const { return scene_; }
  /// Returns the moment of a ping with this time [s] and number.
  SceneMoment moment_of(double time, std::int64_t number) const {
    return insonify::moment_of(options_.draws.rule, time, number);
  }
  /// Returns what a ping needs of the scene at its moment: of tiles what it reaches. Throws as PartsScene::placed_at;
  /// Error(runtime) before reading if tiles need more memory than the limit.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns all of the scene at a moment, with all tiles; the same object while its parts stand alike and it is in
  /// use. Throws as PartsScene::placed_at and TiledScene::load.
  std::shared_ptr<const PreparedScene> whole_at(const SceneMoment& moment) const;
  /// Returns the cloud of that, which lives as long as the pointer.
  std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment& moment) const;

 private:
  PartsOfPingsOptions options_;
  PartsScene scene_;
  std::optional<PartsSource> source_;  ///< without tiles
  mutable std::mutex guard_;
  mutable std::optional<PartsSource> whole_;  ///< with all tiles, if they were asked for
};

/// Returns the scene of parts at scene.path with the draws of a run; `run` as of draws_of_run. Throws as PartsScene;
/// Error(argument) for options of loading beside it.
std::shared_ptr<const PartsOfPings> parts_of_run(const SceneOptions& scene, const std::string& run, int threads = 0);

}  // namespace insonify
