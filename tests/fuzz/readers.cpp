// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/readers.hpp"

#include "formats/aris_file.hpp"
#include "formats/npy_file.hpp"
#include "formats/oculus_file.hpp"
#include "formats/r2sonic_record.hpp"
#include "formats/xtf_file.hpp"
#include "fuzz/damage_toml.hpp"
#include "sampling/scene_cut.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/load_scene.hpp"
#include "store/contributor_file.hpp"
#include "store/csv_tables.hpp"
#include "store/cube.hpp"
#include "store/environment_file.hpp"
#include "store/materials_file.hpp"
#include "store/mission_file.hpp"
#include "store/sonar_file.hpp"
#include "tiles/tiled_scene.hpp"
#ifdef INSONIFY_FUZZ_TOOL
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <sstream>

#include <unistd.h>

#include "run/run_settings.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/run_directory.hpp"
#include "tool/command/program.hpp"
#include "tool/run/record_file.hpp"
#include "view/grey_file.hpp"
#endif

namespace insonify {
namespace {

void read_scene(const std::string& path) {
  LoadOptions options;
  options.threads = 1;
  load_scene(path, options);
}

// Describes a file, as `info` does.
void read_description(const std::string& path) { describe_file(path); }

void read_tiles(const std::string& path) {
  const TiledScene tiles(path);
  tiles.load(tiles.select_all(), 0, 1);
  tiles.cut(region_around({0, 0, 0}, 1e6), {}, {0.1, 1e6, 1}, {1e-9, 0, 1, 1});  // all nodes
}

#ifdef INSONIFY_FUZZ_TOOL
/// Runs a verb, whose words have no blanks. Ends this process with its exit code unless that is 0.
void run_verb(const std::string& line) {
  std::istringstream in("insonify " + line + " -q");
  std::vector<std::string> words(std::istream_iterator<std::string>(in), {});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  if (!std::freopen("/dev/null", "w", stdout)) std::abort();
  const int code = tool::run_tool(static_cast<int>(arguments.size()), arguments.data());
  std::fflush(nullptr);
  if (code != 0) _exit(code);
}

/// Runs `info`, then a ping of four beams: of all rows or of levels, as the file's bytes choose.
void ping_tiles(const std::string& path) {
  const std::string run = path + ".run";
  const bool levels = std::hash<std::string>{}(read_text_file(path)) % 2 == 0;
  std::filesystem::remove_all(run);
  read_tiles(path);
  run_verb("info " + path);
  run_verb("ping " + path + " --sonar p900-45 --set sonar.beams=4 --pose=-2,0,2,0,30,0 --range 1:12 -j1 --no-picture " +
           "--scatterers-per-cell 0 -o " + run + (levels ? " --detail-spacing 0.5" : ""));
  std::filesystem::remove_all(run);
}

/// Runs a verb that reads the folder of a survey, chosen by the file's size, then its survey, of four beams, and merge.
void go_on_with_survey(const std::string& path) {
  const std::string bytes = read_text_file(path), folder = path + ".folder", run = folder + "/run";
  std::filesystem::remove_all(folder);
  unpack_folder(bytes, folder);
  const std::string survey = "survey " + folder + "/m.toml -j1 -o " + run;
  const std::vector<std::string> first = {"merge " + run, "info " + run, "info --verify " + run,
                                          "export " + run + " --to csv -o " + folder + "/x.csv", survey};
  for (const std::string& line : {first[bytes.size() % first.size()], survey, "merge " + run}) run_verb(line);
  std::filesystem::remove_all(folder);
}

/// Pings a scene at time 0 with four beams, 5 m ahead of them. Lists contributors of pixels only if surfels are few.
void ping_with_four_beams(const SceneCloud& scene, const Environment& environment = {}) {
  SonarSpec spec = find_sonar("p900-45").spec;
  spec.beams = 4, spec.min_range = 1, spec.max_range = 10;
  SimulationOptions options;
  options.threads = 1;
  options.outputs.contributors = scene.size() < 100'000 ? 2 : 0;
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  simulate_ping(scene, make_head(spec, slowest_sound(environment)), pose, environment, options);
}

/// Returns a wall of 30 x 30 surfels across the beams, with these materials in columns.
SceneCloud wall_of(const std::vector<Material>& materials) {
  SceneCloud wall;
  wall.materials = materials;
  for (std::size_t i = 0; i < 900; ++i) {
    const double y = -0.75 + 0.05 * static_cast<double>(i % 30), z = -4.5 + 0.05 * static_cast<double>(i / 30);
    add_surfel(wall, {5, y, z}, {-1, 0, 0}, 0.0025, static_cast<std::uint16_t>(i % materials.size()));
  }
  return wall;
}

void ping_materials(const std::string& path) {
  ping_with_four_beams(wall_of(materials_by_label(load_materials(path))));
}

void ping_mirrors(const std::string& path) { ping_with_four_beams(wall_of({Material{}}), load_environment(path)); }

/// Pings a scene of parts. One with more surfels than a ping takes in a few seconds (a box of 1 m sampled each 3 mm) is
/// only read.
void ping_parts(const std::string& path) {
  PartsOfPings scene({path}, {{}, 1, 0, false});
  std::size_t surfels = 0;
  for (const PlacedPart& part : scene.placed_at({})) surfels += part.absent ? 0 : part.cloud->size();
  if (surfels < 700'000) ping_with_four_beams(scene.take_whole({}).scene);
}
#endif

}  // namespace

const std::vector<FuzzedReader>& fuzzed_readers() {
  static const std::vector<FuzzedReader> readers = {
      {"pcd", ".pcd", read_description},
      {"ply", ".ply", read_description},
      {"obj", ".obj", read_scene},
      {"stl", ".stl", read_scene},
      {"vtk", ".vtk", read_description},
      {"vtp", ".vtp", read_description, {}, true},
      {"gltf", ".gltf", read_scene},
      {"glb", ".glb", read_scene},
      {"xyz", ".xyz", read_description},
      {"dae", ".dae", read_scene, {}, true},
      {"fbx", ".fbx", read_scene, {}, true},
      {"off", ".off", read_scene, {}, true},
      {"x3d", ".x3d", read_scene, {}, true},
      {"wrl", ".wrl", read_scene, {}, true},
      {"3mf", ".3mf", read_scene, {}, true},
      {"pts", ".pts", read_scene},
      {"ptx", ".ptx", read_scene},
      {"csv", ".csv", read_scene},
      {"asc", ".asc", read_scene, {}, true},
      {"las", ".las", read_description},
#ifdef INSONIFY_LASZIP
      {"laz", ".laz", read_description, {}, true},
#endif
      {"tiff", ".tif", read_scene, {}, true},
      {"tiles", ".tiles", read_tiles, {}, true},
      {"sonar", ".toml", [](const std::string& path) { load_sonar_file(path); }},
      {"environment", ".toml", [](const std::string& path) { load_environment(path); }},
      {"mission", ".toml", [](const std::string& path) { load_mission(path); }},
      {"profile", ".csv", [](const std::string& path) { load_sound_speed_profile(path); }},
      {"trajectory", ".csv", [](const std::string& path) { load_trajectory(path); }},
      {"tum", ".txt", [](const std::string& path) { load_tum_trajectory(path); }},
      {"scatterers", ".csv", [](const std::string& path) { load_scatterer_table(path); }},
      {"labels", ".csv", [](const std::string& path) { load_labels(path); }},
      {"cube", ".h5", [](const std::string& path) { read_cube(path); }, {}, true},
      {"contributors", ".h5", [](const std::string& path) { read_contributor_file(path); }, {}, true},
      {"aris", ".aris", [](const std::string& path) { read_aris_frame(path, 0); }},
      {"xtf", ".xtf", [](const std::string& path) { read_xtf(path); }},
      {"gsf", ".gsf", [](const std::string& path) { read_swath(path); }},
      {"kmall", ".kmall", [](const std::string& path) { read_swath(path); }},
      {"r2sonic", ".xtf", [](const std::string& path) { read_r2sonic_xtf(path); }},
      {"oculus", ".raw", [](const std::string& path) { level_db(read_oculus_ping(path, 0)); }},
      {"npy", ".npy", [](const std::string& path) { read_npy(path); }},
#ifndef INSONIFY_FUZZ_TOOL
      {"materials", ".toml", [](const std::string& path) { load_materials(path); }, damage_toml},
#else
      {"materials", ".toml", ping_materials, damage_toml},
      {"mirrors", ".toml", ping_mirrors, damage_toml},
      {"scene", ".toml", ping_parts, damage_toml},
      {"png", ".png", [](const std::string& path) { load_grey_png(path); }, {}, true},
      {"run", ".toml", [](const std::string& path) { load_ping_settings(path); }},
      {"record", ".xtf", [](const std::string& path) { tool::read_record(path); }},
      {"swath", ".gsf", [](const std::string& path) { run_verb("info " + path), tool::read_record(path); }},
      {"levels", ".tiles", ping_tiles, damage_tiles, true},
      {"survey", ".folder", go_on_with_survey, damage_folder},
#endif
  };
  return readers;
}

}  // namespace insonify
