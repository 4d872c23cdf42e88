// SPDX-License-Identifier: BSD-3-Clause
#include "files/input_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/path_status.hpp"

namespace insonify {

void require_regular_file(const std::string& path) {
  const auto status = look_at_paths([&] { return std::filesystem::status(path); });
  if (!std::filesystem::exists(status)) fail(ErrorKind::file, path, ": no such file; check the path");
  if (std::filesystem::is_directory(status)) fail(ErrorKind::file, path, ": is a folder, must be a file");
  if (!std::filesystem::is_regular_file(status))
    fail(ErrorKind::file, path, ": is a pipe or a device, must be a regular file; write its data to a file first");
}

void require_readable(const std::string& path) {
  require_regular_file(path);
  if (!std::ifstream(path, std::ios::binary))
    fail(ErrorKind::file, path, ": cannot be opened for reading; check its permissions");
  if (file_size_of(path) == 0) fail(ErrorKind::content, path, ": the file is empty (0 bytes); write or copy it again");
}

std::size_t file_size_of(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : static_cast<std::size_t>(size);
}

std::string read_whole_file(const std::string& path) { return read_beginning(path, file_size_of(path)); }

std::string read_beginning(const std::string& path, std::size_t count) {
  std::string bytes(std::min(count, file_size_of(path)), '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    fail(ErrorKind::file, path, ": reading failed after ", file.gcount(), " of ", bytes.size(),
         " bytes; check the disk and the permissions");
  return bytes;
}

std::string beginning_of(const std::string& path) {
  const std::string head = read_beginning(path, 512);
  const bool text = std::all_of(head.begin(), head.end(),
                                [](unsigned char c) { return c >= 128 || std::isprint(c) || std::isspace(c); });
  if (!text) return "binary data";
  std::string_view line;
  LineReader(head).next_filled(line);
  return "text beginning with '" + shown(line) + "'";
}

}  // namespace insonify
