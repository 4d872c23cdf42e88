// SPDX-License-Identifier: BSD-3-Clause
#include "store/run_directory.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/error.hpp"
#include "files/input_file.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

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

}  // namespace insonify
