// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <fstream>
#include <string>

// Private to formats: files that are read piece by piece.
namespace insonify {

/// A binary file that is read piece by piece.
class BinaryInput {
 public:
  /// Throws Error(file) if the file cannot be read.
  explicit BinaryInput(const std::string& path);

  /// Returns the size of the file [bytes].
  std::size_t size() const { return size_; }
  /// Returns `length` bytes from `offset` on. Throws Error(content) if the file ends within them; `what` names them.
  std::string part(std::size_t offset, std::size_t length, const std::string& what);

 private:
  std::string path_;
  std::ifstream file_;
  std::size_t size_ = 0;
};

}  // namespace insonify
