// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "scene_io/number_type_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"

namespace insonify {

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::float32;
  bool is_list = false;
  NumberType count_type = NumberType::uint8;  ///< type of the count of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_list() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
  }
};

struct PlyHeader {
  std::string path, encoding;  ///< ascii, binary_little_endian or binary_big_endian
  std::vector<PlyElement> elements;
  SceneTags tags;
  std::vector<std::string> comments;
  std::size_t end = 0;    ///< offset of the data [bytes]
  std::size_t lines = 0;  ///< number of header lines

  const PlyElement& vertex() const;
};

/// Reads the header, and checks the size of a binary file against it. Throws Error(content) if the file is not a PLY,
/// is truncated, or has no vertices or unknown types.
PlyHeader probe_ply(const std::string& path);

}  // namespace insonify
