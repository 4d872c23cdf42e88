// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_checks.hpp"

#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/sha256.hpp"
#include "store/run_directory.hpp"
#include "store/survey_run.hpp"

namespace insonify {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

void compare_file(RunCheck& check, const std::string& path, const std::string& name, const std::string& digest) {
  ++check.files;
  if (!path_exists(path))
    check.problems.push_back(name + " is missing");
  else if (sha256_of_file(path) != digest)
    check.problems.push_back(name + " was changed");
}

RunCheck check_survey(const std::string& run) {
  RunCheck check;
  const SurveyRun survey = load_survey_run(run);
  for (const SurveyRunHead& head : survey.heads)
    for (const auto& [number, files, mark] : stored_blocks(run, survey, head))
      for (const auto& [path, digest] :
           {std::pair(files.cube, mark.cube_sha256), std::pair(files.returns, mark.returns_sha256),
            std::pair(files.coverage, mark.coverage_sha256)})
        if (!digest.empty()) compare_file(check, path, fs::path(path).lexically_relative(run).string(), digest);
  return check;
}

}  // namespace

std::string built_with() { return INSONIFY_BUILT_WITH; }

void write_manifest(const RunDirectory& directory, ordered_json manifest) {
  std::map<std::string, std::string> digests = manifest.value(digests_key, ordered_json::object());
  const fs::path folder = directory.file("");
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (const std::string name = fs::relative(entry.path(), folder).string();
          entry.is_regular_file() && !digests.contains(name))
        digests[name] = sha256_of_file(entry.path().string());
  });
  manifest["built_with"] = built_with();
  manifest.erase(digests_key);  // to the end
  manifest[digests_key] = digests;
  write_file(directory.file("manifest.json"), manifest.dump(2) + "\n");
}

RunCheck check_run(const std::string& run, const std::string& only) {
  if (!is_folder(run))
    fail(ErrorKind::file, run, ": is no folder; --verify compares the files of a run: give the folder of a run");
  if (is_survey_run(run)) return check_survey(run);
  RunCheck check;
  const auto digests = digests_of_run(run);
  if (digests.empty() && only.empty())
    fail(ErrorKind::content, run,
         ": has no manifest.json with the SHA-256 of its files, and nothing can be compared; give the folder of a run");
  for (const auto& [name, digest] : digests)
    if (only.empty() || name == only) compare_file(check, (fs::path(run) / name).string(), name, digest);
  return check;
}

std::string integrity_problem(const std::string& run, const std::string& file) {
  if (!is_folder(run) || is_survey_run(run)) return {};
  const RunCheck check = check_run(run, file);
  return check.problems.empty() ? "" : run + ": " + check.problems.front() + " since the run was made";
}

}  // namespace insonify
