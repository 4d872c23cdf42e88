// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "files/pending_file.hpp"
#include "files/pending_path.hpp"

namespace insonify {

/// Key of a manifest.json: the SHA-256 of the files of a run, by their names relative to its folder.
inline constexpr const char* digests_key = "sha256";

/// Returns the digests in `folder`/manifest.json; empty if there is no manifest of insonify with digests. Throws
/// Error(content) for a manifest that is not a JSON object.
std::map<std::string, std::string> digests_of_run(const std::string& folder);

/// Returns the names in `folder` that do not belong to its run: files that its manifest.json does not list, links, and
/// listed files of up to 16 MiB with another SHA-256. Larger files count as unchanged. Without a manifest of insonify
/// all names are returned; none for an empty folder. Throws as digests_of_run.
std::vector<std::string> names_of_no_run(const std::string& folder);

/// Files and folders that a call reads. Names that do not exist are ignored; they may be names of presets.
using InputPaths = std::vector<std::string>;

/// Throws Error(file) unless the file `output` may be written. It may if it does not exist. With `force` it may also be
/// an existing file, except an input under any name, or a file of a run or survey among the inputs.
void require_free_file(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) unless the folder `output` may be made. It may if it does not exist. With `force` it may also be
/// an existing folder that is empty, or that holds only files that its manifest.json lists, unchanged. The folder must
/// neither be nor contain an input, under any name.
void require_free_folder(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) if `folder` holds anything that no run wrote, naming that. `called` is the name of the folder in
/// the message.
void require_run_alone(const std::string& folder, const std::string& called);

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
