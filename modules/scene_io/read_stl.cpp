// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include <boost/container_hash/hash.hpp>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// Reads STL without VTK, which keeps coordinates of text as float, and takes no blank before 'solid' and no long names.
namespace insonify {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;
constexpr std::size_t any_vertex = std::numeric_limits<std::uint32_t>::max();

/// The vertices of a file: corners at the same position are one vertex.
struct StlVertices {
  std::vector<double> rows;  ///< x y z
  std::unordered_map<std::array<double, 3>, std::int64_t, boost::hash<std::array<double, 3>>> known;

  std::int64_t vertex_at(std::array<double, 3> position) {
    for (double& coordinate : position) coordinate += 0.0;  // -0 becomes 0
    const auto [entry, is_new] = known.try_emplace(position, static_cast<std::int64_t>(known.size()));
    if (is_new) rows.insert(rows.end(), position.begin(), position.end());
    return entry->second;
  }
};

/// Reads facets of text. A solid may have any name, and blanks and empty lines before it.
void read_text_facets(const std::string& text, RawCloud& raw, StlVertices& vertices) {
  constexpr std::array words = {"facet", "outer", "loop", "endloop", "end"};
  LineReader lines(text);
  std::string_view line, rest;
  std::string last;
  std::vector<std::int64_t> corners;
  const auto refuse = [&](const std::string& expected, std::string_view found) {
    fail(ErrorKind::content, raw.path, ":", lines.number(), ": expected ", expected, ", found '", shown(found),
         "'; correct the line, or export the file again if it is cut off");
  };
  while (lines.next_filled(line)) {
    rest = line;
    while (rest.find_first_not_of(" \t") != rest.npos) {
      const std::string_view word = take_word(rest);
      last = lower_case(std::string(word));
      if (last == "solid" || last == "endsolid") {
        rest = {};  // the rest is a name
      } else if (last == "normal") {
        for (int axis = 0; axis < 3; ++axis) take_word(rest);
      } else if (last == "vertex") {
        std::array<double, 3> position{};
        for (double& coordinate : position)
          if (const std::string_view number = take_word(rest); !to_number(number, coordinate))
            refuse("three numbers", number);
        corners.push_back(vertices.vertex_at(position));
      } else if (last == "endfacet") {
        add_polygon(raw, corners, any_vertex);
        corners.clear();
      } else if (std::find(words.begin(), words.end(), last) == words.end()) {
        refuse("facet, outer loop, vertex, endloop or endfacet", word);
      }
    }
  }
  if (last != "endsolid" && last != "solid")
    fail(ErrorKind::content, raw.path, ": cut off: an ASCII STL file ends with 'endsolid', found '", shown(line),
         "'; copy or export the file again");
}

/// Reads facets of 50 bytes: a normal, three corners, and two bytes that programs use for colours.
void read_binary_facets(const std::string& bytes, RawCloud& raw, StlVertices& vertices) {
  for (std::size_t t = 0; t < read_as<std::uint32_t>(bytes.data() + header_bytes - 4); ++t) {
    const char* number = bytes.data() + header_bytes + t * triangle_bytes + 3 * sizeof(float);
    std::vector<std::int64_t> corners;
    for (int k = 0; k < 3; ++k, number += 3 * sizeof(float))
      corners.push_back(vertices.vertex_at({read_as<float>(number), read_as<float>(number + sizeof(float)),
                                            read_as<float>(number + 2 * sizeof(float))}));
    add_polygon(raw, corners, any_vertex);
  }
}

/// Returns true if the file is text. A file of the size of its triangles is binary, whatever its first bytes are.
bool is_text_stl(const std::string& path, const std::string& bytes) {
  const std::size_t announced = bytes.size() < header_bytes ? 0 : read_as<std::uint32_t>(&bytes[header_bytes - 4]);
  const std::size_t size = header_bytes + triangle_bytes * announced;
  if (bytes.size() == size) return false;
  const std::string found = what_it_looks_like(path);
  std::string_view line;
  LineReader(bytes).next_filled(line);
  if (found != "binary data" && lower_case(std::string(take_word(line))) == "solid") return true;
  if (found == "binary data" && announced > 0 && bytes.size() > size) return false;
  if (found == "binary data" && bytes.size() >= header_bytes)
    fail(ErrorKind::content, path, ": cut off or not an STL file: it announces ", announced, " triangles, ", size,
         " bytes, and holds ", bytes.size(), "; copy or export the file again");
  fail(ErrorKind::content, path, ": not an STL file: expected 'solid ...' or a binary header of 84 bytes, found ",
       found);
}

}  // namespace

RawCloud read_stl(const std::string& path, const ReadOptions& options) {
  const std::string bytes = read_whole_file(path);
  const bool text = is_text_stl(path, bytes);
  RawCloud raw;
  raw.path = path;
  raw.format = "STL mesh";
  for (const char* axis : {"x", "y", "z"}) raw.fields.push_back({axis, text ? "text" : "float"});
  raw.float_coordinates = !text;
  StlVertices vertices;
  (text ? read_text_facets : read_binary_facets)(bytes, raw, vertices);
  raw.width = vertices.known.size();
  fill_cloud(raw, table_of_doubles({"x", "y", "z"}, std::move(vertices.rows)), options);
  return raw;
}

}  // namespace insonify
