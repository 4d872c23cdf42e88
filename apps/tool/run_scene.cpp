#include "tool/run_scene.hpp"

#include <filesystem>

#include "tool/run_settings.hpp"

namespace insonify::tool {

SceneOptions scene_of_run(const std::string& run) {
  const std::filesystem::path settings = std::filesystem::path(run) / "run.toml";
  return std::filesystem::exists(settings) ? load_scene_settings(settings.string()) : SceneOptions{};
}

}  // namespace insonify::tool
