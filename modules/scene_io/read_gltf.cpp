// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>
#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/read_apart_internal.hpp"
#include "scene_io/text_lines_internal.hpp"
#include "scene_io/vtk_messages_internal.hpp"

// Reads glTF 2.0 (Khronos; ISO/IEC 12113) by VTK, which does not check that accessors lie within their buffers: the
// document is checked first. A glTF's y axis points up: (x, y, z) becomes (x, -z, y).
namespace insonify {
namespace {

using nlohmann::json;

/// A document, and how many bytes stand behind it in a .glb.
struct GltfDocument {
  const std::string& path;
  json root;
  std::uint64_t chunk_bytes = 0;

  [[noreturn]] void refuse(const std::string& what) const {
    fail(ErrorKind::content, path, ": ", what, "; the file is damaged or cut off: copy or export it again");
  }
  /// A number of an object; `otherwise` if it is absent.
  std::uint64_t number(const json& object, const char* key, std::optional<std::uint64_t> otherwise = {}) const {
    const auto found = object.find(key);
    if (found == object.end() && otherwise) return *otherwise;
    if (found == object.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > 0xffffffff)
      refuse(std::string("'") + key + "' must be a whole number of 32 bits");
    return found->get<std::uint64_t>();
  }
  /// The entry of a list of the root.
  const json& entry(const char* list, std::uint64_t index) const {
    const auto found = root.find(list);
    if (found == root.end() || !found->is_array() || index >= found->size() || !(*found)[index].is_object())
      refuse(std::string("there is no entry ") + std::to_string(index) + " in '" + list + "'");
    return (*found)[index];
  }
  std::size_t size_of_list(const char* list) const {
    const auto found = root.find(list);
    return found == root.end() ? 0 : found->size();
  }
};

GltfDocument document_of(const std::string& path) {
  std::string text = read_whole_file(path);
  GltfDocument document{path, {}, 0};
  if (extension_of(path) == ".glb") {
    const auto at = [&](std::size_t offset) -> std::uint64_t {
      if (offset + 4 > text.size()) document.refuse("ends within its head");
      return read_as<std::uint32_t>(text.data() + offset);
    };
    if (text.compare(0, 4, "glTF") != 0)
      fail(ErrorKind::content, path, ": not a binary glTF file: expected 'glTF', found ", what_it_looks_like(path));
    if (at(4) != 2) fail(ErrorKind::content, path, ": is glTF version ", at(4), ", expected 2; export it again");
    if (at(8) != text.size())
      document.refuse("its head announces " + std::to_string(at(8)) + " bytes, the file has " +
                      std::to_string(text.size()));
    const std::uint64_t length = at(12), behind = 20 + length;
    if (at(16) != 0x4e4f534a || behind > text.size()) document.refuse("its first chunk is not JSON");
    if (behind + 8 <= text.size()) document.chunk_bytes = std::min<std::uint64_t>(at(behind), text.size() - behind - 8);
    text = text.substr(20, length);
  }
  document.root = json::parse(text, nullptr, false);
  if (!document.root.is_object())
    fail(ErrorKind::content, path, ": not a glTF document: its JSON cannot be read, it looks like ",
         what_it_looks_like(path), "; the file is damaged or cut off: copy or export it again");
  return document;
}

/// Bytes that a buffer has, in the chunk, in its address, or in its file.
std::uint64_t buffer_bytes(const GltfDocument& document, const json& buffer) {
  const auto uri = buffer.find("uri");
  if (uri == buffer.end()) return document.chunk_bytes;
  if (!uri->is_string()) document.refuse("the 'uri' of a buffer must be text");
  const auto address = uri->get<std::string>();
  if (address.starts_with("data:")) {
    const std::size_t begin = address.find(";base64,");
    if (begin == std::string::npos) document.refuse("a buffer is not in base64");
    const std::size_t letters = address.find_last_not_of('=') + 1 - (begin + 8);
    return letters * 3 / 4;
  }
  const std::size_t slash = document.path.rfind('/');
  const std::string file = (slash == std::string::npos ? "" : document.path.substr(0, slash + 1)) + address;
  require_readable(file);
  return file_size_of(file);
}

void check_buffers(const GltfDocument& document) {
  for (std::size_t b = 0; b < document.size_of_list("buffers"); ++b) {
    const json& buffer = document.entry("buffers", b);
    const std::uint64_t announced = document.number(buffer, "byteLength"), held = buffer_bytes(document, buffer);
    if (held < announced)
      document.refuse("buffer " + std::to_string(b) + " announces " + std::to_string(announced) + " bytes and has " +
                      std::to_string(held));
  }
  for (std::size_t v = 0; v < document.size_of_list("bufferViews"); ++v) {
    const json& view = document.entry("bufferViews", v);
    const json& buffer = document.entry("buffers", document.number(view, "buffer"));
    if (document.number(view, "byteOffset", 0) + document.number(view, "byteLength") >
        document.number(buffer, "byteLength"))
      document.refuse("buffer view " + std::to_string(v) + " ends beyond its buffer");
  }
}

void check_accessor(const GltfDocument& document, std::uint64_t index) {
  const json& accessor = document.entry("accessors", index);
  const std::uint64_t type = document.number(accessor, "componentType");
  const std::uint64_t bytes = type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
  const std::string shape = accessor.value("type", "");
  const std::uint64_t parts = shape == "SCALAR" ? 1
                              : shape == "VEC2" ? 2
                              : shape == "VEC3" ? 3
                              : shape == "VEC4" ? 4
                                                : 0;
  const std::uint64_t count = document.number(accessor, "count");
  if (type < 5120 || type > 5126 || parts == 0) document.refuse("accessor " + std::to_string(index) + " has no type");
  if (accessor.contains("sparse") || !accessor.contains("bufferView"))
    fail(ErrorKind::content, document.path, ": accessor ", index,
         " is sparse, which is not read; export it as a whole");
  const json& view = document.entry("bufferViews", document.number(accessor, "bufferView"));
  const std::uint64_t stride = document.number(view, "byteStride", bytes * parts);
  if (count == 0 || stride < bytes * parts ||
      document.number(accessor, "byteOffset", 0) + (count - 1) * stride + bytes * parts >
          document.number(view, "byteLength"))
    document.refuse("accessor " + std::to_string(index) + " ends beyond its buffer view");
}

/// Nodes must form trees: VTK follows them without end otherwise.
void check_nodes(const GltfDocument& document) {
  std::vector<int> parents(document.size_of_list("nodes"), 0);
  const auto add_child = [&](const json& child) {
    if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= parents.size() ||
        ++parents[child.get<std::size_t>()] > 1)
      document.refuse("a node has no or several parents");
  };
  for (std::size_t n = 0; n < parents.size(); ++n) {
    const json& node = document.entry("nodes", n);
    if (node.contains("mesh")) document.entry("meshes", document.number(node, "mesh"));
    if (const auto children = node.find("children"); children != node.end())
      for (const json& child : *children) add_child(child);
  }
  for (std::size_t s = 0; s < document.size_of_list("scenes"); ++s)
    if (const json& scene = document.entry("scenes", s); s == document.number(document.root, "scene", 0))
      if (const auto nodes = scene.find("nodes"); nodes != scene.end())
        for (const json& node : *nodes) add_child(node);
}

void check_gltf(const GltfDocument& document) {
  const auto asset = document.root.find("asset");
  const std::string version = asset != document.root.end() && asset->is_object() ? asset->value("version", "") : "";
  if (!version.starts_with("2."))
    fail(ErrorKind::content, document.path, ": is glTF version '", version, "', expected 2.0; export it again");
  if (const auto required = document.root.find("extensionsRequired");
      required != document.root.end() && !required->empty())
    fail(ErrorKind::content, document.path, ": needs the extension ", shown(required->front().dump()),
         ", which is not read; export it without compression and quantisation");
  check_buffers(document);
  for (std::size_t m = 0; m < document.size_of_list("meshes"); ++m) {
    const json& mesh = document.entry("meshes", m);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) document.refuse("a mesh has no primitives");
    for (const json& primitive : *primitives) {
      const auto attributes = primitive.find("attributes");
      if (attributes == primitive.end() || !attributes->contains("POSITION"))
        document.refuse("a primitive has no positions");
      for (const auto& [name, index] : attributes->items())
        check_accessor(document, document.number(*attributes, name.c_str()));
      if (!primitive.contains("indices")) continue;
      const std::uint64_t indices = document.number(primitive, "indices");
      check_accessor(document, indices);
      if (document.entry("accessors", indices).value("type", "") != "SCALAR")
        document.refuse("accessor " + std::to_string(indices) + " holds no indices");
    }
  }
  check_nodes(document);
}

/// Size of a document and its buffers.
std::size_t bytes_with_buffers(const GltfDocument& document) {
  std::size_t bytes = file_size_of(document.path);
  for (std::size_t b = 0; b < document.size_of_list("buffers"); ++b)
    bytes += document.number(document.entry("buffers", b), "byteLength");
  return bytes;
}

/// Appends the faces of a part whose points follow the first `first` ones.
void add_faces(vtkPolyData* part, std::int64_t first, std::size_t points, RawCloud& raw) {
  vtkIdType corners = 0;
  const vtkIdType* ids = nullptr;
  std::vector<std::int64_t> polygon;
  vtkCellArray* polygons = part->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(corners, ids);) {
    polygon.clear();
    for (vtkIdType k = 0; k < corners; ++k) polygon.push_back(ids[k] < part->GetNumberOfPoints() ? first + ids[k] : -1);
    add_polygon(raw, polygon, points);
  }
}

std::vector<vtkPolyData*> parts_of(vtkMultiBlockDataSet* blocks) {
  std::vector<vtkPolyData*> parts;
  const auto each = vtk::TakeSmartPointer(blocks->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
    if (auto* part = vtkPolyData::SafeDownCast(each->GetCurrentDataObject())) parts.push_back(part);
  return parts;
}

/// Reads a document that was checked.
SentRows read_parts(ArraySender& to, RawCloud& raw) {
  vtkNew<VtkReadMessages> messages;
  const QuietVtk quiet(messages);
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(raw.path.c_str());
  reader->Update();
  if (!messages->errors.empty())
    fail(ErrorKind::content, raw.path, ": VTK cannot read it: ", messages->errors.front(), "; export it again");
  const std::vector<vtkPolyData*> parts = parts_of(reader->GetOutput());
  std::size_t points = 0, first = 0;
  for (vtkPolyData* part : parts) points += static_cast<std::size_t>(part->GetNumberOfPoints());
  if (points == 0) fail(ErrorKind::content, raw.path, ": holds no point; export the glTF again");
  raw.width = points;
  const SentRows rows = rows_of_doubles({"x", "y", "z"}, points);
  auto* place = reinterpret_cast<double*>(to.take_array<char>(rows.rows * rows.stride));
  for (vtkPolyData* part : parts) {
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i) {
      double p[3];
      part->GetPoint(i, p);
      *place++ = p[0], *place++ = -p[2], *place++ = p[1];
    }
    add_faces(part, static_cast<std::int64_t>(first), points, raw);
    first += static_cast<std::size_t>(part->GetNumberOfPoints());
  }
  return rows;
}

}  // namespace

RawCloud read_gltf(const std::string& path, const ReadOptions& options) {
  RawCloud raw;
  raw.path = path;
  raw.format = "glTF mesh";
  raw.fields = {{"x", "float"}, {"y", "float"}, {"z", "float"}};
  raw.float_coordinates = true;
  read_rows_apart(raw, file_size_of(path), options, [&](ArraySender& to, RawCloud& read) {
    const GltfDocument document = document_of(path);
    try {
      check_gltf(document);
    } catch (const json::exception& wrong) {
      document.refuse(std::string("its document has a value of another type (") + wrong.what() + ")");
    }
    const std::size_t bytes = bytes_with_buffers(document);
    expect_from_file(path, bytes, {static_cast<double>(bytes), "bytes with its buffers", 16});
    return read_parts(to, read);
  });
  return raw;
}

}  // namespace insonify
