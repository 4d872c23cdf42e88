// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "returns/looks.hpp"
#include "run/requested_simulation.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/run_folder.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/projected_system.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "store/run_directory.hpp"
#include "store/survey_run.hpp"
#include "tool/info/info.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// How much of a head of a survey is done, and the notes of its pings: of its merged cube, or of its blocks.
struct HeadState {
  std::size_t done = 0, failed = 0;  ///< blocks, pings
  bool merged = false;
  std::vector<PingNote> notes{};
};

StoredRun folder_of(const std::string& run, const std::string& head) {
  return StoredRun((fs::path(run) / head).string());
}

HeadState state_of(const std::string& run, const SurveyRun& survey, const SurveyRunHead& head) {
  const std::string merged = folder_of(run, head.name).find("cube.h5");
  HeadState state{.merged = !merged.empty()};
  if (state.merged) state.notes = read_cube(merged, 0, 0).notes;
  for (const StoredBlock& block : stored_blocks(run, survey, head)) {
    ++state.done, state.failed += block.mark.failed.size();
    if (!state.merged && !block.mark.cube_sha256.empty()) gather(state.notes, read_cube(block.files.cube, 0, 0).notes);
  }
  return state;
}

ordered_json notes_json(const std::vector<PingNote>& notes, const std::string& head = "") {
  ordered_json json = ordered_json::array();
  for (const PingNote& note : notes) json.push_back(note_json(note, head));
  return json;
}

/// The option of `export` by which a run gets its position, with a blank before it: none if mission or scene say it, that
/// of projected coordinates far from the origin, else an anchor.
std::string place_option(const std::string& run, const std::string& head) {
  try {
    const RunPings pings = find_run_pings(run, head);
    if (pings.anchor || epsg_of_system(pings.system) > 0) return "";
    for (const Eigen::Vector3d& position : ends_of(pings))
      if (position.head<2>().norm() > farthest_from_anchor) return " --utm ZONE";
  } catch (const Error&) {
    // Where files of its mission are gone, its position is unknown.
  }
  return " --anchor LAT,LON,HEADING";
}

/// How a finished head goes on; `target` is what `export` takes.
std::vector<std::string> products_of(const std::string& target, const std::string& run, const std::string& head,
                                     const Run& settings) {
  std::vector<std::string> next;
  if (settings.simulation.outputs.split_phase) {
    next.push_back("insonify export " + target + " --to csv -o soundings.csv");
    next.push_back("insonify export " + target + " --to gsf" + place_option(run, head) + " -o soundings.gsf");
  }
  next.push_back("insonify export " + target + " -o vtk");
  return next;
}

ordered_json survey_info(const std::string& run) {
  const SurveyRun survey = load_survey_run(run);
  ordered_json heads = ordered_json::array(), notes = ordered_json::array();
  bool done = true, merged = true, labelled = false;
  for (const SurveyRunHead& head : survey.heads) {
    const HeadState state = state_of(run, survey, head);
    done &= state.done == head.blocks(), merged &= state.merged;
    labelled |= keeps(folder_of(run, head.name).settings().value_or(Run{}), "contributors");
    for (const ordered_json& note : notes_json(state.notes, head.name)) notes.push_back(note);
    heads.push_back({{"name", head.name},
                     {"pings", head.pings},
                     {"blocks", head.blocks()},
                     {"blocks_done", state.done},
                     {"failed_pings", state.failed},
                     {"merged", state.merged}});
  }
  const std::string word = shell_word(run);
  std::vector<std::string> next;
  if (!done) next.push_back("insonify survey MISSION -o " + word + "  # the mission that it was begun with");
  if (done && !merged) next.push_back("insonify merge " + word);
  if (done && merged) {
    next.push_back("insonify image " + word + " --view track -o track.png");
    const std::string name = survey.heads.front().name;
    const std::string target = survey.heads.size() == 1 ? word : word + " --head " + name;
    for (std::string& command : products_of(target, run, name, folder_of(run, name).settings().value_or(Run{})))
      next.push_back(std::move(command));
  }
  if (done && labelled) next.push_back("insonify dataset " + word + " -o dataset");
  next.push_back("insonify view " + word);
  return {{"path", run},
          {"format", "insonify survey"},
          {"state", !done    ? "unfinished"
                    : merged ? "merged"
                             : "done, not merged"},
          {"heads", heads},
          {"notes", notes},
          {"mosaic", path_exists(fs::path(run) / "mosaic.vti")},
          {"next", next}};
}

/// Returns facts of a head that is not merged yet: of its blocks alone.
ordered_json head_info(const std::string& run, const SurveyRun& survey, const SurveyRunHead& head) {
  const HeadState state = state_of(run, survey, head);
  const std::string word = shell_word(run);
  const bool done = state.done == head.blocks();
  return {{"path", (fs::path(run) / head.name).string()},
          {"format", "insonify survey, one head of it"},
          {"survey", run},
          {"pings", head.pings},
          {"blocks", head.blocks()},
          {"blocks_done", state.done},
          {"failed_pings", state.failed},
          {"merged", state.merged},
          {"notes", notes_json(state.notes)},
          {"next",
           {done ? "insonify merge " + word
                 : "insonify survey MISSION -o " + word + "  # the mission that it was begun with",
            "insonify info " + word}}};
}

std::optional<std::pair<std::string, SurveyRunHead>> head_of_survey(const fs::path& folder) {
  fs::path run = (folder / "..").lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  if (!is_survey_run(run.string())) return {};
  for (const SurveyRunHead& head : load_survey_run(run.string()).heads)
    if (head.name == fs::absolute(folder).filename()) return std::pair(run.string(), head);
  return {};
}

/// Returns facts of any folder that insonify wrote: what its manifest says, without objects and long lists.
ordered_json manifest_info(const std::string& path, const ordered_json& manifest) {
  ordered_json info = {{"path", path}, {"format", "folder written by insonify"}};
  if (!manifest.contains("insonify_version"))
    fail(ErrorKind::content, path, "/manifest.json: is no manifest of insonify");
  for (const auto& [key, value] : manifest.items())
    if (key != "schema" && (value.is_primitive() || (value.is_array() && value.size() < 8))) info[key] = value;
  info["next"] = {"insonify info --verify " + shell_word(path)};
  return info;
}

std::vector<std::string> next_of_run(const std::string& path) {
  const std::string word = shell_word(path);
  std::vector<std::string> next = {"insonify image " + word + " -o picture.png"};
  const Run settings = StoredRun(path).settings().value_or(Run{});
  if (is_folder(path)) next.push_back("insonify view " + word);
  for (std::string& command : products_of(word, path, "", settings)) next.push_back(std::move(command));
  if (keeps(settings, "contributors")) next.push_back("insonify dataset " + word + " -o dataset");
  return next;
}

/// Returns the facts of a cube that its first ping and its attributes state; those of all pings have their place only.
ordered_json facts_of(const std::string& file, const Cube& cube, const Ping& first) {
  ordered_json layers = ordered_json::array();
  for (const Layer& layer : first.layers) layers.push_back(layer.name);
  const char* holds = first.display_cells ? "display cells" : first.expected_level ? "expected levels" : "samples";
  return {{"path", file},
          {"format", "insonify ping cube"},
          {"sonar", cube.sonar},
          {"pings", {}},
          {"beams", first.fan.beams()},
          {"bins", first.gate.bins()},
          {"holds", holds},
          {"min_range_m", first.gate.min_range},
          {"max_range_m", first.gate.max_range},
          {"bin_size_m", first.gate.bin_size},
          {"layers", layers},
          {"centre_frequency_hz", cube.centre_frequency},
          {"bandwidth_hz", cube.bandwidth},
          {"source_level_db", cube.source_level_db},
          {"sound_speed", {}},
          {"absorption_db_per_m", {}},
          {"seed", cube.seed},
          {"peak_level_db", {}},
          {"notes", notes_json(cube.notes)},
          {"insonify_version", cube.insonify_version}};
}

}  // namespace

std::string shell_word(const std::string& path) {
  const auto plain = [](char c) {
    const bool ascii = static_cast<unsigned char>(c) < 128;
    return !ascii || std::isalnum(c) != 0 || std::string_view("_./-+,:@%=").find(c) != std::string_view::npos;
  };
  if (!path.empty() && std::all_of(path.begin(), path.end(), plain)) return path;
  std::string word = "'";
  for (const char c : path) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

ordered_json info_of_cube(const std::string& path) {
  const std::string file = StoredRun(path).cube();
  ordered_json info;
  std::size_t pings = 0;
  FactSpan sound_speed, absorption;  // the water of a dive is not one number
  float peak = silence_db;
  read_cube_pings(file, [&](const Cube& cube, const Ping& ping) {
    if (pings++ == 0) info = facts_of(file, cube, ping);
    sound_speed.add(ping.sound_speed), absorption.add(ping.absorption_db_per_m);
    peak = std::max(peak, level_db(ping).maxCoeff());
  });
  info["pings"] = pings;
  info["sound_speed"] = sound_speed.number_or_json();
  info["absorption_db_per_m"] = absorption.number_or_json();
  info["peak_level_db"] = peak;
  if (const ordered_json manifest = StoredRun(path).json("manifest.json"); manifest.contains("built_with"))
    info["built_with"] = manifest["built_with"];
  info["next"] = next_of_run(path);
  return info;
}

ordered_json info_of_folder(const std::string& path) {
  fs::path folder = fs::path(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // of a path that ends with a slash
  if (is_survey_run(path)) return survey_info(path);
  const StoredRun run(folder.string());
  if (!run.find("cube.h5").empty()) return info_of_cube(folder.string());
  if (const auto head = head_of_survey(folder))
    return head_info(head->first, load_survey_run(head->first), head->second);
  if (!run.find("manifest.json").empty()) return manifest_info(folder.string(), run.json("manifest.json"));
  fail(ErrorKind::content, path, ": is no run, survey, head of a survey or export of insonify: it holds no cube.h5, ",
       "survey.toml or manifest.json; give one of its files, or the folder of a run");
}

}  // namespace insonify::tool
