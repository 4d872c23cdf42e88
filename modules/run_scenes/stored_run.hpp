// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "acoustics/multipath_echoes.hpp"
#include "run/options.hpp"
#include "run_scenes/open_scene.hpp"

namespace insonify {

/// The folder of a run, of a head of a survey or of a survey, or a cube alone, open for reading. Each member is read
/// when it is asked for, and is empty where the folder lacks its file.
class StoredRun {
 public:
  /// Names a folder or a cube; reads nothing.
  explicit StoredRun(std::string path) : path_(std::move(path)) {}

  /// Returns the path of a file of the folder; empty if it is not there, and for a cube alone.
  std::string find(const std::string& name) const;
  /// Returns the path of the cube. Throws Error(file) if there is no such run, Error(content) for a folder without one.
  std::string cube() const;
  /// Returns the settings of its pings; absent without a run.toml that has any. Throws as load_ping_settings.
  std::optional<Run> settings() const;
  /// Returns [scene] of its run.toml as options of loading it, with an empty path if nothing names the scene. Throws as
  /// load_scene_settings.
  SceneOptions scene() const;
  /// Returns seed and draws of its pings: those of the mission beside the folder of a head, else those of its settings.
  /// Throws as settings and load_mission_tables.
  RunDraws draws() const;
  /// Returns how its head, wherever it stands, samples a scene; absent without a run.toml that has the sonar.
  std::optional<View> view(const WholeScene& scene, int threads) const;
  /// Returns the object in a JSON file of the folder; null without one. Throws Error(file).
  nlohmann::ordered_json json(const std::string& name) const;
  /// Returns the system of its world, of a survey by its scene.json, of a run by its manifest; empty if neither says
  /// it.
  std::string system() const;
  /// Opens a scene for its pings: one of parts with their draws, another with samples by `seed`. Throws as
  /// insonify::open_scene and draws.
  std::shared_ptr<OpenScene> open_scene(const SceneOptions& scene, int threads, std::uint64_t seed = 1) const;

 private:
  std::string path_;
};

}  // namespace insonify
