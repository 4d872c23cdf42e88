// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "store/environment_file.hpp"
#include "store/environment_keys.hpp"
#include "store/materials_file.hpp"
#include "store/sonar_file.hpp"
#include "store/toml_tree.hpp"
#include "tool/info/info.hpp"
#include "tool/survey/survey.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

ordered_json mission_info(const std::string& path) {
  SurveyOptions options;
  options.mission = path;
  const SurveySetup survey = set_up_survey(options);
  const Mission& mission = survey.file.mission;
  ordered_json heads = ordered_json::array(), legs = ordered_json::array();
  for (std::size_t h = 0; h < mission.heads.size(); ++h) {
    const PingSetup& head = survey.heads[h];
    const std::vector<SurveyPing>& all = survey.survey->pings();
    const auto pings = std::count_if(all.begin(), all.end(), [h](const SurveyPing& p) { return p.head == h; });
    heads.push_back({{"name", mission.heads[h].name},
                     {"sonar", head.spec.name},
                     {"range_m", range_text(head.spec.min_range, head.spec.max_range)},
                     {"pings", pings}});
  }
  for (const MissionLeg& leg : mission.legs) legs.push_back(leg.name);
  const std::string word = shell_word(path);
  const bool at_random = mission.random_pings > 0;
  const ordered_json extent = at_random
                                  ? ordered_json(mission.random_pings)
                                  : ordered_json(mission.trajectory.time.back() - mission.trajectory.time.front());
  return {{"path", path},
          {"format", "insonify mission"},
          {"scene", survey.file.scene},
          {at_random ? "random_poses" : "seconds", extent},
          {"heads", heads},
          {"legs", legs},
          {"next", {"insonify survey " + word + " --plan", "insonify survey " + word + " -o run"}}};
}

ordered_json materials_info(const std::string& path) {
  const MaterialTable table = load_materials(path);
  ordered_json names = ordered_json::array();
  for (const SourcedMaterial& m : table.materials) names.push_back(m.material.name);
  const std::string word = shell_word(path);
  return {{"path", path},
          {"format", "insonify materials"},
          {"field", table.field.name},
          {"materials", names},
          {"next",
           {"insonify materials " + word,
            "insonify ping SCENE --materials " + word + " --sonar oculus-m750d --pose=x,y,z,0,0,0 -o out",
            "insonify prepare SCENE --materials " + word + " -o prepared.ply"}}};
}

ordered_json settings_info(const std::string& path) {
  const Run run = load_ping_settings(path);
  const SonarSpec spec = load_sonar_file(path).spec;
  const std::optional<GivenPose>& pose = run.placement.pose;
  return {{"path", path},
          {"format", "insonify settings of a run"},
          {"scene", run.scene.path},
          {"sonar", spec.name},
          {"range_m", range_text(spec.min_range, spec.max_range)},
          {"pose", pose ? fmt::format("{}", fmt::join(*pose, ",")) : ""},
          {"seed", run.simulation.seed},
          {"next",
           {"insonify ping --run " + shell_word(path) + " -o again",
            "insonify ping --run " + shell_word(path) + " --seed 2 -o other-speckle"}}};
}

ordered_json environment_info(const std::string& path) {
  (void)load_environment(path);  // refuses what is wrong in it
  return {
      {"path", path},
      {"format", "insonify environment"},
      {"parts", load_toml(path).keys},
      {"next",
       {"insonify ping SCENE --environment " + shell_word(path) + " --sonar oculus-m750d --pose=x,y,z,0,0,0 -o out"}}};
}

ordered_json sonar_info(const std::string& path) {
  const SonarSpec spec = load_sonar_file(path).spec;
  const std::string word = shell_word(path);
  return {{"path", path},
          {"format", "insonify sonar"},
          {"name", spec.name},
          {"beams", spec.beams},
          {"centre_frequency_hz", spec.centre_frequency},
          {"bandwidth_hz", spec.bandwidth},
          {"range_m", range_text(spec.min_range, spec.max_range)},
          {"next",
           {"insonify sonars " + word, "insonify beampattern " + word + " -o pattern.png",
            "insonify ping SCENE --sonar " + word + " --pose=x,y,z,0,0,0 -o out"}}};
}

ordered_json parts_info(const std::string& path) {
  const PartsOfPings scene({path}, {.drawn_at_will = false});
  ordered_json scatters = ordered_json::array();
  for (const SceneScatterEntry& s : scene.file().scatters)
    scatters.push_back({{"bodies", joined(s.names)}, {"least", s.rule.least}, {"most", s.rule.most}});
  const SceneMoment begin{scene.scene().begin(), 0};
  const Bounds box = scene.box_at(begin);
  const auto point = [](const Eigen::Vector3d& p) { return ordered_json{p.x(), p.y(), p.z()}; };
  ordered_json json = {{"path", path}, {"format", scene.report().format}, {"parts", scene.parts_json(begin)}};
  if (!scatters.empty()) json["scatters"] = scatters;
  json["bounds"] = {{"min", point(box.min)}, {"max", point(box.max)}};
  if (!scene.report().notes.empty()) json["notes"] = scene.report().notes;
  json["next"] = next_of_scene(path, box);
  json["next"].push_back("insonify prepare " + shell_word(path) +
                         " -o merged.ply  # one cloud, with the part of each surfel");
  return json;
}

ordered_json of_survey_mark(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  return info_of_folder(folder.string());
}

/// Kinds of TOML files, each known by a key that no kind before it has.
struct TomlKind {
  const char* key;
  ordered_json (*info)(const std::string& path);
};
constexpr TomlKind toml_kinds[] = {{"insonify_version", settings_info},
                                   {"mission_sha256", of_survey_mark},
                                   {"part", parts_info},
                                   {"head", mission_info},
                                   {"survey", mission_info},
                                   {"material", materials_info}};

/// Returns true if a document has a table of an environment.
bool is_environment(const TomlValue& document) {
  Environment any;
  return std::ranges::any_of(environment_keys(any), [&](const Key& key) {
    return document.find(*key.section ? key.section : key.name) != nullptr;
  });
}

}  // namespace

ordered_json info_of_toml(const std::string& path) {
  const TomlValue document = load_toml(path);
  for (const TomlKind& kind : toml_kinds)
    if (document.find(kind.key)) return kind.info(path);
  return is_environment(document) ? environment_info(path) : sonar_info(path);
}

}  // namespace insonify::tool
