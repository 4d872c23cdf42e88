// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "core/text.hpp"
#include "files/input_file.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
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
  return beginning_of(path);
}

}  // namespace insonify
