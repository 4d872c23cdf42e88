// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace insonify {

/// A hidden temporary name beside an output, e.g. "runs/.out.tmp-4711@host", under which the output is written until it
/// is complete. The name says which process writes it, so a later process can tell a dead writer from a living one.
class PendingPath {
 public:
  /// Chooses the name. Removes the remains of earlier attempts at `target` by processes of this host that have ended.
  /// If one of them ended while it replaced `target`, the old output gets its name back. Throws Error(file) if the file
  /// system does not accept names as long as `target`.
  explicit PendingPath(const std::string& target);
  /// Removes the file or folder with the temporary name.
  ~PendingPath();
  PendingPath(const PendingPath&) = delete;
  PendingPath& operator=(const PendingPath&) = delete;

  /// Returns the path of the finished output.
  const std::string& target() const { return target_; }
  /// Returns the path to write to until it is renamed.
  const std::string& temporary() const { return temporary_; }

  /// Writes the file or folder from memory to the disk (fsync), then gives it the target's name. An old file of that
  /// name is replaced in one step; a folder needs a free name. Throws Error(file) with the reason of the system.
  void commit();
  /// Commits files that are one output: if one of them cannot get its name, none of them has it, and old files of their
  /// names are as they were. Throws as commit().
  static void commit_together(const std::vector<PendingPath*>& files);
  /// Commits a folder that replaces an old one, which is removed. Both exchange their names in one step if the file
  /// system can do that. `require_removable` receives the old folder when nobody finds it under its name any more; if
  /// it throws, the old folder gets its name back.
  void commit_in_place_of_folder(const std::function<void(const std::string& old)>& require_removable);

 private:
  std::string target_, temporary_;
};

/// Returns the temporary name that this process gives `target`; `count` numbers the names of one process. `kind`: "tmp"
/// for an output that is being written, "old" for one that is being replaced.
std::string sibling_name(const std::string& target, const char* kind = "tmp", int count = 0);

/// Removes the outputs that all PendingPaths of this process have written so far, and prevents further commits. For a
/// process that ends by a signal while its threads are still working.
void discard_pending_paths();

}  // namespace insonify
