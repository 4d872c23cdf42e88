// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/row_file_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// Reads LAS 1.0 to 1.4 (ASPRS, LAS Specification 1.4 R15): a header, variable-length records, of which those that
// describe extra bytes are read, and points as rows of packed numbers.
namespace insonify {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS numbers are read as they lie in the file");

/// A part of a file, read with checks of its bounds.
struct Bytes {
  const std::string& path;
  const std::string& all;

  template <typename T>
  T at(std::size_t offset) const {
    if (offset + sizeof(T) > all.size())
      fail(ErrorKind::content, path, ": cut off: the header of a LAS file ends at byte ", all.size(),
           "; copy or export the file again");
    return read_as<T>(all.data() + offset);
  }
  std::string text(std::size_t offset, std::size_t length) const {
    at<char>(offset + length - 1);
    return {all.data() + offset, ::strnlen(all.data() + offset, length)};
  }
};

/// What all points have at first, by the point data record format.
struct PointFormat {
  std::size_t bytes;           ///< of a record without extra bytes
  std::size_t classification;  ///< its offset
  std::size_t gps_time, red;   ///< their offsets; 0: absent
};
constexpr std::array<PointFormat, 11> point_formats = {{{20, 15, 0, 0},
                                                        {28, 15, 20, 0},
                                                        {26, 15, 0, 20},
                                                        {34, 15, 20, 28},
                                                        {57, 15, 20, 0},
                                                        {63, 15, 20, 28},
                                                        {30, 16, 22, 0},
                                                        {36, 16, 22, 30},
                                                        {38, 16, 22, 30},
                                                        {59, 16, 22, 0},
                                                        {67, 16, 22, 30}}};

/// Data types of extra bytes, from 1 on.
constexpr std::array<NumberType, 10> extra_types = {
    NumberType::uint8, NumberType::int8,   NumberType::uint16, NumberType::int16,   NumberType::uint32,
    NumberType::int32, NumberType::uint64, NumberType::int64,  NumberType::float32, NumberType::float64};

/// Adds the columns that one record of descriptions of extra bytes names, from `offset` within a row.
void add_extra_columns(const Bytes& header, std::size_t begin, std::size_t length, std::size_t offset, RowFile& file) {
  constexpr std::size_t description = 192, scaled = 8, shifted = 16;
  for (std::size_t at = begin; at + description <= begin + length; at += description) {
    const auto type = header.at<std::uint8_t>(at + 2), options = header.at<std::uint8_t>(at + 3);
    if (type == 0) {
      offset += options;  // bytes without a meaning, as many as the options say
      continue;
    }
    if (type > extra_types.size())
      fail(ErrorKind::content, file.path, ": extra bytes '", header.text(at + 4, 32), "' are of type ", int{type},
           ", expected 0 to 10; export the file without them");
    RowTable::Column column{header.text(at + 4, 32), extra_types[type - 1u], offset};
    if (options & scaled) column.scale = header.at<double>(at + 112);
    if (options & shifted) column.shift = header.at<double>(at + 136);
    offset += size_of(column.type);
    if (offset > file.stride)
      fail(ErrorKind::content, file.path, ": extra bytes '", column.name, "' end beyond a point of ", file.stride,
           " bytes; export the file again");
    file.columns.push_back(column);
  }
}

/// Columns that the point format has.
void add_columns(const Bytes& header, const PointFormat& format, bool low_bits, RowFile& file) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    file.columns.push_back({std::string(1, static_cast<char>('x' + axis)), NumberType::int32, 4 * axis,
                            header.at<double>(131 + 8 * axis), header.at<double>(155 + 8 * axis)});
  file.columns.push_back({"intensity", NumberType::uint16, 12});
  file.columns.push_back({"classification", NumberType::uint8, format.classification});
  file.columns.back().mask = low_bits ? 0x1f : 0xff;  // the others are flags
  if (format.gps_time > 0) file.columns.push_back({"gps_time", NumberType::float64, format.gps_time});
  if (format.red == 0) return;
  for (std::size_t k = 0; k < 3; ++k)
    file.columns.push_back({std::array{"red", "green", "blue"}[k], NumberType::uint16, format.red + 2 * k});
}

}  // namespace

std::optional<RowFile> find_las_rows(const std::string& path) {
  require_readable(path);
  const std::string first = read_beginning(path, 375);
  const Bytes start{path, first};
  if (first.substr(0, 4) != "LASF")
    fail(ErrorKind::content, path, ": not a LAS file: expected 'LASF', found ", what_it_looks_like(path));
  const int major = start.at<std::uint8_t>(24), minor = start.at<std::uint8_t>(25);
  if (major != 1 || minor > 4)
    fail(ErrorKind::content, path, ": is LAS ", major, ".", minor, ", expected 1.0 to 1.4; convert it");
  const unsigned format = start.at<std::uint8_t>(104);
  if (format >= 128) fail(ErrorKind::content, path, ": its points are compressed (LAZ); ", laz_remedy);
  if (format >= point_formats.size())
    fail(ErrorKind::content, path, ": point data record format ", format, ", expected 0 to 10; convert it");
  const PointFormat& layout = point_formats[format];

  RowFile file;
  file.path = path;
  file.format =
      "LAS " + std::to_string(major) + "." + std::to_string(minor) + ", point format " + std::to_string(format);
  file.begin = start.at<std::uint32_t>(96);
  file.stride = start.at<std::uint16_t>(105);
  const std::uint64_t many = minor >= 4 ? start.at<std::uint64_t>(247) : 0;
  file.rows = many > 0 ? many : start.at<std::uint32_t>(107);
  if (file.stride < layout.bytes)
    fail(ErrorKind::content, path, ": a point has ", file.stride, " bytes, format ", format, " needs ", layout.bytes);
  const std::size_t size = file_size_of(path);
  if (file.begin > size || file.rows > (size - file.begin) / file.stride)
    fail(ErrorKind::content, path, ": cut off: the header announces ", file.rows, " points of ", file.stride,
         " bytes from byte ", file.begin, ", the file has ", size, " bytes; copy or export the file again");
  add_columns(start, layout, format < 6, file);
  file.withheld = format < 6 ? WithheldBit{layout.classification, 0x80} : WithheldBit{layout.classification - 1, 0x04};

  // The variable-length records between header and points.
  const std::string front = read_beginning(path, file.begin);
  const Bytes header{path, front};
  std::size_t at = header.at<std::uint16_t>(94);
  for (std::uint32_t left = header.at<std::uint32_t>(100); left > 0; --left) {
    const std::size_t length = header.at<std::uint16_t>(at + 20), begin = at + 54;
    header.text(at, 54 + length);
    if (header.text(at + 2, 16) == "LASF_Spec" && header.at<std::uint16_t>(at + 18) == 4)
      add_extra_columns(header, begin, length, layout.bytes, file);
    at = begin + length;
  }
  return file;
}

RawCloud read_las(const std::string& path, const ReadOptions& options) {
  const RowFile file = *find_las_rows(path);
  RawCloud raw;
  raw.path = path;
  raw.format = file.format;
  raw.meaning = file.meaning;
  raw.width = file.rows;
  for (const RowTable::Column& column : file.columns) raw.fields.push_back({column.name, name_of(column.type)});
  fill_cloud(raw, read_rows(file, 0, file.rows), options);
  return raw;
}

}  // namespace insonify
