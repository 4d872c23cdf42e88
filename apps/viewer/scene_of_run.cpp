// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include "files/path_status.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/load_scene.hpp"
#include "survey/mesh_source.hpp"
#include "viewer/viewer_command.hpp"

namespace insonify::viewer {
namespace {

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
void show_parts(const std::shared_ptr<const OpenScene>& scene, LoadedView& view) {
  std::vector<SceneMoment> moments;
  for (const TrackPoint& ping : view.data.pings.positions())
    moments.push_back(scene->moment_of(ping.time, ping.number));
  view.data.scene_of_ping = [scene, moments](std::size_t ping) { return scene->cloud_at(moments.at(ping)); };
}

/// Replaces the overview of a mesh by the surfels of the run's ping, whose contributors are named by them.
void sample_for_run(const StoredRun& run, LoadedScene& loaded, LoadedView& view) {
  const std::optional<Run> sent = run.settings();
  if (!sent) return;
  const PingSetup setup = set_up_ping(*sent);
  MeshSample fine =
      mesh_sample_for(*loaded.mesh, loaded.scene.size(), sent->memory_limit, setup.simulator(), setup.event);
  if (!fine.note.empty()) view.notes.push_back(loaded.report.path + ": " + fine.note);
  if (fine.scene) loaded.scene = std::move(*fine.scene);
}

void load_scene_of_run(const ViewerCommand& command, const StoredRun& run, LoadedView& view) {
  if (command.no_scene) return;
  SceneOptions options = run.scene();
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
  const std::shared_ptr<OpenScene> scene = run.open_scene(options, command.common.threads);
  for (const std::string& note : loading_notes(scene->report())) view.notes.push_back(note);
  if (scene->parts()) {
    show_parts(scene, view);
  } else {
    LoadedScene loaded = scene->take_whole({});
    if (loaded.mesh && !view.data.contributors.empty()) sample_for_run(run, loaded, view);
    view.data.scene = std::move(loaded.scene);
  }
  view.data.view = run.view(whole_of(*scene_at(view.data, 0)), command.common.threads);
}

}  // namespace

void show_scene_of_run(const ViewerCommand& command, const std::string& run_folder, LoadedView& view) {
  load_scene_of_run(command, StoredRun(run_folder), view);
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
