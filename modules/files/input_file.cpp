// SPDX-License-Identifier: BSD-3-Clause
#include "files/input_file.hpp"

#include <filesystem>
#include <system_error>

#include "core/error.hpp"

namespace insonify {

void require_regular_file(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) fail(ErrorKind::file, path, ": no such file; check the path");
  if (std::filesystem::is_directory(status)) fail(ErrorKind::file, path, ": is a folder, must be a file");
  if (!std::filesystem::is_regular_file(status))
    fail(ErrorKind::file, path, ": is a pipe or a device, must be a regular file; write its data to a file first");
}

}  // namespace insonify
