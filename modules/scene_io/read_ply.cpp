// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/row_file_internal.hpp"

// Reads PLY without PCL, which takes no strips and no lists of vertices, and ends at counts with a sign.
namespace insonify {
namespace {

/// Reads the elements of a file in their order: vertices into a table, faces and strips into `raw`.
class PlyWalk {
 public:
  PlyWalk(const PlyHeader& header, RawCloud& raw)
      : header_(header), raw_(raw), file_(header.path, std::ios::binary), line_number_(header.lines) {
    file_.seekg(static_cast<std::streamoff>(header.end));
  }

  RowTable walk() {
    RowTable table;
    for (const PlyProperty& property : header_.vertex().properties) {
      if (property.is_list) {
        raw_.notes.push_back("the lists '" + shown(property.name) + "' of the vertices are not read");
        continue;
      }
      table.columns.push_back({property.name, property.type, table.stride});
      table.stride += size_of(property.type);
    }
    for (const PlyElement& element : header_.elements) take_element(element);
    if (const auto rest = file_.peek(); rest != std::ifstream::traits_type::eof() && !ascii_)
      raw_.notes.push_back("what follows the last row that the header announces is not read");
    table.rows = header_.vertex().count;
    const auto held = std::make_shared<const std::string>(std::move(rows_));
    table.bytes = held->data();
    table.owner = held;
    return table;
  }

 private:
  void take_element(const PlyElement& element) {
    const bool vertices = &element == &header_.vertex(), strips = element.name == "tristrips";
    element_ = &element;
    for (row_ = 0; row_ < element.count; ++row_) {
      if (ascii_) next_line();
      for (const PlyProperty& property : element.properties) {
        const double numbers = property.is_list ? next(property.count_type) : 1;
        if (!(numbers >= 0 && numbers == std::floor(numbers))) refuse_number(property.count_type, "a negative length");
        corners_.clear();
        const bool used = (strips || element.name == "face") && property.is_list &&
                          (property.name == "vertex_indices" || property.name == "vertex_index");
        for (double i = 0; i < numbers; ++i) {
          const double number = next(property.type);
          if (vertices && !property.is_list) append_number(rows_, property.type, number);
          if (used) corners_.push_back(vertex_of(number));
        }
        if (used) (strips ? add_strip : add_polygon)(raw_, corners_, header_.vertex().count);
      }
      if (ascii_) end_line();
    }
  }

  /// Returns the vertex of a number; -1 for -1, which ends a strip, and -2 for one that does not exist.
  std::int64_t vertex_of(double number) const {
    if (number == -1) return -1;
    return number >= 0 && number < static_cast<double>(header_.vertex().count) ? static_cast<std::int64_t>(number) : -2;
  }

  double next(NumberType type) {
    if (ascii_) {
      double number = 0;
      const std::string_view word = take_word(rest_);
      if (!to_number(word, number) || !fits(number, type)) refuse_number(type, shown(word));
      return number;
    }
    std::array<char, 8> bytes;
    if (!file_.read(bytes.data(), static_cast<std::streamsize>(size_of(type)))) cut_off();
    if (header_.encoding == "binary_big_endian") std::reverse(bytes.begin(), bytes.begin() + size_of(type));
    return read_number(bytes.data(), type);
  }

  void next_line() {
    if (!std::getline(file_, line_)) cut_off();
    ++line_number_;
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    rest_ = line_;
  }

  void end_line() {
    if (!take_word(rest_).empty())
      fail(ErrorKind::content, header_.path, ":", line_number_, ": expected the ", element_->properties.size(), " ",
           element_->has_list() ? "columns" : "numbers", " of a ", element_->name, " as the header says, found ",
           count_words(line_), " words in '", shown(line_),
           "'; correct the line, or export the file again if it is cut off");
  }

  [[noreturn]] void refuse_number(NumberType type, const std::string& found) const {
    fail(ErrorKind::content, header_.path, ascii_ ? ":" + std::to_string(line_number_) : "",
         ": expected a number in this ", element_->name, " row that fits ", name_of(type), ", found '", found,
         "'; correct it, or export the file again if it is cut off");
  }

  [[noreturn]] void cut_off() const {
    fail(ErrorKind::content, header_.path, ": cut off: the header announces ", element_->count, " ", element_->name,
         " rows, found ", row_, "; copy or export the file again");
  }

  const PlyHeader& header_;
  RawCloud& raw_;
  std::ifstream file_;
  const bool ascii_ = header_.encoding == "ascii";
  const PlyElement* element_ = nullptr;
  std::size_t row_ = 0, line_number_;
  std::string line_, rows_;
  std::string_view rest_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

RawCloud read_ply(const std::string& path, const ReadOptions& options) {
  const PlyHeader header = probe_ply(path);
  RawCloud raw;
  raw.path = path;
  raw.tags = header.tags;
  if (!raw.tags.system.empty()) raw.meaning.system = {raw.tags.system, MeaningOrigin::file};
  raw.format = "PLY " + header.encoding;
  raw.width = header.vertex().count;
  if (raw.width >= std::numeric_limits<std::uint32_t>::max())
    fail(ErrorKind::content, path, ": holds ", raw.width, " points, must be at most 4294967294; split it");
  for (const PlyProperty& p : header.vertex().properties)
    if (!p.is_list) raw.fields.push_back({p.name, name_of(p.type)});
  const bool heights = raw.tags.prepared && raw.tags.heights;
  const std::optional<RowFile> rows = heights ? std::nullopt : find_ply_rows(path);
  fill_cloud(raw, rows ? all_rows(*rows) : PlyWalk(header, raw).walk(), options);
  if (heights)
    raw.surface = std::move(raw.triangle), raw.triangle.clear();
  else if (!raw.triangle.empty() || raw.bad_triangles > 0)
    raw.format += " mesh";
  return raw;
}

}  // namespace insonify
