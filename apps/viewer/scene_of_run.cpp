// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene_of_run.hpp"

#include <filesystem>
#include <memory>

#include "files/path_status.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/any_scene.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "scene_io/load_scene.hpp"
#include "store/scene_file.hpp"

namespace insonify::viewer {
namespace {

namespace fs = std::filesystem;

// True if the ids of the contributors match the scene.
bool belong_together(const Contributors& list, const SceneCloud& scene) {
  const std::size_t step = 1 + list.surfel.size() / 10000;
  for (std::size_t i = 0; i < list.surfel.size(); i += step)
    if (list.surfel[i] != Contributors::none &&
        (list.surfel[i] >= scene.size() || scene.id[list.surfel[i]] != list.id[i]))
      return false;
  return true;
}

// Parts are, ping by ping, where they were when it was sent.
void load_parts_of_run(const ViewerCommand& command, const SceneOptions& options, const std::string& run_folder,
                       LoadedView& view) {
  const auto parts = parts_of_run(options, run_folder, command.common.threads);
  for (const std::string& note : loading_notes(parts->scene().report())) view.notes.push_back(note);
  std::vector<SceneMoment> moments;
  for (const TrackPoint& ping : view.data.pings.places()) moments.push_back(parts->moment_of(ping.time, ping.number));
  view.data.scene_of_ping = [parts, moments](std::size_t ping) { return parts->cloud_at(moments.at(ping)); };
  view.data.view = view_of_run(run_folder, whole_of(*view.data.scene_of_ping(0)), command.common.threads);
}

void load_scene_of_run(const ViewerCommand& command, const std::string& run_folder, LoadedView& view) {
  if (command.no_scene) return;
  SceneOptions options = scene_of_run(run_folder);
  if (!command.scene.path.empty()) {
    const std::string path = command.scene.path;
    options = command.scene;
    options.path = path;
  } else if (options.path.empty() || !path_exists(options.path)) {
    view.notes.push_back(options.path.empty()
                             ? "the run does not say what its scene was: give it with --scene for the 3-D panel"
                             : options.path + ": the scene of the run is missing: give it with --scene");
    return;
  }
  if (is_scene_file(options.path)) return load_parts_of_run(command, options, run_folder, view);
  LoadedScene loaded = load_any_scene(command.common, options);
  for (const std::string& note : loading_notes(loaded.report)) view.notes.push_back(note);
  if (loaded.mesh && !view.data.contributors.empty()) {
    const PingOptions run = load_ping_settings((fs::path(run_folder) / "run.toml").string());
    sample_for_ping(run, set_up_ping(run), loaded);
  }
  view.data.scene = std::move(loaded.scene);
  view.data.view = view_of_run(run_folder, whole_of(view.data.scene), command.common.threads);
}

}  // namespace

void show_scene_of_run(const ViewerCommand& command, const std::string& run_folder, LoadedView& view) {
  load_scene_of_run(command, run_folder, view);
  ViewerData& data = view.data;
  if (!has_scene(data)) return;
  for (std::size_t p = 0; p < data.contributors.size(); ++p)
    if (!belong_together(data.contributors[p], *scene_at(data, p))) {
      view.notes.push_back("the scene is not that of the run's contributors, so it is not shown");
      data.scene = {}, data.scene_of_ping = {}, data.view.reset();
      return;
    }
}

}  // namespace insonify::viewer
