// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "files/pending_file.hpp"
#include "files/pending_path.hpp"
#include "store/output_rules.hpp"

namespace insonify {

/// An output folder that is created atomically. Files are written into a temporary folder beside it, and commit()
/// renames that folder. Without commit() (an error, Ctrl-C) the temporary folder is removed. If the process was killed,
/// the next RunDirectory of the same name removes it.
class RunDirectory {
 public:
  /// Begins a run. `inputs` are the files and folders that it reads. Throws Error(file) as require_free_folder
  /// (output_rules.hpp), and if the parent of `path` is missing or not writable.
  RunDirectory(const std::string& path, bool force, const InputPaths& inputs = {});
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  /// Returns the path of a file while the run is being written.
  std::string file(const std::string& name) const;
  /// Waits until the disk holds all files, and renames the folder to its final name. With force it replaces an old
  /// folder in one step. Throws Error(file) if that fails, or as require_free_folder; files that appeared in the
  /// meantime are kept.
  void commit();

 private:
  PendingPath path_;
  bool force_ = false, committed_ = false;
};

/// Returns the contents of a text file. Throws Error(file) naming the path.
std::string read_text_file(const std::string& path);

}  // namespace insonify
