// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>

#include "scene_io/test_files.hpp"

namespace insonify {

using nlohmann::json;

/// Returns bytes in base64.
inline std::string base64_of(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] & 0xffU : 0);
    for (std::size_t k = 0; k < 4; ++k) base64 += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return base64;
}

/// A document with one mesh of one primitive, whose numbers are added one accessor after another.
struct GltfMaker {
  json root = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", {{{"attributes", json::object()}}}}}}}};
  std::string bytes;

  json& primitive() { return root["meshes"][0]["primitives"][0]; }

  /// Adds numbers. Returns the index of their buffer view.
  template <typename Number>
  std::size_t add_view(const std::vector<Number>& numbers) {
    const std::size_t begin = bytes.size();
    for (const Number number : numbers) bytes += bytes_of(number);
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}});
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return root["bufferViews"].size() - 1;
  }
  /// Adds an accessor. Returns its index.
  template <typename Number>
  std::size_t add(const std::vector<Number>& numbers, const std::string& type = "VEC3") {
    const int code =
        std::is_floating_point_v<Number> ? 5126 : 5120 + 2 * (sizeof(Number) / 2) + std::is_unsigned_v<Number>;
    const std::size_t columns = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    root["accessors"].push_back({{"bufferView", add_view(numbers)},
                                 {"componentType", code},
                                 {"count", numbers.size() / columns},
                                 {"type", type}});
    return root["accessors"].size() - 1;
  }
  std::string text() {
    root["buffers"] = {
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64_of(bytes)}}};
    return root.dump();
  }
  LoadedScene load() { return load_scene(own_file("a.gltf", text())); }
};

/// Returns two triangles on a square of 1 m that looks up.
inline GltfMaker square_document() {
  GltfMaker maker;
  maker.primitive()["attributes"]["POSITION"] = maker.add(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0});
  maker.primitive()["indices"] = maker.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR");
  return maker;
}

}  // namespace insonify
