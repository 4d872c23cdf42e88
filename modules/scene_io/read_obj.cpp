// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <unordered_map>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// Reads OBJ without PCL and VTK, which keep its coordinates as float: 0.5 m steps at a UTM northing.
namespace insonify {
namespace {

constexpr std::int64_t no_index = -1;
constexpr std::size_t most_corners = 65535;

struct ObjPolygon {
  std::vector<std::array<std::int64_t, 2>> corners;  ///< position and normal of each
  std::size_t label = 0;
};

struct Obj {
  std::string path;
  std::vector<double> positions, normals;  ///< three numbers each
  std::vector<ObjPolygon> polygons;
};

void read_numbers(const Obj& obj, std::string_view rest, std::size_t line, std::vector<double>& numbers) {
  for (int axis = 0; axis < 3; ++axis) {
    double value = 0;
    const std::string_view word = take_word(rest);
    if (!to_number(word, value))
      fail(ErrorKind::content, obj.path, ":", line, ": expected three numbers, found '", shown(word),
           "'; correct the line, or export the file again if it is cut off");
    numbers.push_back(value);
  }
}

/// Returns the index from 0 of an OBJ reference (from 1, or negative from the end); -2 if it points nowhere.
std::int64_t resolve(std::int64_t reference, std::size_t held) {
  const std::int64_t index = reference > 0 ? reference - 1 : static_cast<std::int64_t>(held) + reference;
  return reference != 0 && index >= 0 ? index : -2;
}

/// Returns the position and normal of a corner "v", "v/t", "v//n" or "v/t/n".
std::array<std::int64_t, 2> read_corner(const Obj& obj, std::string_view word, std::size_t line) {
  const std::size_t first = std::min(word.find('/'), word.size());
  const std::size_t second = first < word.size() ? word.find('/', first + 1) : word.npos;
  std::int64_t position = 0, normal = 0;
  const bool has_normal = second != word.npos && second + 1 < word.size();
  if (!to_number(word.substr(0, first), position) || (has_normal && !to_number(word.substr(second + 1), normal)))
    fail(ErrorKind::content, obj.path, ":", line, ": expected a corner such as 7 or 7/1/7, found '", shown(word),
         "'; correct the line, or export the file again if it is cut off");
  return {resolve(position, obj.positions.size() / 3), has_normal ? resolve(normal, obj.normals.size() / 3) : no_index};
}

/// Returns the name in a line "usemtl NAME". A '#' belongs to it unless a blank is before.
std::string material_in(std::string_view line) {
  std::string_view rest = trimmed(line);
  take_word(rest);
  const std::string_view name = trimmed(rest.substr(0, rest.find(" #")));
  return name.empty() ? "default" : std::string(name);
}

Obj parse(const std::string& path, const std::string& text, RawCloud& raw) {
  MaterialNumbers materials(raw);
  Obj obj;
  std::string material = "default";
  bool named = false;
  obj.path = path;
  LineReader lines(text);
  std::string_view line;
  std::string whole;
  while (lines.next_filled(line)) {
    // A backslash at the end of a line, without its comment, joins it with the next.
    const auto text_of = [](std::string_view l) { return trimmed(l.substr(0, l.find('#'))); };
    for (whole = text_of(line); whole.ends_with('\\') && lines.next(line);) whole.back() = ' ', whole += text_of(line);
    std::string_view rest = whole;
    const std::string_view key = take_word(rest);
    if (key == "v") read_numbers(obj, rest, lines.number(), obj.positions);
    if (key == "vn") read_numbers(obj, rest, lines.number(), obj.normals);
    if (key == "usemtl") material = material_in(line), named = true;
    if (key != "f") continue;
    obj.polygons.push_back({{}, materials.of(material)});
    auto& polygon = obj.polygons.back().corners;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
      if (polygon.size() < most_corners)
        polygon.push_back(read_corner(obj, word, lines.number()));
      else
        fail(ErrorKind::content, path, ":", lines.number(), ": a face of more than ", most_corners,
             " corners; triangulate the mesh and export it again");
  }
  if (!named) raw.material_names.clear();
  return obj;
}

/// The vertices: one per position, normal and label that the faces use. A vertex without normal has zeros.
struct ObjCorners {
  std::vector<double> rows;                                                                ///< x y z nx ny nz label
  std::unordered_map<std::size_t, std::unordered_map<std::uint64_t, std::int64_t>> known;  ///< those of each label

  std::int64_t vertex_of(const Obj& obj, const std::array<std::int64_t, 2>& corner, std::size_t label) {
    const std::size_t normals = obj.normals.size() / 3;
    const std::int64_t n = corner[1] >= 0 && corner[1] < static_cast<std::int64_t>(normals) ? corner[1] : no_index;
    if (corner[0] < 0 || corner[0] >= static_cast<std::int64_t>(obj.positions.size() / 3)) return no_index;
    const std::uint64_t key = static_cast<std::uint64_t>(corner[0]) << 32 | static_cast<std::uint32_t>(n);
    const auto [entry, is_new] = known[label].try_emplace(key, static_cast<std::int64_t>(rows.size() / 7));
    if (is_new) {
      for (int axis = 0; axis < 3; ++axis) rows.push_back(obj.positions[3 * corner[0] + axis]);
      for (int axis = 0; axis < 3; ++axis) rows.push_back(n == no_index ? 0.0 : obj.normals[3 * n + axis]);
      rows.push_back(static_cast<double>(label));
    }
    return entry->second;
  }
};

}  // namespace

RawCloud read_obj(const std::string& path, const ReadOptions& options) {
  const std::string text = read_whole_file(path);
  RawCloud raw;
  const Obj obj = parse(path, text, raw);
  const std::size_t positions = obj.positions.size() / 3;
  if (positions == 0)
    fail(ErrorKind::content, path, ": not an OBJ file: expected vertex lines 'v x y z', found none; it looks like ",
         what_it_looks_like(path));
  raw.path = path;
  raw.format = obj.polygons.empty() ? "OBJ points" : "OBJ mesh";
  raw.points_in_file = raw.width = positions;
  raw.fields = {{"x", "text"}, {"y", "text"}, {"z", "text"}};
  const bool normals = !obj.normals.empty() && (!obj.polygons.empty() || obj.normals.size() == obj.positions.size());
  if (normals) raw.fields.insert(raw.fields.end(), {{"nx", "text"}, {"ny", "text"}, {"nz", "text"}});

  std::vector<std::string> names = {"x", "y", "z"};
  if (obj.polygons.empty() && !normals) {
    fill_cloud(raw, table_of_doubles(names, obj.positions), options);
    return raw;
  }
  ObjCorners corners;
  if (obj.polygons.empty()) {
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(positions); ++i) corners.vertex_of(obj, {i, i}, 0);
  }
  std::vector<std::int64_t> polygon;
  for (const auto& face : obj.polygons) {
    polygon.clear();
    for (const auto& corner : face.corners) polygon.push_back(corners.vertex_of(obj, corner, face.label));
    add_polygon(raw, polygon, std::numeric_limits<std::uint32_t>::max());
  }
  if (corners.rows.empty())
    fail(ErrorKind::content, path, ": no face has corners that exist (", positions, " vertices, ", obj.polygons.size(),
         " faces); export the mesh again");
  names.insert(names.end(), {"nx", "ny", "nz", "label"});
  RowTable table = table_of_doubles(names, std::move(corners.rows));
  if (raw.material_names.empty()) table.columns.pop_back();
  fill_cloud(raw, table, options);
  if (!normals) raw.normal.clear();
  return raw;
}

}  // namespace insonify
