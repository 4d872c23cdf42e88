// SPDX-License-Identifier: BSD-3-Clause
#include "files/pending_file.hpp"

#include <cerrno>
#include <deque>
#include <filesystem>
#include <system_error>

#include "core/error.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

// `path`, if a file may be written there.
const std::string& writable_name(const std::string& path) {
  std::error_code ignored;
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty() && !fs::is_directory(parent, ignored))
    fail(ErrorKind::file, path, ": folder ", parent.string(), " does not exist; create it first");
  if (path.empty() || fs::is_directory(path, ignored))
    fail(ErrorKind::file, path.empty() ? "\"\"" : path, ": is not a valid name for an output file");
  return path;
}

}  // namespace

PendingFile::PendingFile(const std::string& path) : path_(writable_name(path)) {}

void PendingFile::commit() { path_.commit(); }

void PendingFile::close(std::ofstream& out) const {
  out.close();
  if (!out)
    fail(ErrorKind::file, path_.target(), ": cannot be written: ", std::generic_category().message(errno ? errno : EIO),
         "; is the disk full, and may you write to its folder?");
}

void PendingFile::commit(std::ofstream& out) {
  close(out);
  commit();
}

void PendingFile::fill(std::string_view bytes) const {
  errno = 0;
  std::ofstream out(temporary(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  close(out);
}

void write_file(const std::string& path, std::string_view bytes) {
  PendingFile pending(path);
  pending.fill(bytes);
  pending.commit();
}

void write_files(const std::vector<FileBytes>& files) {
  std::deque<PendingFile> pending;
  std::vector<PendingPath*> paths;
  for (const FileBytes& file : files) {
    pending.emplace_back(file.path).fill(file.bytes);
    paths.push_back(&pending.back().path_);
  }
  PendingPath::commit_together(paths);
}

}  // namespace insonify
