// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "files/input_file.hpp"
#include "formats/binary_input_internal.hpp"

namespace insonify {

BinaryInput::BinaryInput(const std::string& path) : path_(path) {
  require_regular_file(path);
  file_.open(path, std::ios::binary | std::ios::ate);
  if (!file_) fail(ErrorKind::file, path, ": cannot be read");
  size_ = static_cast<std::size_t>(file_.tellg());
}

std::string BinaryInput::part(std::size_t offset, std::size_t length, const std::string& what) {
  if (offset > size_ || length > size_ - offset)
    fail(ErrorKind::content, path_, ": ends within ", what, ": has ", size_, " bytes, must have ", offset + length,
         "; the file is truncated, copy it again");
  std::string bytes(length, '\0');
  file_.seekg(static_cast<std::streamoff>(offset));
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(length)))
    fail(ErrorKind::file, path_, ": cannot be read at byte ", offset);
  return bytes;
}

}  // namespace insonify
