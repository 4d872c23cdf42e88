#include "tool/run_scene.hpp"

#include <filesystem>

#include "store/toml_tree_internal.hpp"
#include "tool/head_setup.hpp"

namespace insonify::tool {

SceneOptions scene_of_run(const std::string& run) {
  namespace fs = std::filesystem;
  SceneOptions options;
  const fs::path settings = fs::path(run) / "run.toml";
  if (!fs::is_directory(run) || !fs::exists(settings)) return options;
  const TomlValue document = load_toml(settings.string());
  const TomlValue* scene = document.find("scene");
  if (!scene) return options;
  const auto read = [&](const char* key, std::string& value) {
    const TomlValue* found = scene->find(key);
    if (found && found->kind == TomlValue::Kind::text) value = found->text;
  };
  read("path", options.path);
  read("unit", options.unit);
  read("material", options.material);
  read("materials", options.materials_file);
  read("material_field", options.material_field);
  read("viewpoint", options.viewpoint);
  if (const TomlValue* spacing = scene->find("mesh_spacing"); spacing && spacing->is_number())
    options.mesh_spacing = spacing->number;
  for (const fs::path& from : {fs::path("."), fs::path(run), fs::path(run).parent_path()})
    if (!options.path.empty() && fs::exists(from / options.path)) {
      options.path = (from / options.path).string();
      break;
    }
  return options;
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
