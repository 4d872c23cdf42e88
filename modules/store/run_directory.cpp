#include "store/run_directory.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/error.hpp"

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

}  // namespace

RunDirectory::RunDirectory(const std::string& path, bool force) : target_(without_trailing_slash(path)), force_(force) {
  if (target_.empty() || target_ == "." || target_ == "/" || fs::path(target_).filename() == "..")
    fail(ErrorKind::file, "\"", path, "\": is not a valid name for a new folder");
  require_free(target_, force);
  const fs::path parent = fs::path(target_).parent_path();
  std::error_code error;
  if (!parent.empty() && !fs::is_directory(parent, error))
    fail(ErrorKind::file, target_, ": folder ", parent.string(), " does not exist; create it first");
  temporary_ = sibling_name(target_, "tmp");
  fs::remove_all(temporary_, error);
  if (!fs::create_directory(temporary_, error))
    fail(ErrorKind::file, target_, ": cannot be created: ", error.message());
}

RunDirectory::~RunDirectory() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_, ignored);
}

std::string RunDirectory::file(const std::string& name) const { return (fs::path(temporary_) / name).string(); }

void RunDirectory::commit() {
  if (committed_) fail(ErrorKind::runtime, "RunDirectory::commit: ", target_, " is committed already");
  require_free(target_, force_);
  std::error_code error, ignored;
  const std::string old = sibling_name(target_, "old");
  const bool replace = fs::exists(target_, ignored);
  if (replace) {
    fs::rename(target_, old, error);
    if (error) fail(ErrorKind::file, target_, ": cannot be replaced: ", error.message());
  }
  fs::rename(temporary_, target_, error);
  if (error) {
    if (replace) fs::rename(old, target_, ignored);
    fail(ErrorKind::file, target_, ": cannot be created: ", error.message());
  }
  committed_ = true;
  if (replace) fs::remove_all(old, ignored);
}

std::string read_text_file(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) fail(ErrorKind::file, path, ": no such file");
  if (fs::is_directory(path, ignored)) fail(ErrorKind::file, path, ": is a folder, must be a file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (in.bad() || !in.is_open())
    fail(ErrorKind::file, path, ": cannot be read: ", std::generic_category().message(errno));
  return std::move(text).str();
}

}  // namespace insonify
