// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "files/binary_file.hpp"
#include "files/input_file.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// Returns the bytes of rows that are not packed, in this machine's byte order.
std::vector<char> bytes_of_rows(const RowFile& file, std::size_t first, std::size_t count) {
  std::vector<char> bytes(count * file.stride);
  BinaryFile(file.path, BinaryFile::Mode::read).read(file.begin + first * file.stride, bytes);
  if (!file.big_endian) return bytes;
  for (std::size_t i = 0; i < count; ++i)
    for (const RowTable::Column& column : file.columns) {
      char* number = bytes.data() + i * file.stride + column.offset;
      std::reverse(number, number + size_of(column.type));
    }
  return bytes;
}

}  // namespace

std::optional<RowFile> find_ply_rows(const std::string& path) {
  // The reader of text files checks them line by line.
  if (read_beginning(path, 64).find("format ascii") != std::string::npos) return std::nullopt;
  const PlyHeader header = probe_ply(path);
  if (header.encoding == "ascii") return std::nullopt;
  RowFile file{path, "PLY " + header.encoding, {}, header.vertex().count, 0, header.end, false, header.tags, {}};
  file.big_endian = header.encoding == "binary_big_endian";
  file.comments = header.comments;
  const bool points = header.tags.prepared && header.tags.heights;  // with the surface between them
  for (const PlyElement& element : header.elements)
    if (element.has_list() && element.count > 0 && !points) return std::nullopt;  // a mesh
  for (const PlyElement& element : header.elements) {
    if (element.has_list() && element.count > 0) return std::nullopt;
    std::size_t stride = 0;
    for (const PlyProperty& property : element.properties) {
      if (element.name == "vertex") file.columns.push_back({property.name, property.type, stride});
      stride += size_of(property.type);
    }
    if (element.name == "vertex") {
      file.stride = stride;
      return file;
    }
    file.begin += element.count * stride;
  }
  return std::nullopt;
}

RowFile rows_of_ply(const std::string& path, const char* otherwise) {
  require_readable(path);
  std::optional<RowFile> file = find_ply_rows(path);
  if (!file || file->big_endian) fail(ErrorKind::content, path, ": ", otherwise);
  return std::move(*file);
}

RawCloud raw_of(const RowFile& file) {
  RawCloud raw;
  raw.path = file.path, raw.format = file.format;
  raw.tags = file.tags, raw.meaning = file.meaning, raw.notes = file.notes;
  if (!raw.tags.system.empty()) raw.meaning.system = {raw.tags.system, MeaningOrigin::file};
  raw.viewpoint = file.viewpoint;
  raw.width = raw.points_in_file = file.rows;
  for (const RowTable::Column& column : file.columns) raw.fields.push_back({column.name, name_of(column.type)});
  return raw;
}

RowTable read_rows(const RowFile& file, std::size_t first, std::size_t count) {
#ifdef INSONIFY_LASZIP
  if (file.packed) return unpack_rows(file, first, count);
#endif
  const auto bytes = std::make_shared<std::vector<char>>(bytes_of_rows(file, first, count));
  return {file.columns, count, file.stride, bytes->data(), bytes, file.marks};
}

RowTable all_rows(const RowFile& file) {
  if (file.packed) return read_rows(file, 0, file.rows);
  const auto read = [file](std::size_t first, std::size_t count) { return bytes_of_rows(file, first, count); };
  return {file.columns, file.rows, file.stride, nullptr, nullptr, file.marks, read};
}

}  // namespace insonify
