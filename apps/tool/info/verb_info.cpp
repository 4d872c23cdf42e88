// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/message.hpp"
#include "files/path_status.hpp"
#include "formats/swath_record.hpp"
#include "run/run_checks.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/info/info.hpp"
#include "tool/run/record_file.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
  CommonOptions common;
  std::vector<std::string> files;
  bool verify = false;
  MeaningOverride meaning;
};

void add_options(OptionList list, InfoOptions& o) {
  list.add("FILE", &o.files,
           "cloud, mesh, tiles, run, survey, head of a survey, cube.h5, or a .toml: scene of parts, mission, "
           "materials, sonar, environment, run.toml; or a recording: " +
               record_extensions(),
           {.required = true});
  list.add("--verify", &o.verify, "compare the files of runs and surveys with the SHA-256 in their manifests");
  add_settings(list, meaning_settings(o.meaning));
  add_common(list, o.common);
}

std::string text_of(const ordered_json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// A line for each fact, and for each entry of a list of objects or commands.
void print_facts(const ordered_json& info) {
  for (const auto& [key, value] : info.items()) {
    const bool lines = value.is_array() && !value.empty() && (key == "next" || value.front().is_object());
    if (!lines) {
      fmt::print("  {:<20} {}\n", key, text_of(value));
      continue;
    }
    for (const auto& entry : value) {
      std::string line = entry.is_object() ? "" : text_of(entry);
      if (entry.is_object())
        for (const auto& [name, fact] : entry.items())
          line += fmt::format("{}{} {}", line.empty() ? "" : ", ", name, text_of(fact));
      fmt::print("  {:<20} {}\n", key, line);
    }
  }
}

/// Compares the files of all runs. Throws Error(content) if one was changed.
void verify(const InfoOptions& o) {
  ordered_json all = ordered_json::array();
  std::vector<std::string> problems;
  for (const std::string& run : o.files) {
    const RunCheck check = check_run(run);
    for (const std::string& problem : check.problems) problems.push_back(run + ": " + problem);
    all.push_back({{"path", run}, {"files", check.files}, {"problems", check.problems}});
    if (!o.common.json && check.problems.empty()) fmt::print("{}: {} files match the manifest\n", run, check.files);
  }
  if (o.common.json) fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(2));
  if (!problems.empty()) fail(ErrorKind::content, shortened_list(problems), "; copy the run again, or make it again");
}

/// Shows on a terminal how far the reading of a scene is.
ordered_json read_scene(const std::string& path, const InfoOptions& o) {
  Progress progress(o.common, 1);
  progress.step("reading " + path);
  return info_of_scene(path, o.meaning);
}

void info(const InfoOptions& o) {
  if (o.verify) return verify(o);
  ordered_json all = ordered_json::array();
  for (const std::string& path : o.files) {
    const std::filesystem::path file(path);
    const bool recorded = !is_folder(file) && is_record(path);
    const bool is_scene = !recorded && !is_folder(file) && file.extension() != ".h5" && file.extension() != ".toml";
    if (recorded)
      all.push_back(is_swath(path) ? info_of_swath(path) : info_of_record(path));
    else if (is_scene)
      all.push_back(read_scene(path, o));
    else if (file.extension() == ".toml")
      all.push_back(info_of_toml(path));
    else
      all.push_back(is_folder(file) ? info_of_folder(path) : info_of_cube(path));
    if (!o.common.json) (all.back().contains("fields") ? print_scene : print_facts)(all.back());
  }
  if (o.common.json) fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(2));
}

}  // namespace

Verb info_verb() {
  return make_verb<InfoOptions>("info",
                                "what a file or folder holds, which problems it has, and which commands come next",
                                {"insonify info reef.pcd", "insonify info reef.pcd --json | jq .bounds",
                                 "insonify info mission.toml", "insonify info run", "insonify info --verify out"},
                                add_options, info);
}

}  // namespace insonify::tool
