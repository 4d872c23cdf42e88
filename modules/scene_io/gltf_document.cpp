// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>

#include <vtkBase64Utilities.h>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "files/read_apart.hpp"
#include "scene_io/gltf_document_internal.hpp"
#include "scene_io/number_type_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

using nlohmann::json;

/// Reads the JSON of a document, and the chunk of a .glb.
GltfDocument read_document(const std::string& path) {
  std::string text = read_whole_file(path);
  GltfDocument document{path, {}, {}, {}, text.size()};
  if (extension_of(path) == ".glb") {
    const auto at = [&](std::size_t offset) -> std::uint64_t {
      if (offset + 4 > text.size()) document.refuse("ends within its head");
      return read_as<std::uint32_t>(text.data() + offset);
    };
    if (text.compare(0, 4, "glTF") != 0)
      fail(ErrorKind::content, path, ": not a binary glTF file: expected 'glTF', found ", what_it_looks_like(path));
    if (at(4) != 2) fail(ErrorKind::content, path, ": is glTF version ", at(4), ", expected 2; export it again");
    if (at(8) > text.size())
      document.refuse("its head announces " + std::to_string(at(8)) + " bytes, the file has " +
                      std::to_string(text.size()));
    const std::uint64_t length = at(12), behind = 20 + length;
    if (at(16) != 0x4e4f534a || behind > text.size()) document.refuse("its first chunk is not JSON");
    if (behind + 8 <= text.size()) document.chunk = text.substr(behind + 8, at(behind));
    text.resize(behind), text.erase(0, 20);
  }
  document.root = json::parse(text, nullptr, false);
  if (!document.root.is_object())
    fail(ErrorKind::content, path, ": not a glTF document: its JSON cannot be read, it looks like ",
         what_it_looks_like(path), "; the file is damaged or cut off: copy or export it again");
  const json asset = document.root.value("asset", json::object());
  const std::string version = asset.is_object() ? asset.value("version", "") : "";
  if (!version.starts_with("2."))
    fail(ErrorKind::content, path, ": is glTF version '", version, "', expected 2.0; export it again");
  return document;
}

/// Throws Error(content) if the document requires an extension of geometry that is not read. Extensions that add only a
/// name, a light or materials are allowed.
void check_extensions(const GltfDocument& document) {
  static const std::regex harmless(
      "EXT_mesh_gpu_instancing|KHR_mesh_quantization|KHR_(materials|lights|xmp|node).*|FB_ngon_encoding|MSFT_lod|"
      "EXT_(mesh|instance)_features|EXT_structural_metadata|CESIUM_primitive_outline");
  for (const json& required : document.list(document.root, "extensionsRequired")) {
    const auto name = required.get<std::string>();
    if (std::regex_match(name, harmless)) continue;
    const auto has = [&](const json& object) {
      return object.is_object() && object.contains("extensions") && object["extensions"].contains(name);
    };
    bool found = name == "CESIUM_RTC";  // true: the extension moves all points
    for (const char* of : {"buffers", "bufferViews", "accessors", "nodes", "meshes"})
      for (const json& object : document.list(document.root, of)) {
        const json& primitives = document.list(object, "primitives");
        found = found || has(object) || std::any_of(primitives.begin(), primitives.end(), has);
      }
    if (found)
      fail(ErrorKind::content, document.path, ": its meshes need the extension ", shown(name),
           ", which is not read; export it again without it",
           name.ends_with("compression") ? ", or unpack it: npx @gltf-transform/cli copy in.glb out.glb" : "");
  }
}

std::string percent_decoded(const std::string& text) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isxdigit(static_cast<unsigned char>(text[i]));
  };
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '%' && is_digit(i + 1) && is_digit(i + 2))
      decoded += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)), i += 2;
    else
      decoded += text[i];
  return decoded;
}

/// Returns the bytes of a buffer: the chunk, the bytes of a data address, or those of a file beside the document.
std::string buffer_of(const GltfDocument& document, const json& buffer) {
  if (!buffer.contains("uri")) return document.chunk;
  const auto address = buffer["uri"].get<std::string>();
  if (address.starts_with("data:")) {
    const std::size_t begin = address.find(";base64,");
    if (begin == std::string::npos) document.refuse("a buffer is not in base64");
    std::string code = percent_decoded(address.substr(begin + 8));
    code.resize((code.size() + 3) / 4 * 4, '=');
    std::string bytes(code.size(), '\0');
    auto* out = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(code.data()), code.size(), out,
                                                  bytes.size()));
    return bytes;
  }
  const std::filesystem::path folder = std::filesystem::path(document.path).parent_path();
  const std::string plain = folder / address, decoded = folder / percent_decoded(address);
  const std::string file = path_exists(plain) ? plain : decoded;
  require_readable(file);
  expect_from_file(document.path, document.bytes + file_size_of(file),
                   {static_cast<double>(file_size_of(file)), "bytes of a buffer", 16});
  return read_whole_file(file);
}

void read_buffers(GltfDocument& document) {
  for (const json& buffer : document.list(document.root, "buffers")) {
    const std::uint64_t announced = document.number(buffer, "byteLength");
    document.buffers.push_back(buffer_of(document, buffer));
    const std::size_t held = document.buffers.back().size();
    document.bytes += held;
    if (held < announced)
      document.refuse("buffer " + std::to_string(document.buffers.size() - 1) + " announces " +
                      std::to_string(announced) + " bytes and has " + std::to_string(held));
  }
}

/// Returns `rows` rows of `columns` numbers of a type in the buffer view that `position` names. `who` begins messages.
std::vector<double> numbers_at(const GltfDocument& document, const json& position, std::uint64_t code,
                               std::uint64_t rows, std::uint64_t columns, const std::string& who) {
  static const std::map<std::uint64_t, NumberType> types = {{5120, NumberType::int8},   {5121, NumberType::uint8},
                                                            {5122, NumberType::int16},  {5123, NumberType::uint16},
                                                            {5125, NumberType::uint32}, {5126, NumberType::float32}};
  const auto type = types.find(code);
  if (type == types.end()) document.refuse(who + " has no type");
  const std::uint64_t index = document.number(position, "bufferView");
  const json& view = document.entry("bufferViews", index);
  const std::uint64_t buffer = document.number(view, "buffer"), begin = document.number(view, "byteOffset", 0);
  const std::uint64_t length = document.number(view, "byteLength"), offset = document.number(position, "byteOffset", 0);
  document.entry("buffers", buffer);
  if (begin + length > document.buffers[buffer].size())
    document.refuse("buffer view " + std::to_string(index) + " ends beyond its buffer");
  const std::uint64_t bytes = size_of(type->second), stride = document.number(view, "byteStride", columns * bytes);
  if (stride < columns * bytes || (rows > 0 && offset + (rows - 1) * stride + columns * bytes > length))
    document.refuse(who + " ends beyond its buffer view");
  std::vector<double> numbers;
  const char* row = document.buffers[buffer].data() + begin + offset;
  for (std::uint64_t i = 0; i < rows; ++i, row += stride)
    for (std::uint64_t c = 0; c < columns; ++c) numbers.push_back(read_number(row + c * bytes, type->second));
  return numbers;
}

}  // namespace

void GltfDocument::refuse(const std::string& what) const {
  fail(ErrorKind::content, path, ": ", what, "; the file is damaged or cut off: copy or export it again");
}

std::uint64_t GltfDocument::number(const json& object, const char* key, std::optional<std::uint64_t> otherwise) const {
  const auto found = object.find(key);
  if (found == object.end() && otherwise) return *otherwise;
  if (found == object.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > 0xffffffff)
    refuse(std::string("'") + key + "' must be a whole number of 32 bits");
  return found->get<std::uint64_t>();
}

const json& GltfDocument::list(const json& object, const char* key) const {
  static const json none = json::array();
  const auto found = object.find(key);
  if (found != object.end() && !found->is_array()) refuse(std::string("'") + key + "' is no list");
  return found == object.end() ? none : *found;
}

const json& GltfDocument::entry(const char* of, std::uint64_t index) const {
  const json& all = list(root, of);
  if (index >= all.size() || !all[index].is_object())
    refuse(std::string("there is no entry ") + std::to_string(index) + " in '" + of + "'");
  return all[index];
}

std::vector<double> GltfDocument::numbers(std::uint64_t index, const std::string& shape) const {
  const std::string who = "accessor " + std::to_string(index);
  const json& accessor = entry("accessors", index);
  const std::uint64_t rows = number(accessor, "count"), code = number(accessor, "componentType");
  const std::uint64_t columns = shape == "SCALAR" ? 1 : static_cast<std::uint64_t>(shape.back() - '0');
  if (accessor.value("type", "") != shape)
    refuse(who + " is of type '" + shown(accessor.value("type", "")) + "', expected " + shape);
  if (!accessor.contains("bufferView") && !accessor.contains("sparse")) refuse(who + " has no numbers");
  expect_from_file(path, bytes, {static_cast<double>(rows * columns), "numbers", sizeof(double)});
  std::vector<double> values = accessor.contains("bufferView") ? numbers_at(*this, accessor, code, rows, columns, who)
                                                               : std::vector<double>(rows * columns, 0.0);
  if (accessor.contains("sparse")) {
    const json &sparse = accessor["sparse"], &positions = sparse.at("indices");
    const std::uint64_t count = number(sparse, "count");
    const std::vector<double> to = numbers_at(*this, positions, number(positions, "componentType"), count, 1, who);
    const std::vector<double> others = numbers_at(*this, sparse.at("values"), code, count, columns, who);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(to[i] >= 0 && to[i] < static_cast<double>(rows))) refuse(who + " replaces numbers beyond its end");
      std::copy_n(&others[i * columns], columns, &values[static_cast<std::size_t>(to[i]) * columns]);
    }
  }
  if (const double most = std::ldexp(1, code <= 5121 ? 8 : 16) / (code % 2 == 0 ? 2 : 1) - 1;
      code < 5125 && accessor.value("normalized", false))
    for (double& value : values) value = std::max(-1.0, value / most);
  return values;
}

GltfDocument load_gltf(const std::string& path) {
  GltfDocument document = read_document(path);
  check_extensions(document);
  read_buffers(document);
  return document;
}

}  // namespace insonify
