#pragma once
#include <string>

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

  const std::string& temporary() const { return temporary_; }
  /// Throws Error(file) if the file cannot be renamed.
  void commit();

 private:
  std::string target_, temporary_;
};

}  // namespace insonify
