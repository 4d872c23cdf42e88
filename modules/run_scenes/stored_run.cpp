// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/stored_run.hpp"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "simulate/resolve_ping.hpp"
#include "store/mission_file.hpp"
#include "store/run_directory.hpp"
#include "store/survey_run.hpp"
#include "store/toml_tree.hpp"

namespace insonify {

namespace fs = std::filesystem;

std::string StoredRun::find(const std::string& name) const {
  const fs::path file = fs::path(path_) / name;
  return is_folder(path_) && path_exists(file) ? file.string() : "";
}

std::string StoredRun::cube() const {
  if (!path_exists(path_)) fail(ErrorKind::file, path_, ": no such run directory or cube");
  if (!is_folder(path_)) return path_;
  std::string file = find("cube.h5");
  if (file.empty()) fail(ErrorKind::content, path_, ": holds no cube.h5, so it is no run directory");
  return file;
}

std::optional<Run> StoredRun::settings() const {
  const std::string file = find("run.toml");
  if (file.empty() || !load_toml(file).find("ping")) return std::nullopt;
  return load_ping_settings(file);
}

SceneOptions StoredRun::scene() const {
  const std::string file = find("run.toml");
  return file.empty() ? SceneOptions{} : load_scene_settings(file);
}

RunDraws StoredRun::draws() const {
  const fs::path survey = (path_exists(path_) ? real_path(path_) : fs::path(path_)).parent_path();
  if (const fs::path mission = survey / "mission.toml"; is_survey_run(survey.string()) && path_exists(mission)) {
    const MissionFile differs = load_mission_tables(mission.string());
    return {differs.seed, {differs.randomise.scene_pings, 0}};
  }
  const std::optional<Run> sent = settings();
  if (!sent) return {};
  return {sent->simulation.seed, {0, static_cast<std::uint64_t>(sent->placement.draw)}};
}

std::optional<View> StoredRun::view(const WholeScene& scene, int threads) const {
  HeadOptions options;
  options.sonar = options.environment = find("run.toml");
  if (options.sonar.empty() || !load_toml(options.sonar).find("sonar")) return std::nullopt;
  const PingSetup setup = set_up_head(options);
  Pose somewhere = Pose::Identity();
  const Environment& e = setup.environment;
  if (const auto surface = surface_height(e))
    somewhere.translation().z() = *surface - (e.water.depth > 0 ? e.water.depth : 1);
  return resolve_ping(scene, setup.head, {somewhere}, e, {.threads = threads}).view;
}

nlohmann::ordered_json StoredRun::json(const std::string& name) const {
  const std::string file = find(name);
  if (file.empty()) return {};
  nlohmann::ordered_json found = nlohmann::ordered_json::parse(read_text_file(file), nullptr, false);
  return found.is_object() ? found : nlohmann::ordered_json();
}

std::string StoredRun::system() const {
  for (const char* name : {"scene.json", "manifest.json"})
    if (const nlohmann::ordered_json found = json(name); found.contains("scene") && found["scene"].is_object())
      if (std::string system = found["scene"].value("system", ""); !system.empty()) return system;
  return "";
}

}  // namespace insonify
