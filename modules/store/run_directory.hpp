// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "files/pending_file.hpp"
#include "files/pending_path.hpp"
#include "store/output_rules.hpp"

namespace insonify {

/// An output folder created atomically: files are written into a temporary folder beside it, which commit() renames.
/// If commit() is never called (an error, Ctrl-C), the temporary folder is removed; if the process was killed, by the
/// next RunDirectory of the same name.
class RunDirectory {
 public:
  /// `inputs`: what the run is made of. Throws Error(file) as require_free_folder (output_rules.hpp), and if the parent of
  /// `path` is missing or not writable.
  RunDirectory(const std::string& path, bool force, const InputPaths& inputs = {});
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  /// Path of a file while the run is being written.
  std::string file(const std::string& name) const;
  /// Waits until the disk holds all files, and renames the folder to its final name; with force it takes the place of
  /// an old one in one step. Throws Error(file) if that fails, or as require_free_folder: what has come since then is
  /// kept, too.
  void commit();

 private:
  PendingPath path_;
  bool force_ = false, committed_ = false;
};

/// The contents of a text file. Throws Error(file) naming the path.
std::string read_text_file(const std::string& path);

}  // namespace insonify
