// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

namespace insonify {

/// A hidden temporary name beside an output, e.g. "runs/.out.tmp-4711@host", under which the output is written until it
/// is complete. The name says which process writes it, so a later process can tell a dead writer from a living one.
class PendingPath {
 public:
  /// Chooses the name, and removes what processes of this host that have ended left of earlier attempts at `target`. If
  /// one of them ended while it replaced `target`, the old output gets its name back. Throws Error(file) if the file
  /// system does not take names as long as `target`.
  explicit PendingPath(const std::string& target);
  /// Removes what stands under the temporary name.
  ~PendingPath();
  PendingPath(const PendingPath&) = delete;
  PendingPath& operator=(const PendingPath&) = delete;

  /// Returns the path that was asked for.
  const std::string& target() const { return target_; }
  /// Returns the path to write to until it is renamed.
  const std::string& temporary() const { return temporary_; }

  /// Writes the file or folder from memory to the disk (fsync), then gives it the target's name, whose old file is
  /// replaced in one step; a folder needs a free name. Throws Error(file) with the reason of the system.
  void commit();
  /// commit() for a folder that takes the place of an old one, which is removed. Both exchange their names in one step
  /// where the file system can do that. `require_removable` gets the old folder once nobody finds it under its name; if
  /// it throws, the old folder gets its name back.
  void commit_in_place_of_folder(const std::function<void(const std::string& old)>& require_removable);

 private:
  std::string target_, temporary_;
};

/// The temporary name that this process gives `target`; `count` numbers those of one process. `kind`: "tmp" for an
/// output that is being written, "old" for one that is being replaced.
std::string sibling_name(const std::string& target, const char* kind = "tmp", int count = 0);

/// Removes what all PendingPaths of this process have written so far, and lets none be committed any more: for a
/// process that ends by a signal while its threads are still working.
void discard_pending_paths();

}  // namespace insonify
