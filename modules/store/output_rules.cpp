// SPDX-License-Identifier: BSD-3-Clause
#include "store/output_rules.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/path_status.hpp"
#include "store/run_manifest.hpp"
#include "store/survey_run.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

/// Returns true if two names are of one file or folder, through links and on file systems that ignore case.
bool are_one(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return fs::equivalent(a, b, missing) && !missing;
}

/// Returns the folder of `folders` that is `path` or holds it, with links resolved; null if there is none.
const std::string* holder_of(const std::string& path, const InputPaths& folders) {
  std::error_code missing;
  fs::path at = fs::canonical(path, missing);
  if (missing) return nullptr;
  for (;; at = at.parent_path()) {
    for (const std::string& folder : folders)
      if (are_one(at, folder)) return &folder;
    if (at == at.parent_path()) return nullptr;
  }
}

/// Returns true if a file below the folder of a run or survey is part of it.
bool is_part_of(const std::string& folder, const fs::path& file) {
  const std::string name = real_path(file).lexically_relative(real_path(folder)).string();
  if (is_survey_run(folder)) return is_of_survey(folder, name);
  return name == "manifest.json" || name == "cube.h5" || name == "run.toml" || digests_of_run(folder).contains(name);
}

void require_no_input(const std::string& output, const InputPaths& inputs) {
  for (const std::string& input : inputs)
    if (are_one(output, input))
      fail(ErrorKind::file, output, ": is ", input == output ? "the input" : "the input " + input,
           ", which no output replaces; give another name");
}

}  // namespace

void require_free_file(const std::string& output, bool force, const InputPaths& inputs) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(output, ignored))) return;
  require_no_input(output, inputs);
  if (const std::string* const run = holder_of(output, inputs); run && is_part_of(*run, output))
    fail(ErrorKind::file, output, ": is a file of the input ", *run, ", which no output replaces; give another name");
  if (!force) fail(ErrorKind::file, output, ": exists already; give --force to replace it, or another name");
}

void require_run_alone(const std::string& folder, const std::string& called) {
  const std::vector<std::string> others = names_of_no_run(folder);
  if (others.empty()) return;
  fail(ErrorKind::file, called,
       ": holds what no run of insonify wrote, or what was changed since: ", shortened_list(others),
       "; --force replaces only what manifest.json lists; move these files, remove the folder yourself, or give "
       "another name");
}

void require_free_folder(const std::string& output, bool force, const InputPaths& inputs) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(output, ignored))) return;
  require_no_input(output, inputs);
  for (const std::string& input : inputs)
    if (holder_of(input, {output}))
      fail(ErrorKind::file, output, ": holds the input ", input, ", which no output replaces; give another name");
  if (!force) fail(ErrorKind::file, output, ": exists already; give --force to replace it, or another name");
  if (!fs::is_directory(output, ignored))
    fail(ErrorKind::file, output, ": is not a folder of an earlier run, so --force does not replace it; remove it ",
         "yourself, or give another name");
  require_run_alone(output, output);
}

}  // namespace insonify
