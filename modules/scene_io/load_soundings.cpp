#include "scene_io/load_soundings.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/ply_header_internal.hpp"

namespace insonify {
namespace {

// Position of a column within a row.
struct Column {
  NumberType type = NumberType::float32;
  std::size_t offset = 0;

  double at(const char* row) const { return read_number(row + offset, type); }
};

Column find_column(const PlyHeader& header, const std::string& name) {
  Column column;
  for (const PlyProperty& property : header.vertex().properties) {
    column.type = property.type;
    if (property.name == name) return column;
    column.offset += size_of(property.type);
  }
  fail(ErrorKind::content, header.path, ": has no column '", name, "', so it was not written by save_soundings");
}

}  // namespace

Soundings load_soundings(const std::string& path) {
  require_readable(path);
  const PlyHeader header = probe_ply(path);
  const PlyElement& vertex = header.vertex();
  if (header.encoding != "binary_little_endian" || vertex.has_list() || &vertex != &header.elements.front())
    fail(ErrorKind::content, path,
         ": is not a binary little-endian PLY of points, so it was not written by save_soundings");
  std::size_t stride = 0;
  for (const PlyProperty& property : vertex.properties) stride += size_of(property.type);
  const std::string bytes = read_whole_file(path);
  if (bytes.size() < header.end + stride * vertex.count)
    fail(ErrorKind::content, path, ": cut off: holds fewer than the ", vertex.count, " points that it announces");

  const auto each_row = [&](const std::string& name, auto&& take) {
    const Column column = find_column(header, name);
    for (std::size_t i = 0; i < vertex.count; ++i) take(i, column.at(bytes.data() + header.end + i * stride));
  };
  Soundings soundings;
  soundings.position.resize(vertex.count);
  const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    each_row(axes[axis], [&](std::size_t i, double value) { soundings.position[i][axis] = value; });
  const auto read = [&](const std::string& name, auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    each_row("scalar_" + name, [&](std::size_t, double value) { values.push_back(static_cast<Value>(value)); });
  };
  read("level_db", soundings.level_db);
  read("range", soundings.range);
  read("azimuth", soundings.azimuth);
  read("elevation", soundings.elevation);
  read("ping", soundings.ping);
  read("beam", soundings.beam);
  read("bin", soundings.bin);
  read("material", soundings.material);
  return soundings;
}

}  // namespace insonify
