// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <map>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

NumberType type_named(const std::string& name, const PlyHeader& header) {
  static const std::map<std::string, NumberType> types = {
      {"char", NumberType::int8},      {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
      {"uint8", NumberType::uint8},    {"short", NumberType::int16},     {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},   {"int", NumberType::int32},
      {"int32", NumberType::int32},    {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
      {"float", NumberType::float32},  {"float32", NumberType::float32}, {"double", NumberType::float64},
      {"float64", NumberType::float64}};
  const auto found = types.find(name);
  if (found == types.end())
    fail(ErrorKind::content, header.path, ":", header.lines, ": unknown PLY number type '", shown(name),
         "', expected char uchar short ushort int uint float or double; export the file again");
  return found->second;
}

[[noreturn]] void bad_line(const PlyHeader& header, const std::string& line) {
  fail(ErrorKind::content, header.path, ":", header.lines, ": cannot understand the PLY header line '", shown(line),
       "'; export the file again");
}

void read_header_line(PlyHeader& header, const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty() || words[0] == "obj_info") return;
  if (words[0] == "comment") {
    header.comments.push_back(line.substr(std::min(line.find("comment") + 8, line.size())));
    read_tag(header.path, header.comments.back(), header.tags);
  } else if (words[0] == "format" && words.size() >= 2) {
    header.encoding = words[1];
    if (words[1] != "ascii" && words[1] != "binary_little_endian" && words[1] != "binary_big_endian")
      bad_line(header, line);
  } else if (words[0] == "element" && words.size() == 3) {
    PlyElement element{words[1], 0, {}};
    if (!to_number(words[2], element.count)) bad_line(header, line);
    header.elements.push_back(element);
  } else if (words[0] == "property" && words.size() == 3 && !header.elements.empty()) {
    header.elements.back().properties.push_back({words[2], type_named(words[1], header)});
  } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !header.elements.empty()) {
    header.elements.back().properties.push_back(
        {words[4], type_named(words[3], header), true, type_named(words[2], header)});
  } else {
    bad_line(header, line);
  }
}

PlyHeader read_ply_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  PlyHeader header;
  header.path = path;
  std::string line;
  while (std::getline(file, line)) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (++header.lines == 1 && line != "ply")
      fail(ErrorKind::content, path, ": not a PLY file: expected 'ply' in its first line, found ",
           what_it_looks_like(path));
    if (line == "end_header") {
      header.end = file.eof() ? file_size_of(path) : static_cast<std::size_t>(file.tellg());
      return header;
    }
    if (header.lines > 1) read_header_line(header, line);
  }
  fail(ErrorKind::content, path, ": cut off inside the PLY header: expected 'end_header', found the end after ",
       header.lines, " lines; copy or export the file again");
}

/// Throws Error(content) if the file is smaller than announced. A list holds at least its count.
void check_binary(const PlyHeader& header) {
  std::size_t left = file_size_of(header.path) - header.end;
  for (const PlyElement& element : header.elements) {
    std::size_t row = 0;
    for (const PlyProperty& p : element.properties) row += size_of(p.is_list ? p.count_type : p.type);
    const std::size_t held = row == 0 ? left : left / row;
    if (element.count > held)
      fail(ErrorKind::content, header.path, ": cut off: the header announces ", element.count, " ", element.name,
           " rows of ", element.has_list() ? "at least " : "", row, " bytes, the file holds ", held,
           " of them; copy or export the file again");
    left -= element.count * row;
  }
}

}  // namespace

const PlyElement& PlyHeader::vertex() const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [](const PlyElement& e) { return e.name == "vertex"; });
  if (found == elements.end())
    fail(ErrorKind::content, path, ": the PLY header names no 'vertex' element; export the cloud again");
  return *found;
}

PlyHeader probe_ply(const std::string& path) {
  PlyHeader header = read_ply_header(path);
  if (header.encoding.empty())
    fail(ErrorKind::content, path, ": the PLY header has no 'format' line; export the file again");
  header.vertex();
  if (header.encoding != "ascii") check_binary(header);
  return header;
}

}  // namespace insonify
