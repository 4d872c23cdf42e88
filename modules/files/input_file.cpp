// SPDX-License-Identifier: BSD-3-Clause
#include "files/input_file.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "files/path_status.hpp"

namespace insonify {

void require_regular_file(const std::string& path) {
  const auto status = look_at_paths([&] { return std::filesystem::status(path); });
  if (!std::filesystem::exists(status)) fail(ErrorKind::file, path, ": no such file; check the path");
  if (std::filesystem::is_directory(status)) fail(ErrorKind::file, path, ": is a folder, must be a file");
  if (!std::filesystem::is_regular_file(status))
    fail(ErrorKind::file, path, ": is a pipe or a device, must be a regular file; write its data to a file first");
}

}  // namespace insonify
