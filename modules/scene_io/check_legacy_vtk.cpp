// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr std::string_view vtk_blanks = " \t\r\n\v\f";

/// Reads a file as VTK's reader does, but keeps nothing.
class LegacyWalk {
 public:
  LegacyWalk(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  void walk() {
    take_header();
    for (std::string key = lower_case(word()); !key.empty(); key = lower_case(word())) take_section(key);
  }

 private:
  template <typename... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    fail(ErrorKind::content, path_, ": ", parts..., "; the file is damaged or cut off: copy or export it again");
  }

  std::string word() {
    at_ = std::min(text_.find_first_not_of(vtk_blanks, at_), text_.size());
    const std::size_t end = std::min(text_.find_first_of(vtk_blanks, at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return std::string(found.substr(0, 256));
  }

  std::string line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view found = text_.substr(at_, std::min<std::size_t>(end - at_, 256));
    at_ = std::min(end + 1, text_.size());
    return std::string(trimmed(found, " \t\r"));
  }

  std::size_t count(const std::string& of) {
    const std::string text = word();
    std::size_t value = 0;
    if (!to_number(text, value)) refuse("expected the number of ", of, ", found '", shown(text), "'");
    return value;
  }

  void take_header() {
    if (!text_.starts_with("# vtk DataFile"))
      fail(ErrorKind::content, path_, ": not a legacy VTK file: expected '# vtk DataFile' in its first line, found ",
           what_it_looks_like(path_));
    const std::string first = line();
    constexpr std::string_view head = "# vtk DataFile Version";
    int major = 0, minor = 0;
    modern_ =
        first.starts_with(head) && std::sscanf(first.c_str() + head.size(), "%d.%d", &major, &minor) == 2 && major >= 5;
    line();
    binary_ = lower_case(word()) == "binary";
    std::string key = lower_case(word());
    for (; key == "field"; key = lower_case(word())) take_field();
    const std::string kind = key == "dataset" ? word() : "nothing";
    if (lower_case(kind) != "polydata")
      fail(ErrorKind::content, path_, ": holds ", shown(kind), ", expected DATASET POLYDATA; ", surface_remedy(".vtk"));
  }

  std::size_t bits_of(const std::string& type) const {
    static const std::map<std::string, std::size_t> bits = {
        {"bit", 1},           {"char", 8},           {"unsigned_char", 8}, {"short", 16}, {"unsigned_short", 16},
        {"int", 32},          {"unsigned_int", 32},  {"vtkidtype", 32},    {"long", 64},  {"unsigned_long", 64},
        {"vtktypeint64", 64}, {"vtktypeuint64", 64}, {"float", 32},        {"double", 64}};
    const auto found = bits.find(lower_case(type));
    if (found == bits.end())
      fail(ErrorKind::content, path_, ": holds an array of type '", shown(type),
           "', expected numbers; delete the array, or save the file as .vtp");
    return found->second;
  }

  /// Returns true if VTK reads a text that is a number as one of this type; else it goes on within the text, or crashes.
  static bool fits(const std::string& number, double value, const std::string& type, std::size_t bits) {
    if (type == "float" || type == "double") return true;
    const bool positive = type.find("uns") != type.npos || type.find("uint") != type.npos;
    const double most = std::ldexp(positive ? 2 : 1, static_cast<int>(std::max<std::size_t>(bits, 32)) - 1);
    return number.find_first_not_of("+-0123456789") == number.npos && value >= -most && value < most;
  }

  /// Skips the numbers of an array, and passes each to `use` if that is given.
  void take_numbers(const std::string& of, const std::string& type, std::size_t rows, std::size_t columns,
                    const std::function<void(std::int64_t)>& use = {}) {
    const std::size_t bits = bits_of(type);
    if (binary_) line();
    // A number of one bit takes an eighth of a byte; so products of numbers that pass do not overflow.
    const std::size_t held = 8 * (text_.size() - at_);
    if (columns > held || (columns > 0 && rows > held / columns))
      refuse(of, " announces ", rows, " x ", columns, " numbers, the file ends before");
    const std::size_t numbers = rows * columns,
                      bytes = binary_ ? (numbers * bits + 7) / 8 : 2 * numbers - (numbers > 0);
    if (bytes > text_.size() - at_) refuse(of, " announces ", numbers, " numbers, the file ends before");
    for (std::size_t i = 0; i < numbers && binary_ && use; ++i) use(big_endian(at_ + i * bits / 8, bits / 8));
    for (std::size_t i = 0; i < numbers && !binary_; ++i) {
      const std::string number = word();
      double value = 0;
      if (!to_number(number, value) || !fits(number, value, lower_case(type), bits))
        refuse(of, " announces ", numbers, " numbers of type ", type, "; number ", i, " is '", shown(number), "'");
      if (use) use(static_cast<std::int64_t>(std::clamp(value, -9e18, 9e18)));
    }
    if (binary_) at_ += bytes;
  }

  std::int64_t big_endian(std::size_t at, std::size_t bytes) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(text_[at + i]);
    return bytes == 4 ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value);
  }

  /// Skips cells in the form of VTK before version 9: the number of corners of each, then its corners.
  void take_old_cells(const std::string& of, std::size_t cells, std::size_t numbers) {
    std::size_t found = 0, left = 0;
    bool good = true;
    take_numbers(of, "int", numbers, 1, [&](std::int64_t number) {
      if (left > 0) {
        --left;
      } else {
        ++found;
        good = good && number >= 0 && static_cast<std::uint64_t>(number) < numbers;
        left = good ? static_cast<std::size_t>(number) : 0;
      }
    });
    if (!good || left > 0 || found != cells)
      refuse(of, " announces ", cells, " cells in ", numbers, " numbers, its cells have other lengths");
  }

  /// Skips cells in version 5 of the format: the offset of each, then the corners of all.
  void take_cells(const std::string& of, std::size_t offsets, std::size_t corners) {
    if (offsets == 0) return;
    if (lower_case(word()) != "offsets") refuse(of, " has no OFFSETS");
    std::int64_t last = 0, index = 0;
    bool good = true;
    take_numbers(of, word(), offsets, 1, [&](std::int64_t offset) {
      good = good && (index++ == 0 ? offset == 0 : offset >= last);
      last = offset;
    });
    if (!good || static_cast<std::uint64_t>(last) != corners) refuse(of, " has OFFSETS that do not fit its corners");
    if (lower_case(word()) != "connectivity") refuse(of, " has no CONNECTIVITY");
    take_numbers(of, word(), corners, 1);
  }

  void take_field() {
    word();
    const std::size_t arrays = count("arrays of a FIELD");
    for (std::size_t i = 0; i < arrays; ++i) {
      std::string name = word();
      for (; name == "METADATA"; name = word()) take_metadata();
      if (name.empty()) refuse("FIELD announces ", arrays, " arrays, found ", i);
      if (name == "NULL_ARRAY") continue;
      const std::size_t columns = count("components"), rows = count("tuples");
      take_numbers("array " + shown(name), word(), rows, columns);
    }
  }

  void take_metadata() {
    line();
    while (at_ < text_.size() && !line().empty()) {
    }
  }

  /// Skips an attribute of the points or cells. Returns false if `key` begins none.
  bool take_attribute(const std::string& key) {
    if (key == "scalars") {
      const std::string name = shown(word()), type = word();
      std::size_t columns = 1;
      const std::string rest = line();
      if (!rest.empty() && !to_number(rest, columns)) refuse("SCALARS ", name, " has '", shown(rest), "' components");
      if (lower_case(word()) != "lookup_table") refuse("SCALARS ", name, " names no LOOKUP_TABLE");
      word();
      take_numbers(name, type, rows_, columns);
    } else if (key == "color_scalars") {
      const std::string name = shown(word());
      take_numbers(name, binary_ ? "unsigned_char" : "float", rows_, count("colours"));
    } else if (key == "lookup_table") {
      const std::string name = shown(word());
      take_numbers(name, binary_ ? "unsigned_char" : "float", count("colours"), 4);
    } else if (key == "texture_coordinates") {
      const std::string name = shown(word());
      const std::size_t columns = count("texture coordinates");
      take_numbers(name, word(), rows_, columns);
    } else {
      static const std::map<std::string, std::size_t> columns = {
          {"vectors", 3},    {"normals", 3},      {"tensors", 9},   {"tensors6", 6},
          {"global_ids", 1}, {"pedigree_ids", 1}, {"edge_flags", 1}};
      const auto found = columns.find(key);
      if (found == columns.end()) return false;
      const std::string name = shown(word());
      take_numbers(name, word(), rows_, found->second);
    }
    return true;
  }

  void take_section(const std::string& key) {
    if (key == "points") {
      const std::size_t points = count("points");
      take_numbers("POINTS", word(), points, 3);
    } else if (key == "vertices" || key == "lines" || key == "polygons" || key == "triangle_strips") {
      const std::size_t cells = count("cells"), numbers = count("numbers");
      modern_ ? take_cells(key, cells, numbers) : take_old_cells(key, cells, numbers);
    } else if (key == "point_data" || key == "cell_data") {
      rows_ = count("rows of " + key);
      in_data_ = true;
    } else if (key == "field") {
      take_field();
    } else if (key == "metadata") {
      take_metadata();
    } else if (!in_data_ || !take_attribute(key)) {
      refuse("'", shown(key), "' is no part of a legacy VTK file");
    }
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0, rows_ = 0;
  bool binary_ = false, modern_ = false, in_data_ = false;
};

}  // namespace

void check_legacy_vtk(const std::string& path) {
  const std::string text = read_whole_file(path);
  LegacyWalk(path, text).walk();
}

}  // namespace insonify
