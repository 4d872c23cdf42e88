#include "tool/dataset_runs.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "core/sha256.hpp"
#include "store/survey_run.hpp"
#include "tool/image.hpp"
#include "tool/ping_setup.hpp"
#include "tool/scene_files.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// Notes the scene of a run, and the instances of its points if its cloud has them.
void find_scene(DatasetSource& source, const std::string& settings_folder) {
  source.scene = scene_of_run(settings_folder).path;
  std::error_code error;
  const bool there = !source.scene.empty() && fs::is_regular_file(source.scene, error);
  source.scene_digest =
      there ? sha256_of_file(source.scene) : sha256_of(source.scene.empty() ? source.run : source.scene);
  if (there) source.instances = instances_of_scene(source.scene);
}

std::vector<DatasetSource> sources_of_survey(const std::string& run) {
  const SurveyRun survey = load_survey_run(run);
  const std::string mission = (fs::path(run) / "mission.toml").string();
  std::vector<DatasetSource> sources;
  for (std::size_t h = 0; h < survey.heads.size(); ++h) {
    DatasetSource source{run, survey.heads[h].name, h, {}, {}, {}, {}};
    for (std::size_t b = 0; b < survey.heads[h].blocks(); ++b) {
      const BlockFiles files = block_files(run, source.head, static_cast<std::int64_t>(b));
      if (!find_mark(files, survey.mission_sha256))
        fail(ErrorKind::content, run, ": block ", b, " of head ", source.head, " is not done; run the survey again");
      if (fs::exists(files.cube)) source.cubes.push_back(files.cube);
    }
    source.randomisation = load_survey_randomisation(mission);
    find_scene(source, (fs::path(run) / source.head).string());
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace

std::vector<DatasetSource> dataset_sources(const std::vector<std::string>& runs) {
  std::vector<DatasetSource> sources;
  for (const std::string& run : runs) {
    if (is_survey_run(run)) {
      for (DatasetSource& source : sources_of_survey(run)) sources.push_back(std::move(source));
      continue;
    }
    DatasetSource source{run, {}, 0, {run_cube_path(run)}, {}, {}, {}};
    find_scene(source, fs::is_directory(run) ? run : fs::path(run).parent_path().string());
    sources.push_back(std::move(source));
  }
  return sources;
}

void split_by_scene(std::vector<DatasetSource>& sources, const std::vector<double>& shares) {
  std::set<std::string> scenes;
  for (const DatasetSource& source : sources) scenes.insert(source.scene_digest);
  const double sum = shares[0] + shares[1] + shares[2], count = static_cast<double>(scenes.size());
  const double train = std::max(1.0, std::round(count * shares[0] / sum));
  const double val = std::round(count * (shares[0] + shares[1]) / sum);
  double scene = 0;
  for (const std::string& digest : scenes) {
    const char* split = scene < train ? "train" : scene < val ? "val" : "test";
    for (DatasetSource& source : sources)
      if (source.scene_digest == digest) source.split = split;
    ++scene;
  }
}

void for_each_labelled_ping(const DatasetSource& source, const std::function<void(const Cube&, const Ping&)>& body) {
  for (const std::string& path : source.cubes) {
    const Cube cube = read_cube(path);
    for (const Ping& ping : cube.pings) {
      if (ping.labels.empty())
        fail(ErrorKind::content, path, ": ping ", ping.number,
             " has no labels: make it with --keep contributors, in a mission keep = [\"contributors\"] under [ping]");
      body(cube, ping);
    }
  }
}

}  // namespace insonify::tool
