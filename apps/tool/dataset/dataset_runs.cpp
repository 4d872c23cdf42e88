// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/sha256.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/survey_run.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// The digest of a scene, or of its file alone where files that it names are gone, with a note.
std::string digest_of_what_is_there(const std::string& scene, std::string& note) {
  try {
    return digest_of_scene(scene);
  } catch (const Error& error) {
    note = std::string(error.what()) + ": the scene is known by " + scene +
           " alone, so scenes that differ in other files count as one when pings are split";
    return sha256_of_file(scene);
  }
}

/// Notes the scene of a run, and the instances of its points if its cloud has them.
void find_scene(DatasetSource& source, const StoredRun& run) {
  source.scene = run.scene().path;
  std::error_code error;
  const bool there = !source.scene.empty() && fs::is_regular_file(source.scene, error);
  source.scene_digest = there ? digest_of_what_is_there(source.scene, source.note)
                              : sha256_of(source.scene.empty() ? source.run : source.scene);
  if (there) source.instances = instances_of_scene(source.scene);
}

std::vector<DatasetSource> sources_of_survey(const std::string& run) {
  const SurveyRun survey = load_survey_run(run);
  const MissionFile of_mission = load_mission_tables((fs::path(run) / "mission.toml").string());
  std::vector<DatasetSource> sources;
  for (std::size_t h = 0; h < survey.heads.size(); ++h) {
    DatasetSource source;
    source.run = run, source.head = survey.heads[h].name, source.head_index = h;
    for (const auto& [number, files, mark] : all_blocks(run, survey, survey.heads[h]))
      if (path_exists(files.cube)) source.cubes.push_back(files.cube);
    source.randomise = of_mission.randomise, source.seed = of_mission.seed;
    find_scene(source, StoredRun((fs::path(run) / source.head).string()));
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace

std::vector<DatasetSource> dataset_sources(const std::vector<std::string>& runs) {
  std::vector<DatasetSource> sources;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::string& run = runs[r];
    const std::size_t before = sources.size();
    if (is_survey_run(run)) {
      for (DatasetSource& source : sources_of_survey(run)) sources.push_back(std::move(source));
    } else {
      DatasetSource& source = sources.emplace_back();
      source.run = run, source.cubes = {StoredRun(run).cube()};
      const StoredRun folder(is_folder(run) ? run : fs::path(run).parent_path().string());
      find_scene(source, folder);
      const RunDraws draws = folder.draws();
      source.draw_key = source.scene_digest + fmt::format(" {} {}", draws.seed, draws.rule.draw);
    }
    for (std::size_t s = before; s < sources.size(); ++s) {
      sources[s].run_index = r;
      for (const std::string& cube : sources[s].cubes)
        for (const TrackPoint& ping : read_track(cube)) sources[s].track.push_back(ping);
    }
  }
  return sources;
}

void for_each_labelled_ping(const DatasetSource& source,
                            const std::function<void(const Cube&, const Ping&, std::size_t)>& body) {
  std::size_t index = 0;
  for (const std::string& path : source.cubes)
    read_cube_pings(path, [&](const Cube& cube, const Ping& ping) {
      if (ping.labels.empty())
        fail(ErrorKind::content, path, ": ping ", ping.number,
             " has no labels: make it with --keep labels, in a mission keep = [\"labels\"] under [ping]");
      body(cube, ping, index++);
    });
}

}  // namespace insonify::tool
