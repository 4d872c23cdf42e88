// SPDX-License-Identifier: BSD-3-Clause
#include "files/binary_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"

namespace insonify {
namespace {

[[noreturn]] void fail_here(const std::string& path, const char* what) {
  fail(ErrorKind::file, path, ": cannot ", what, ": ", std::strerror(errno),
       "; check the folder, its permissions and the space on the disk");
}

int open_nameless(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::string name = (folder / ".insonify-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  // Without a name nothing can be left behind, however the program ends.
  if (descriptor >= 0) ::unlink(name.c_str());
  return descriptor;
}

}  // namespace

BinaryFile::BinaryFile(const std::string& path, Mode mode) : path_(path) {
  if (mode == Mode::read) descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (mode == Mode::update) descriptor_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (mode == Mode::nameless) descriptor_ = open_nameless(path);
  if (descriptor_ < 0) fail_here(path, mode == Mode::read ? "be read" : "be written");
}

BinaryFile::~BinaryFile() { ::close(descriptor_); }

void BinaryFile::read(std::uint64_t offset, std::span<char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_here(path_, "be read");
    if (got == 0)
      fail(ErrorKind::content, path_, ": cut off: expected ", bytes.size(), " bytes at byte ", offset, ", found ", done,
           "; copy or make the file again");
    done += static_cast<std::size_t>(got);
  }
}

void BinaryFile::write(std::uint64_t offset, std::span<const char> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto put = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail_here(path_, "be written");
    done += static_cast<std::size_t>(put);
  }
}

void BinaryFile::copy(std::uint64_t offset, const BinaryFile& from, std::uint64_t there, std::uint64_t count) {
  std::vector<char> buffer(std::min<std::uint64_t>(count, 1 << 22));
  for (std::uint64_t done = 0; done < count; done += buffer.size()) {
    const auto some = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), count - done));
    from.read(there + done, some);
    write(offset + done, some);
  }
}

std::uint64_t BinaryFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail_here(path_, "be read");
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace insonify
