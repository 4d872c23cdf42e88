// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "files/pending_path.hpp"

namespace insonify {

/// A file to write.
struct FileBytes {
  std::string path, bytes;
};

/// A file written under a temporary name; commit() renames it, otherwise the destructor removes it.
class PendingFile {
 public:
  /// Throws Error(file) if the folder of `path` does not exist or `path` is a folder.
  explicit PendingFile(const std::string& path);

  /// Returns the path to write to until commit().
  const std::string& temporary() const { return path_.temporary(); }
  /// Writes all of the temporary file. Throws Error(file) if that fails.
  void fill(std::string_view bytes) const;
  /// Writes the file from memory to the disk and renames it. Throws Error(file) if that fails.
  void commit();
  /// Closes `out`, which wrote the temporary file, and renames that. Throws Error(file) if either fails, or if not all
  /// could be written.
  void commit(std::ofstream& out);

 private:
  friend void write_files(const std::vector<FileBytes>& files);
  void close(std::ofstream& out) const;
  PendingPath path_;
};

/// Writes a file under a temporary name, then renames it: `path` is never incomplete. Throws Error(file).
void write_file(const std::string& path, std::string_view bytes);

/// Writes files that are one output, as write_file: all of them are there afterwards, or none. Throws Error(file).
void write_files(const std::vector<FileBytes>& files);

}  // namespace insonify
