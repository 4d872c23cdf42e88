#include "store/run_directory.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/error.hpp"
#include "core/input_file.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

// "out/" and "out" are the same folder.
std::string without_trailing_slash(const std::string& path) {
  fs::path clean = fs::path(path).lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();
  return clean.string();
}

// True if --force may replace the folder: only empty folders and earlier runs.
bool may_be_replaced(const fs::path& folder) {
  constexpr std::array marks = {"manifest.json", "run.toml", "cube.h5", "sweep.csv"};
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return false;
  if (fs::is_empty(folder, ignored)) return true;
  for (const char* mark : marks)
    if (fs::exists(folder / mark, ignored)) return true;
  return false;
}

void require_free(const std::string& target, bool force) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(target, ignored))) return;
  if (!force) fail(ErrorKind::file, target, ": exists already; give --force to replace it, or another name");
  if (!may_be_replaced(target))
    fail(ErrorKind::file, target, ": is not a folder of an earlier run (no manifest.json in it), so --force does not ",
         "replace it; remove it yourself, or give another name");
}

// `path` without a slash at its end, if a run may get this name.
std::string free_name(const std::string& path, bool force) {
  const std::string target = without_trailing_slash(path);
  if (target.empty() || target == "." || target == "/" || fs::path(target).filename() == "..")
    fail(ErrorKind::file, "\"", path, "\": is not a valid name for a new folder");
  const fs::path parent = fs::path(target).parent_path();
  std::error_code ignored;
  if (!parent.empty() && !fs::is_directory(parent, ignored))
    fail(ErrorKind::file, target, ": folder ", parent.string(), " does not exist; create it first");
  require_free(target, force);
  return target;
}

}  // namespace

RunDirectory::RunDirectory(const std::string& path, bool force) : path_(free_name(path, force)), force_(force) {
  std::error_code error;
  fs::remove_all(path_.temporary(), error);
  if (!fs::create_directory(path_.temporary(), error))
    fail(ErrorKind::file, path_.target(), ": cannot be created: ", error.message());
}

std::string RunDirectory::file(const std::string& name) const { return (fs::path(path_.temporary()) / name).string(); }

void RunDirectory::commit() {
  const std::string& target = path_.target();
  if (committed_) fail(ErrorKind::runtime, "RunDirectory::commit: ", target, " is committed already");
  require_free(target, force_);
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(target, ignored)))
    path_.commit_in_place_of_folder();
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
