// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

// Private to scene_io: glTF 2.0 (Khronos; ISO/IEC 12113) as JSON and numbers. VTK's reader reads strips as points, has
// neither sparse numbers nor instances, and does not check that numbers lie within their buffers.
namespace insonify {

/// A document and its buffers. The functions throw Error(content) if it lacks a requested entry, and
/// nlohmann::json::exception if a value has another type.
struct GltfDocument {
  std::string path;
  nlohmann::json root;
  std::string chunk;  ///< bytes of the chunk of a .glb
  std::vector<std::string> buffers;
  std::size_t bytes = 0;  ///< size of the file and its buffers

  /// Throws Error(content) that says `what`, and that the file is damaged.
  [[noreturn]] void refuse(const std::string& what) const;
  /// Returns a whole number of an object; `otherwise` if it is absent.
  std::uint64_t number(const nlohmann::json& object, const char* key,
                       std::optional<std::uint64_t> otherwise = {}) const;
  /// Returns a list of an object; an empty list if it is absent.
  const nlohmann::json& list(const nlohmann::json& object, const char* key) const;
  /// Returns an entry of a list of the root.
  const nlohmann::json& entry(const char* of, std::uint64_t index) const;
  /// Returns the numbers of an accessor, row by row; `shape` is SCALAR, VEC3 or VEC4. Normalised integers become
  /// numbers of at most 1.
  std::vector<double> numbers(std::uint64_t index, const std::string& shape) const;
};

/// Reads a .gltf or .glb with its buffers. Throws as GltfDocument, and if meshes need an extension that is not read.
GltfDocument load_gltf(const std::string& path);

}  // namespace insonify
