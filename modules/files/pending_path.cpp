// SPDX-License-Identifier: BSD-3-Clause
#include "files/pending_path.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.hpp"
#include "files/final_names.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

// Temporary names of this process. The guard is held while an output gets its name.
struct PendingNames {
  std::mutex guard;
  std::set<std::string> names;
};

PendingNames& pending_names() {
  static PendingNames names;
  return names;
}

std::string host_name() {
  char name[65] = {};
  if (gethostname(name, sizeof name - 1) != 0) return "localhost";
  return std::string(name).substr(0, 60);
}

// ".out." of "runs/out", short enough that a suffix fits into a file name of 255 bytes.
std::string hidden_prefix(const fs::path& target) { return "." + target.filename().string().substr(0, 140) + "."; }

fs::path beside(const fs::path& target, const std::string& name) { return target.parent_path() / name; }

// Process that wrote `name` = <prefix><kind>-<process>[.<count>]@<host>; 0 if the name is not of this form and host.
pid_t writer_of(const std::string& name, const std::string& prefix, const std::string& kind) {
  const std::string start = prefix + kind + "-", end = "@" + host_name();
  if (!name.starts_with(start) || !name.ends_with(end)) return 0;
  return static_cast<pid_t>(std::strtol(name.c_str() + start.size(), nullptr, 10));
}

bool has_ended(pid_t process) { return process > 0 && kill(process, 0) != 0 && errno == ESRCH; }

// Removes or restores what writers that have ended left beside `target`.
void clear_leftovers(const fs::path& target) {
  const std::string prefix = hidden_prefix(target);
  std::error_code ignored;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    if (has_ended(writer_of(name, prefix, "tmp"))) fs::remove_all(entry.path(), ignored);
    if (!has_ended(writer_of(name, prefix, "old"))) continue;
    if (fs::exists(fs::symlink_status(target, ignored)))
      fs::remove_all(entry.path(), ignored);
    else
      fs::rename(entry.path(), target, ignored);
  }
}

[[noreturn]] void fail_to_write(const std::string& target, int reason) {
  const bool full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  fail(ErrorKind::file, target, ": cannot be written: ", std::generic_category().message(reason),
       full ? "; make space on the disk, and run again" : "");
}

// Waits until a file or folder is on the disk; returns 0, or why it is not. What cannot be synchronised, a pipe for
// instance, is left alone.
int failed_sync(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return errno;
  int reason = 0;
  while ((reason = fsync(file) == 0 ? 0 : errno) == EINTR) {
  }
  close(file);
  return reason == EIO || reason == ENOSPC || reason == EDQUOT ? reason : 0;
}

void synchronise(const std::string& path, const std::string& target) {
  if (const int reason = failed_sync(path)) fail_to_write(target, reason);
}

void synchronise_all(const std::string& path, const std::string& target) {
  std::error_code ignored;
  if (fs::is_directory(fs::symlink_status(path, ignored)))
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, ignored))
      if (entry.is_regular_file(ignored) || entry.is_directory(ignored)) synchronise(entry.path().string(), target);
  if (!fs::is_symlink(path, ignored)) synchronise(path, target);
}

// Returns true if an output lies in a folder that is not complete either, with which it is synchronised.
bool lies_in_pending_folder(const std::string& target) {
  const std::scoped_lock lock(pending_names().guard);
  const auto& names = pending_names().names;
  fs::path folder = fs::path(target).parent_path();
  while (!folder.empty() && !names.contains(folder.string()) && folder != folder.root_path())
    folder = folder.parent_path();
  return names.contains(folder.string());
}

// The output has its name by then.
void synchronise_folder_of(const std::string& target) {
  const fs::path folder = fs::path(target).parent_path();
  if (const int reason = failed_sync(folder.empty() ? "." : folder.string()))
    fail(ErrorKind::file, target,
         ": is complete, but may be lost with the power: ", std::generic_category().message(reason),
         "; check the disk");
}

// Exchanges the names of two folders.
void exchange_paths(const std::string& temporary, const std::string& target) {
  if (renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) fail_to_write(target, errno);
  // A file system without exchange: clear_leftovers() of the next run undoes the first step if only that was done.
  const std::string old = sibling_name(target, "old", 0);
  if (std::rename(target.c_str(), old.c_str()) != 0) fail_to_write(target, errno);
  if (std::rename(temporary.c_str(), target.c_str()) != 0) {
    const int reason = errno;
    std::rename(old.c_str(), target.c_str());
    fail_to_write(target, reason);
  }
  std::rename(old.c_str(), temporary.c_str());
}

}  // namespace

PendingPath::PendingPath(const std::string& target) : target_(target) {
  std::error_code error;
  static_cast<void>(fs::symlink_status(target, error));
  if (error.value() == ENAMETOOLONG) fail_to_write(target, ENAMETOOLONG);
  clear_leftovers(target);
  PendingNames& pending = pending_names();
  const std::scoped_lock lock(pending.guard);
  // Two threads that write the same output have names of their own.
  for (int count = 0; temporary_.empty() || !pending.names.insert(temporary_).second; ++count)
    temporary_ = sibling_name(target, "tmp", count);
}

PendingPath::~PendingPath() {
  PendingNames& pending = pending_names();
  const std::scoped_lock lock(pending.guard);
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  pending.names.erase(temporary_);
}

void PendingPath::commit() {
  // Synchronises a large output at once, so that it is on the disk while the rest of its folder is made.
  constexpr std::uintmax_t large = 16 << 20;
  const bool later = lies_in_pending_folder(target_);
  std::error_code no_size;
  const std::uintmax_t size = fs::file_size(temporary_, no_size);
  if (!later || (!no_size && size >= large)) synchronise_all(temporary_, target_);
  {
    const std::scoped_lock lock(pending_names().guard);
    std::error_code ignored;
    const unsigned flags = fs::is_directory(temporary_, ignored) ? RENAME_NOREPLACE : 0;
    int failed = renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags);
    if (failed && flags && (errno == EINVAL || errno == ENOSYS))
      failed = std::rename(temporary_.c_str(), target_.c_str());
    if (failed) fail_to_write(target_, errno);
  }
  if (!later) synchronise_folder_of(target_);
}

void PendingPath::commit_together(const std::vector<PendingPath*>& files) {
  for (const PendingPath* file : files) synchronise_all(file->temporary_, file->target_);
  {
    const std::scoped_lock lock(pending_names().guard);
    std::vector<std::function<void()>> undo;
    try {
      for (const PendingPath* file : files) {
        const std::string &from = file->temporary_, &to = file->target_;
        if (fs::exists(fs::symlink_status(to))) {
          exchange_paths(from, to);
          undo.emplace_back([&] { exchange_paths(from, to); });
        } else {
          if (std::rename(from.c_str(), to.c_str()) != 0) fail_to_write(to, errno);
          undo.emplace_back([&] { std::rename(to.c_str(), from.c_str()); });
        }
      }
    } catch (...) {
      for (auto step = undo.rbegin(); step != undo.rend(); ++step) (*step)();
      throw;
    }
  }
  for (const PendingPath* file : files) synchronise_folder_of(file->target_);
}

void PendingPath::commit_in_place_of_folder(const std::function<void(const std::string& old)>& require_removable) {
  synchronise_all(temporary_, target_);
  {
    const std::scoped_lock lock(pending_names().guard);
    exchange_paths(temporary_, target_);
    try {
      require_removable(temporary_);
    } catch (...) {
      exchange_paths(temporary_, target_);
      throw;
    }
  }
  synchronise_folder_of(target_);
}

std::string sibling_name(const std::string& target, const char* kind, int count) {
  std::string name = hidden_prefix(target).append(kind).append("-").append(std::to_string(getpid()));
  if (count > 0) name.append(".").append(std::to_string(count));
  return beside(target, name.append("@").append(host_name())).string();
}

std::string with_final_names(std::string message) {
  const std::string mark = ".tmp-", end = "@" + host_name();
  for (std::size_t at = message.find(mark); at != message.npos; at = message.find(mark, at)) {
    const std::size_t number_ends = message.find_first_not_of(".0123456789", at + mark.size());
    std::size_t begins = message.rfind('/', at) + 1;  // npos + 1 is the beginning
    if (message[begins] != '.') begins = message.rfind(' ', at) + 1;
    if (number_ends == message.npos || message.compare(number_ends, end.size(), end) != 0 || message[begins] != '.') {
      at += mark.size();
      continue;
    }
    message.erase(at, number_ends + end.size() - at);
    message.erase(begins, 1);
  }
  return message;
}

void discard_pending_paths() {
  PendingNames& pending = pending_names();
  pending.guard.lock();  // for ever
  // A thread may still write a file into a folder that is being removed.
  constexpr int attempts = 50;
  for (const std::string& name : pending.names) {
    std::error_code ignored;
    for (int attempt = 0; attempt < attempts && fs::exists(fs::symlink_status(name, ignored)); ++attempt)
      fs::remove_all(name, ignored);
  }
}

}  // namespace insonify
