// SPDX-License-Identifier: BSD-3-Clause
#include "store/scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/text.hpp"
#include "files/path_status.hpp"
#include "store/csv_tables.hpp"
#include "store/run_directory.hpp"
#include "store/scene_file_keys_internal.hpp"

namespace insonify {
namespace {

namespace fs = std::filesystem;

constexpr int scene_schema = 1;
constexpr std::size_t most_subranges = 65000;
/// Keys that place a part. A part without any of them is captured.
constexpr const char* placing_keys[] = {"position_m", "rest",       "bury_m",       "yaw_deg",        "pitch_deg",
                                        "roll_deg",   "trajectory", "velocity_mps", "turn_deg_per_s", "scale"};
/// Keys that a part with a trajectory must not have.
constexpr const char* replaced_by_trajectory[] = {"position_m", "rest", "bury_m", "velocity_mps", "turn_deg_per_s"};

/// Files that were read already, by path; many parts may name one file.
struct KnownFiles {
  std::map<std::string, std::shared_ptr<const SceneFile>> scenes;
  std::map<std::string, Trajectory> trajectories;
};

/// A scene file that is being read, and the chain of scene files that contain it.
struct Reader {
  std::string path;
  std::vector<std::string> chain;  // canonical paths, ending with this file
  KnownFiles& known;

  template <typename... Parts>
  [[noreturn]] void fail_at(int line, const Parts&... parts) const {
    fail_in_file(path, line, parts...);
  }
  SceneFile read() const;
  void read_part(const TomlValue& table, SceneFile& scene) const;
  void read_scatter(const TomlValue& table, SceneFile& scene) const;
  const Trajectory& trajectory_of(int line, const std::string& file) const;
  std::string path_of(int line, const char* key, const std::string& name) const;
  void complete(PartFile& file, int line, const char* key) const;
};

int line_in(const TomlValue& table, const char* key) {
  const TomlValue* value = table.find(key);
  return value ? value->line : table.line;
}

std::string Reader::path_of(int line, const char* key, const std::string& name) const {
  const fs::path named(name), found = named.is_absolute() ? named : fs::path(path).parent_path() / named;
  if (!path_exists(found))
    fail_at(line, key, " = '", name, "': there is no file ", found.string(), "; paths are relative to the scene file");
  return found.string();
}

/// Looks up the paths of a file, and reads it if it is a scene of parts.
void Reader::complete(PartFile& file, int line, const char* key) const {
  file.line = line;
  file.path = path_of(line, key, file.path);
  if (!file.materials.empty() && file.materials != "natural")
    file.materials = path_of(line, "materials", file.materials);
  file.kind = kind_of_scene(file.path);
  if (file.kind != SceneKind::parts) return;
  const std::string real = real_path(file.path).string();
  if (const auto begin = std::ranges::find(chain, real); begin != chain.end()) {
    const std::string names = joined(std::vector(begin, chain.end()), " -> ");
    fail_at(line, key, ": a scene cannot hold itself: ", names, " -> ", real);
  }
  if (!file.material.empty() || !file.materials.empty() || file.viewpoint || file.thin > 0 || file.spacing > 0)
    fail_at(line, file.path,
            " is a scene of parts: unit, material, materials, viewpoint_m, thin_m and spacing_m belong ",
            "to its own parts");
  std::shared_ptr<const SceneFile>& scene = known.scenes[file.path];
  if (!scene) {
    Reader inner{file.path, chain, known};
    inner.chain.push_back(real);
    scene = std::make_shared<const SceneFile>(inner.read());
  }
  file.scene = scene;
}

const Trajectory& Reader::trajectory_of(int line, const std::string& file) const {
  const auto [trajectory, is_new] = known.trajectories.try_emplace(file);
  if (!is_new) return trajectory->second;
  trajectory->second = lower_case(file).ends_with(".csv") ? load_trajectory(file) : load_tum_trajectory(file);
  at_line(path, line, [&] { require_valid(trajectory->second, "trajectory"); });
  return trajectory->second;
}

void set_placement(const Reader& reader, const TomlValue& table, const SceneTables& t, PartPlacement& p) {
  const auto given = [&](const char* key) { return table.find(key) != nullptr; };
  p.captured = std::ranges::none_of(placing_keys, given);
  if (p.captured) return;
  if (!t.trajectory.empty()) {
    for (const char* key : replaced_by_trajectory)
      if (given(key)) reader.fail_at(line_in(table, key), key, " follows from trajectory; leave it out");
    return;
  }
  const bool flat = t.position.size() == 2;
  for (std::size_t i = 0; i < t.position.size(); ++i) p.position[static_cast<Eigen::Index>(i)] = t.position[i];
  p.rest = t.rest == "bed"                                  ? PartRest::bed
           : t.rest == "ground" || (t.rest.empty() && flat) ? PartRest::ground
                                                            : PartRest::none;
  if (p.rest == PartRest::none && flat)
    reader.fail_at(line_in(table, "rest"), "rest = \"none\" needs a height: position_m = [x, y, z]");
  if (p.rest == PartRest::none && given("bury_m"))
    reader.fail_at(line_in(table, "bury_m"), "bury_m needs rest = \"ground\" or \"bed\"");
  if (t.turn.size() == 2)
    reader.fail_at(line_in(table, "turn_deg_per_s"), "turn_deg_per_s must be one number, or three");
  if (t.turn.size() == 1) p.turn_rate.z() = t.turn[0];
  if (t.turn.size() == 3) p.turn_rate = {t.turn[0], t.turn[1], t.turn[2]};
}

void Reader::read_part(const TomlValue& table, SceneFile& scene) const {
  SceneTables t;
  read_keys(path, table, scene_part_keys(t), "part");
  complete(t.part.file, line_in(table, "file"), "file");
  ScenePartEntry& part = t.part;
  if (part.name.empty()) part.name = fs::path(part.file.path).stem().string();
  set_placement(*this, table, t, part.placement);
  if (part.label.empty() && !part.placement.captured) part.label = part.name;
  if (!t.trajectory.empty()) {
    const int line = line_in(table, "trajectory");
    scene.trajectories.push_back(path_of(line, "trajectory", t.trajectory));
    part.placement.trajectory = trajectory_of(line, scene.trajectories.back());
  }
  scene.parts.push_back(std::move(part));
}

void Reader::read_scatter(const TomlValue& table, SceneFile& scene) const {
  SceneTables t;
  read_keys(path, table, scene_scatter_keys(t), "scatter");
  SceneScatterEntry& s = t.scatter;
  s.line = table.line;
  if (t.files.empty()) fail_at(line_in(table, "files"), "files = []: name one file at least");
  for (const std::string& name : t.files) {
    PartFile& file = s.files.emplace_back(t.scatter_file);
    file.path = name;
    complete(file, line_in(table, "files"), "files");
  }
  for (const auto& [key, words] : {std::pair{"names", &s.names}, std::pair{"labels", &s.labels}})
    if (!words->empty() && words->size() != s.files.size())
      fail_at(line_in(table, key), key, " has ", words->size(), " entries for ", s.files.size(), " files");
  if (s.names.empty())
    for (const PartFile& file : s.files) s.names.push_back(fs::path(file.path).stem().string());
  if (s.labels.empty()) s.labels = s.names;
  s.rule.least = static_cast<int>(t.count.front()), s.rule.most = static_cast<int>(t.count.back());
  if (!t.bury.empty()) s.rule.least_bury = t.bury.front(), s.rule.most_bury = t.bury.back();
  if (!t.scale.empty()) s.rule.least_scale = t.scale.front(), s.rule.most_scale = t.scale.back();
  if (t.min_distance > 0) s.rule.min_distance = t.min_distance;
  at_line(path, table.line, [&] { require_valid(s.rule, "scatter"); });
  scene.scatters.push_back(std::move(s));
}

SceneFile Reader::read() const {
  const TomlValue document = load_toml(path);
  require_schema(path, document, scene_schema);
  SceneFile scene{path, read_text_file(path), {}, {}, {}};
  read_keys(path, document, {{"", "part", "", list_of_tables(), "", true}, {"", "scatter", "", list_of_tables(), ""}},
            "", {"schema"});
  std::map<std::string, int> line_of_name;
  for (const TomlValue& table : document.find("part")->items) {
    read_part(table, scene);
    const auto [before, is_new] = line_of_name.try_emplace(scene.parts.back().name, table.line);
    if (!is_new)
      fail_at(table.line, "two parts are called '", scene.parts.back().name, "', the other one in line ",
              before->second, "; give one of them another name");
  }
  if (const TomlValue* scatters = document.find("scatter"))
    for (const TomlValue& table : scatters->items) read_scatter(table, scene);
  std::size_t most = scene.parts.size();
  for (const SceneScatterEntry& s : scene.scatters) {
    most += s.files.size() * static_cast<std::size_t>(s.rule.most);
    if (most > most_subranges)
      fail_at(s.line, "count of ", s.rule.most, " for each of ", s.files.size(), " files: more than ", most_subranges,
              " parts in all; ask for fewer");
  }
  if (most > most_subranges) fail_at(document.line, most, " parts, must be at most ", most_subranges);
  return scene;
}

}  // namespace

SceneKind kind_of_scene(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return ending == ".tiles" ? SceneKind::tiles : lower_case(ending) == ".toml" ? SceneKind::parts : SceneKind::file;
}

SceneFile load_scene_file(const std::string& path) {
  if (!path_exists(path)) fail(ErrorKind::file, path, ": no such file");
  KnownFiles known;
  return Reader{path, {real_path(path).string()}, known}.read();
}

std::vector<std::string> files_of(const SceneFile& scene) {
  std::vector<std::string> files{scene.path};
  files.insert(files.end(), scene.trajectories.begin(), scene.trajectories.end());
  const auto add = [&](const PartFile& file) {
    if (!file.materials.empty()) files.push_back(file.materials);
    const std::vector<std::string> more = file.scene ? files_of(*file.scene) : std::vector{file.path};
    files.insert(files.end(), more.begin(), more.end());
  };
  for (const ScenePartEntry& part : scene.parts) add(part.file);
  for (const SceneScatterEntry& scatter : scene.scatters)
    for (const PartFile& file : scatter.files) add(file);
  return files;
}

}  // namespace insonify
