// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace insonify {

/// A file that is read and written at given offsets [bytes]. Several threads may do so at once. Errors name the path.
class BinaryFile {
 public:
  /// update: an existing file, to read and write; nameless: in the folder of `path`, gone when closed.
  enum class Mode { read, update, nameless };
  /// Throws Error(file) if it cannot be opened or made.
  BinaryFile(const std::string& path, Mode mode);
  ~BinaryFile();
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;

  /// Fills `bytes` from an offset on. Throws Error(file) if the system refuses, Error(content) if the file ends before.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  /// Writes `bytes` from an offset on. Throws Error(file) if the system refuses.
  void write(std::uint64_t offset, std::span<const char> bytes);
  /// Writes `count` bytes of another file, from `there` on, to `offset`. Throws as read and write.
  void copy(std::uint64_t offset, const BinaryFile& from, std::uint64_t there, std::uint64_t count);
  /// Returns the size of the file [bytes].
  std::uint64_t size() const;
  /// Returns the path with which it was opened.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

/// Returns the bytes of values.
template <typename T>
std::span<char> bytes_in(std::vector<T>& values) {
  return {reinterpret_cast<char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace insonify
