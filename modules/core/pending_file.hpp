#pragma once
#include <fstream>
#include <string>
#include <string_view>

namespace insonify {

/// Name of a temporary hidden file beside `path`, e.g. "runs/.out.tmp-4711".
std::string sibling_name(const std::string& path, const char* suffix);

/// A file written under a temporary name; commit() renames it, otherwise the destructor removes it.
class PendingFile {
 public:
  /// Throws Error(file) if the folder of `path` does not exist or `path` is a folder.
  explicit PendingFile(const std::string& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Returns the path to write to until commit().
  const std::string& temporary() const { return temporary_; }
  /// Throws Error(file) if the file cannot be renamed.
  void commit();
  /// Closes `out`, which wrote the temporary file, and renames that. Throws Error(file) if either fails, or if not all
  /// could be written.
  void commit(std::ofstream& out);

 private:
  std::string target_, temporary_;
};

/// Writes a file under a temporary name, then renames it: `path` is never incomplete. Throws Error(file).
void write_file(const std::string& path, std::string_view bytes);

}  // namespace insonify
