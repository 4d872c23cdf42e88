#include "tool/head_setup.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "store/csv_tables.hpp"
#include "store/environment_file.hpp"
#include "store/materials_file.hpp"
#include "store/nearest_word.hpp"
#include "store/toml_tree_internal.hpp"
#include "tool/parse_values.hpp"
#include "tool/run_settings.hpp"

namespace insonify::tool {
namespace {

/// Index of the material called `name`; Error(argument) with the nearest name.
std::uint16_t material_index(const std::vector<Material>& materials, const std::string& name) {
  std::vector<std::string> names;
  for (const Material& m : materials) names.push_back(m.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    fail(ErrorKind::argument, "--material = '", name, "' is unknown", did_you_mean(name, names), "; known are ",
         joined(names));
  return static_cast<std::uint16_t>(at - names.begin());
}

}  // namespace

HeadSetup set_up_head(const CommonOptions& common, const RunOptions& run) {
  HeadSetup setup;
  const SonarFile file = find_sonar(run.sonar);
  setup.spec = file.spec;
  for (const SonarNumber& n : file.numbers)
    if (n.status == "assumed" || n.status == "unknown") setup.doubtful.push_back(n);
  if (!run.environment.empty()) setup.environment = load_environment(run.environment);
  if (!run.profile.empty()) setup.environment.profile = load_sound_speed_profile(run.profile);
  for (const std::string& text : common.settings) {
    const Setting setting = parse_setting(text);
    if (setting.section == "sonar")
      set_sonar_value(setup.spec, setting.key, setting.value);
    else
      set_environment_value(setup.environment, setting.section, setting.key, setting.value);
  }
  if (!run.range.empty()) std::tie(setup.spec.min_range, setup.spec.max_range) = parse_range(run.range);
  require_valid(setup.environment, "environment");
  setup.notes = validity_notes(setup.environment.water, setup.spec.centre_frequency,
                               setup.environment.sound_speed_formula, setup.environment.absorption_formula);
  setup.medium = medium_of(setup.environment, setup.spec.centre_frequency);
  setup.head = make_head(setup.spec, setup.medium.sound_speed);
  return setup;
}

LoadOptions load_options(const CommonOptions& common, const SceneOptions& scene) {
  LoadOptions options;
  options.seed = common.seed;
  options.threads = common.threads;
  options.unit = parse_unit(scene.unit);
  options.mesh_spacing = scene.mesh_spacing;
  if (!scene.viewpoint.empty()) options.viewpoint = parse_vector("--viewpoint", scene.viewpoint, "x,y,z in metres");
  if (!scene.materials_file.empty() || !scene.material.empty()) {
    const std::string path = scene.materials_file.empty() ? data_folder() + "/materials.toml" : scene.materials_file;
    const MaterialTable table = load_materials(path);
    options.materials = materials_by_label(table);
    options.material_field = table.field;
  }
  if (!scene.material_field.empty()) options.material_field.name = scene.material_field;
  if (!scene.material.empty()) options.material = material_index(options.materials, scene.material);
  return options;
}

std::vector<std::string> loading_notes(const LoadReport& r) {
  std::vector<std::string> notes;
  const auto count = [&](std::size_t n, const char* what) {
    if (n > 0) notes.push_back(fmt::format("{}: {} {}", r.path, n, what));
  };
  count(r.dropped_not_finite, "points with NaN or infinite coordinates dropped");
  count(r.dropped_duplicates, "duplicate points dropped");
  count(r.dropped_degenerate, "degenerate triangles dropped");
  count(r.repaired_normals, "zero or NaN normals replaced by estimates");
  count(r.dropped_without_normal, "points without neighbours for a normal dropped");
  for (const std::string& note : r.notes) notes.push_back(r.path + ": " + note);
  return notes;
}

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
