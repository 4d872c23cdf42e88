#include "core/pending_file.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "core/error.hpp"

namespace insonify {

namespace fs = std::filesystem;

std::string sibling_name(const std::string& path, const char* suffix) {
  const fs::path target(path);
  std::string name = ".";
  name.append(target.filename().string()).append(".").append(suffix).append("-").append(std::to_string(::getpid()));
  return (target.parent_path() / name).string();
}

PendingFile::PendingFile(const std::string& path) : target_(path), temporary_(sibling_name(path, "tmp")) {
  std::error_code ignored;
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty() && !fs::is_directory(parent, ignored))
    fail(ErrorKind::file, path, ": folder ", parent.string(), " does not exist; create it first");
  if (path.empty() || fs::is_directory(path, ignored))
    fail(ErrorKind::file, path.empty() ? "\"\"" : path, ": is not a valid name for an output file");
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void PendingFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(ErrorKind::file, target_, ": cannot be written: ", error.message());
}

void PendingFile::commit(std::ofstream& out) {
  out.close();
  if (!out)
    fail(ErrorKind::file, target_, ": cannot be written: ", std::generic_category().message(errno ? errno : EIO),
         "; is the disk full, and may you write to its folder?");
  commit();
}

void write_file(const std::string& path, std::string_view bytes) {
  PendingFile pending(path);
  errno = 0;
  std::ofstream out(pending.temporary(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  pending.commit(out);
}

}  // namespace insonify
