#include "core/error.hpp"
#include "scene_io/file_probe.hpp"
#include "scene_io/raw_cloud.hpp"
#include "scene_io/text_lines.hpp"

#include <algorithm>
#include <fstream>
#include <map>

namespace insonify {
namespace {

struct Property {
  std::string name;
  NumberType type = NumberType::float32;
  bool is_list = false;
  NumberType count_type = NumberType::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  bool has_list() const {
    return std::any_of(properties.begin(), properties.end(), [](const Property& p) { return p.is_list; });
  }
  std::size_t stride() const {
    std::size_t bytes = 0;
    for (const Property& p : properties) bytes += size_of(p.type);
    return bytes;
  }
};

enum class Encoding { ascii, binary_little_endian, binary_big_endian };

struct Header {
  std::string path;
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  SceneTags tags;
  std::size_t end = 0;    ///< [bytes] where the data begins
  std::size_t lines = 0;  ///< in the header
};

NumberType type_named(const std::string& name, const std::string& path, std::size_t line) {
  static const std::map<std::string, NumberType> types = {
      {"char", NumberType::int8},      {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
      {"uint8", NumberType::uint8},    {"short", NumberType::int16},     {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},   {"int", NumberType::int32},
      {"int32", NumberType::int32},    {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
      {"float", NumberType::float32},  {"float32", NumberType::float32}, {"double", NumberType::float64},
      {"float64", NumberType::float64}};
  const auto found = types.find(name);
  if (found == types.end()) {
    fail(ErrorKind::content, path, ":", line, ": unknown PLY number type '", shown(name),
         "', expected char uchar short ushort int uint float or double; export the file again");
  }
  return found->second;
}

[[noreturn]] void bad_line(const Header& header, const std::string& line) {
  fail(ErrorKind::content, header.path, ":", header.lines, ": cannot understand the PLY header line '",
       shown(line), "'; export the file again");
}

void read_header_line(Header& header, const std::string& line, bool& format_seen) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty() || words[0] == "obj_info") return;
  if (words[0] == "comment") {
    read_tag(header.path, std::string_view(line).substr(std::min(line.find("comment") + 8, line.size())),
             header.tags);
  } else if (words[0] == "format" && words.size() >= 2) {
    format_seen = true;
    if (words[1] == "ascii")
      header.encoding = Encoding::ascii;
    else if (words[1] == "binary_little_endian")
      header.encoding = Encoding::binary_little_endian;
    else if (words[1] == "binary_big_endian")
      header.encoding = Encoding::binary_big_endian;
    else
      bad_line(header, line);
  } else if (words[0] == "element" && words.size() == 3) {
    Element element{words[1], 0, {}};
    if (!to_number(words[2], element.count)) bad_line(header, line);
    header.elements.push_back(element);
  } else if (words[0] == "property" && words.size() == 3 && !header.elements.empty()) {
    header.elements.back().properties.push_back({words[2], type_named(words[1], header.path, header.lines)});
  } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !header.elements.empty()) {
    header.elements.back().properties.push_back({words[4], type_named(words[3], header.path, header.lines),
                                                 true, type_named(words[2], header.path, header.lines)});
  } else {
    bad_line(header, line);
  }
}

Header read_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Header header;
  header.path = path;
  std::string line;
  bool format_seen = false;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (++header.lines == 1 && line != "ply") {
      fail(ErrorKind::content, path, ": not a PLY file: expected 'ply' in its first line, found ",
           what_it_looks_like(path));
    }
    if (line == "end_header") {
      if (!format_seen)
        fail(ErrorKind::content, path, ": the PLY header has no 'format' line; export the file again");
      header.end = static_cast<std::size_t>(file.tellg());
      return header;
    }
    if (header.lines > 1) read_header_line(header, line, format_seen);
  }
  fail(ErrorKind::content, path,
       ": cut off inside the PLY header: expected 'end_header', found the end after ", header.lines,
       " lines; copy or export the file again");
}

/// Reads the vertex element and the faces; elements in the file's order, each reader leaves off where the
/// next begins.
class Body {
 public:
  Body(const Header& header, RawCloud& raw, const ReadOptions& options)
      : header_(header),
        raw_(raw),
        options_(options),
        offset_(header.end),
        size_(file_size_of(header.path)) {}

  void read() {
    if (header_.encoding == Encoding::ascii) {
      text_ = read_whole_file(header_.path);
      lines_ = LineReader(std::string_view(text_).substr(header_.end), header_.lines);
    }
    for (const Element& element : header_.elements) {
      if (element.name == "vertex") vertices_ = element.count;
    }
    for (const Element& element : header_.elements) {
      if (element.name == "vertex" && element.has_list()) {
        fail(ErrorKind::content, header_.path,
             ": the PLY vertices hold a list property, which cannot be read; ",
             "save the file again from CloudCompare or MeshLab");
      }
      if (header_.encoding == Encoding::ascii)
        read_ascii(element);
      else if (element.has_list())
        read_binary_lists(element);
      else
        read_binary_rows(element);
    }
    const bool binary = header_.encoding != Encoding::ascii;
    if (binary && offset_ < size_) {
      raw_.notes.push_back(std::to_string(size_ - offset_) + " bytes after the announced data were ignored");
    }
  }

 private:
  [[noreturn]] void cut_off(const Element& element, std::size_t found) const {
    fail(ErrorKind::content, header_.path, ": cut off: the header announces ", element.count, " ",
         element.name, " rows, found ", found, "; copy or export the file again");
  }

  void read_binary_rows(const Element& element) {
    const std::size_t stride = element.stride();
    if (stride > 0 && element.count > (size_ - offset_) / stride) {
      fail(ErrorKind::content, header_.path, ": cut off: the header announces ", element.count, " ",
           element.name, " rows of ", stride, " bytes, the file holds ", (size_ - offset_) / stride,
           " of them; copy or export the file again");
    }
    if (element.name == "vertex") {
      RowTable table = table_in_file(header_.path, offset_, element.count, stride);
      table.swap_bytes = header_.encoding == Encoding::binary_big_endian;
      std::size_t at = 0;
      for (const Property& p : element.properties) {
        table.columns.push_back({p.name, p.type, at});
        at += size_of(p.type);
      }
      fill_cloud(raw_, table, options_);
    }
    offset_ += stride * element.count;
  }

  void read_binary_lists(const Element& element) {
    if (text_.empty()) text_ = read_whole_file(header_.path);
    const bool swap = header_.encoding == Encoding::binary_big_endian;
    std::vector<std::int64_t> corners;
    for (std::size_t row = 0; row < element.count; ++row) {
      for (const Property& p : element.properties) {
        std::size_t numbers = 1;
        if (p.is_list) {
          if (size_ - offset_ < size_of(p.count_type)) cut_off(element, row);
          const double announced = read_number(text_.data() + offset_, p.count_type, swap);
          offset_ += size_of(p.count_type);
          if (!(announced >= 0 && announced < 1e9)) cut_off(element, row);
          numbers = static_cast<std::size_t>(announced);
        }
        if (numbers > (size_ - offset_) / size_of(p.type)) cut_off(element, row);
        if (is_corners(element, p)) {
          corners.clear();
          for (std::size_t i = 0; i < numbers; ++i) {
            corners.push_back(static_cast<std::int64_t>(
                read_number(text_.data() + offset_ + i * size_of(p.type), p.type, swap)));
          }
          add_polygon(raw_, corners, vertices_);
        }
        offset_ += numbers * size_of(p.type);
      }
    }
  }

  void read_ascii(const Element& element) {
    if (element.name == "vertex") {
      if (element.count > text_.size()) cut_off(element, 0);
      std::vector<std::string> names;
      for (const Property& p : element.properties) names.push_back(p.name);
      fill_cloud(raw_,
                 table_of_doubles(names, read_number_rows(lines_, element.count, names.size(), header_.path)),
                 options_);
      return;
    }
    std::string_view line;
    std::vector<std::int64_t> corners;
    for (std::size_t row = 0; row < element.count; ++row) {
      if (!lines_.next_filled(line)) cut_off(element, row);
      for (const Property& p : element.properties) {
        const double announced = p.is_list ? ascii_number(line, element) : 1;
        const std::size_t numbers = announced > 0 ? static_cast<std::size_t>(announced) : 0;
        corners.clear();
        for (std::size_t i = 0; i < numbers; ++i)
          corners.push_back(static_cast<std::int64_t>(ascii_number(line, element)));
        if (is_corners(element, p)) add_polygon(raw_, corners, vertices_);
      }
    }
  }

  double ascii_number(std::string_view& line, const Element& element) const {
    double value = 0;
    const std::string_view word = take_word(line);
    if (!to_number(word, value) || !(value > -1e15 && value < 1e15)) {
      fail(ErrorKind::content, header_.path, ":", lines_.number(), ": expected a number in this ",
           element.name, " row, found '", shown(word),
           "'; correct the line, or export the file again if it is cut off");
    }
    return value;
  }

  static bool is_corners(const Element& element, const Property& p) {
    return element.name == "face" && p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  const Header& header_;
  RawCloud& raw_;
  const ReadOptions& options_;
  std::size_t offset_, size_, vertices_ = 0;
  std::string text_;  ///< the whole file: of ASCII, or of binary lists
  LineReader lines_{std::string_view()};
};

}  // namespace

RawCloud read_ply(const std::string& path, const ReadOptions& options) {
  const Header header = read_header(path);
  RawCloud raw;
  raw.path = path;
  raw.tags = header.tags;
  const char* encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  raw.format = std::string("PLY ") + encodings[static_cast<int>(header.encoding)];
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const Element& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) {
    fail(ErrorKind::content, path, ": the PLY header names no 'vertex' element; export the cloud again");
  }
  for (const Property& p : vertex->properties) raw.fields.push_back({p.name, name_of(p.type)});
  raw.width = vertex->count;
  Body(header, raw, options).read();
  if (!raw.triangle.empty() || raw.bad_triangles > 0) raw.format += " mesh";
  return raw;
}

}  // namespace insonify
