// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"
#include "scene_io/text_lines_internal.hpp"

namespace insonify {

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
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

std::string vtk_tag(const std::string& head) {
  const std::size_t tag = head.find("<VTKFile");
  if (tag == head.npos) return {};
  return head.substr(tag, head.find('>', tag) - tag).find("PolyData") == head.npos ? "<VTKFile" : "<VTKFile PolyData";
}

std::string what_it_looks_like(const std::string& path) {
  std::string head = read_beginning(path, 512);
  if (const std::string tag = vtk_tag(head); !tag.empty()) head = tag;
  for (const SceneReader& reader : scene_readers())
    for (const std::string& magic : reader.magic)
      if (head.starts_with(magic)) {
        const auto& names = reader.extensions;
        if (std::find(names.begin(), names.end(), extension_of(path)) != names.end())
          return reader.name + ", as it should; copy or export it again";
        return reader.name + "; " + (reader.remedy.empty() ? "rename it to " + names[0] : reader.remedy);
      }
  const bool text = std::all_of(head.begin(), head.end(),
                                [](unsigned char c) { return c >= 128 || std::isprint(c) || std::isspace(c); });
  if (!text) return "binary data";
  std::string_view line;
  LineReader(head).next_filled(line);
  return "text beginning with '" + shown(line) + "'";
}

}  // namespace insonify
