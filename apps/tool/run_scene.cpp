#include "tool/run_scene.hpp"

#include <filesystem>

#include "store/toml_tree_internal.hpp"
#include "tool/head_setup.hpp"
#include "tool/run_settings.hpp"

namespace insonify::tool {

SceneOptions scene_of_run(const std::string& run) {
  const std::filesystem::path settings = std::filesystem::path(run) / "run.toml";
  return std::filesystem::exists(settings) ? load_scene_settings(settings.string()) : SceneOptions{};
}

std::optional<View> view_of_run(const std::string& run, const WholeScene& scene, int threads) {
  const std::filesystem::path settings = std::filesystem::path(run) / "run.toml";
  if (!std::filesystem::exists(settings) || !load_toml(settings.string()).find("sonar")) return std::nullopt;
  RunOptions options;
  options.sonar = options.environment = settings.string();
  const HeadSetup setup = set_up_head({}, options);
  return resolve_ping(scene, setup.head, Pose::Identity(), setup.environment, {.threads = threads}).view;
}

}  // namespace insonify::tool
