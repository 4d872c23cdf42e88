// SPDX-License-Identifier: BSD-3-Clause
#include "store/run_directory.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "files/sha256.hpp"
#include "store/survey_run.hpp"

namespace insonify {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// Returns a path without a slash at its end: "out/" and "out" are one folder.
std::string without_trailing_slash(const std::string& path) {
  fs::path clean = fs::path(path).lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();
  return clean.string();
}

// Returns `path` without a slash at its end. Throws Error(file) if a run may not have this name.
std::string free_name(const std::string& path, bool force, const InputPaths& inputs) {
  const std::string target = without_trailing_slash(path);
  if (target.empty() || target == "." || target == "/" || fs::path(target).filename() == "..")
    fail(ErrorKind::file, "\"", path, "\": is not a valid name for a new folder");
  const fs::path parent = fs::path(target).parent_path();
  std::error_code ignored;
  if (!parent.empty() && !fs::is_directory(parent, ignored))
    fail(ErrorKind::file, target, ": folder ", parent.string(), " does not exist; create it first");
  require_free_folder(target, force, inputs);
  // Keep a link to an earlier run: the run replaces the folder to which it leads.
  const fs::path folder = fs::is_symlink(target, ignored) ? fs::canonical(target, ignored) : fs::path();
  return folder.empty() ? target : folder.string();
}

constexpr const char* manifest_name = "manifest.json";

/// Returns the manifest of a folder; null if there is none.
json manifest_in(const std::string& folder) {
  const std::string path = (fs::path(folder) / manifest_name).string();
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return {};
  json manifest = json::parse(read_text_file(path), nullptr, false);
  if (!manifest.is_object())
    fail(ErrorKind::content, path, ": is damaged; run the ping again, or copy its folder again");
  return manifest;
}

/// Returns true if a name in a manifest is of a file below its folder.
bool lies_below(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  return !path.empty() && path.is_relative() && *path.begin() != "..";
}

std::map<std::string, std::string> digests_in(const json& manifest) {
  std::map<std::string, std::string> digests;
  const auto found = manifest.find(digests_key);
  if (found == manifest.end() || !found->is_object()) return digests;
  for (const auto& [name, digest] : found->items())
    if (digest.is_string() && lies_below(name)) digests[name] = digest.get<std::string>();
  return digests;
}

bool is_unchanged(const fs::path& file, const std::string& digest) {
  constexpr std::uintmax_t most_bytes = 16 << 20;  // takes some milliseconds
  return size_of_file(file) > most_bytes || sha256_of_file(file.string()) == digest;
}

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

RunDirectory::RunDirectory(const std::string& path, bool force, const InputPaths& inputs)
    : path_(free_name(path, force, inputs)), force_(force) {
  std::error_code error;
  fs::remove_all(path_.temporary(), error);
  if (!fs::create_directory(path_.temporary(), error))
    fail(ErrorKind::file, path_.target(), ": cannot be created: ", error.message());
}

std::string RunDirectory::file(const std::string& name) const { return (fs::path(path_.temporary()) / name).string(); }

void RunDirectory::commit() {
  const std::string& target = path_.target();
  if (committed_) fail(ErrorKind::runtime, "RunDirectory::commit: ", target, " is committed already");
  std::error_code ignored;
  const bool exists = fs::exists(fs::symlink_status(target, ignored));
  if (exists && !force_) require_free_folder(target, force_, {});
  if (exists)
    path_.commit_in_place_of_folder([&](const std::string& old) { require_run_alone(old, target); });
  else
    path_.commit();
  committed_ = true;
}

std::string read_text_file(const std::string& path) {
  require_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (in.bad() || !in.is_open())
    fail(ErrorKind::file, path, ": cannot be read: ", std::generic_category().message(errno));
  return std::move(text).str();
}

std::map<std::string, std::string> digests_of_run(const std::string& folder) {
  const json manifest = manifest_in(folder);
  return manifest.is_object() ? digests_in(manifest) : std::map<std::string, std::string>{};
}

std::vector<std::string> names_of_no_run(const std::string& folder) {
  const json manifest = manifest_in(folder);
  const bool is_run = manifest.is_object() && manifest.contains("insonify_version");
  const auto digests = is_run ? digests_in(manifest) : std::map<std::string, std::string>{};
  std::vector<std::string> others;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = fs::path(entry.path()).lexically_relative(folder).string();
      const fs::file_status status = entry.symlink_status();
      if (fs::is_directory(status) || (is_run && name == manifest_name && fs::is_regular_file(status))) continue;
      const auto listed = digests.find(name);
      if (!fs::is_regular_file(status) || listed == digests.end() || !is_unchanged(entry.path(), listed->second))
        others.push_back(name);
    }
  });
  std::sort(others.begin(), others.end());
  return others;
}

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
