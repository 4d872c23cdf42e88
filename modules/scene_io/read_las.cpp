// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "files/binary_file.hpp"
#include "files/input_file.hpp"
#include "scene_io/coordinate_system_internal.hpp"
#include "scene_io/row_file_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// Reads LAS 1.0 to 1.4 (ASPRS, LAS Specification 1.4 R15): a header, variable-length records, and points as rows of
// packed numbers, which a LAZ has compressed. The records that are read describe extra bytes or the coordinate system.
namespace insonify {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS numbers are read as they lie in the file");

/// A part of a file that is read with checks of its bounds.
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

/// The fields at the begin of all points, by the point data record format.
struct PointFormat {
  std::size_t bytes;           ///< size of a record without extra bytes
  std::size_t classification;  ///< offset of the class
  std::size_t gps_time, red;   ///< offsets; 0: absent
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

void add_extra_columns(const Bytes& header, std::size_t begin, std::size_t length, std::size_t offset, RowFile& file) {
  constexpr std::size_t description = 192, scaled = 8, shifted = 16;
  for (std::size_t at = begin; at + description <= begin + length; at += description) {
    const auto type = header.at<std::uint8_t>(at + 2), options = header.at<std::uint8_t>(at + 3);
    if (type == 0) {
      offset += options;  // as many bytes without a meaning as the options say
      continue;
    }
    // Types from 11 on are pairs and triples of these types; later ones have no length.
    const unsigned kind = (type - 1u) % 10, count = (type - 1u) / 10 + 1;
    const std::string name = header.text(at + 4, 32);
    if (count > 3) {
      file.notes.push_back("extra bytes '" + name + "' are of the unknown type " + std::to_string(type) +
                           ": they and those behind them were skipped");
      return;
    }
    for (unsigned k = 0; k < count; ++k) {
      RowTable::Column column{count == 1 ? name : name + "_" + "xyz"[k], extra_types[kind], offset};
      if (options & scaled) column.scale = header.at<double>(at + 112 + 8 * k);
      if (options & shifted) column.shift = header.at<double>(at + 136 + 8 * k);
      offset += size_of(column.type);
      if (offset > file.stride)
        fail(ErrorKind::content, file.path, ": extra bytes '", name, "' end beyond a point of ", file.stride,
             " bytes; export the file again");
      file.columns.push_back(column);
    }
  }
}

void add_columns(const Bytes& header, const PointFormat& format, bool low_bits, RowFile& file) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    file.columns.push_back({std::string(1, static_cast<char>('x' + axis)), NumberType::int32, 4 * axis,
                            header.at<double>(131 + 8 * axis), header.at<double>(155 + 8 * axis)});
  file.columns.push_back({"intensity", NumberType::uint16, 12});
  file.columns.push_back({"classification", NumberType::uint8, format.classification});
  file.columns.back().mask = low_bits ? 0x1f : 0xff;  // the other bits are flags
  if (format.gps_time > 0) file.columns.push_back({"gps_time", NumberType::float64, format.gps_time});
  if (format.red == 0) return;
  for (std::size_t k = 0; k < 3; ++k)
    file.columns.push_back({std::array{"red", "green", "blue"}[k], NumberType::uint16, format.red + 2 * k});
}

constexpr std::size_t most_record = 1 << 16;  // largest extended record that is read [bytes]

/// Reads the variable-length records between header and points, and after the points.
SystemRecords read_records(const PointFormat& format, RowFile& file) {
  SystemRecords system;
  const auto take = [&](const Bytes& bytes, std::size_t at, std::size_t begin, std::size_t length) {
    const std::string user = bytes.text(at + 2, 16);
    const auto number = bytes.at<std::uint16_t>(at + 18);
    if (length > 0) bytes.at<char>(begin + length - 1);
    if (user == "LASF_Spec" && number == 4) add_extra_columns(bytes, begin, length, format.bytes, file);
    if (user != "LASF_Projection") return;
    for (const auto& [wanted, record] :
         {std::pair{2112, &system.wkt}, {34735, &system.keys}, {34736, &system.numbers}, {34737, &system.texts}})
      if (number == wanted) *record = bytes.all.substr(begin, length);
  };
  const std::string front = read_beginning(file.path, file.begin);
  const Bytes header{file.path, front};
  std::size_t at = header.at<std::uint16_t>(94);
  for (std::uint32_t left = header.at<std::uint32_t>(100); left > 0; --left) {
    const std::size_t length = header.at<std::uint16_t>(at + 20);
    header.text(at, 54);
    take(header, at, at + 54, length);
    at += 54 + length;
  }
  // LAS 1.4 has extended records, too.
  if (header.at<std::uint8_t>(25) < 4) return system;
  const BinaryFile all(file.path, BinaryFile::Mode::read);
  const std::size_t size = file_size_of(file.path);
  std::uint64_t next = header.at<std::uint64_t>(235);
  for (std::uint32_t left = header.at<std::uint32_t>(243); left > 0 && next > 0 && next < size; --left) {
    std::string record(60, '\0');
    const Bytes extended{file.path, record};
    if (size - next < record.size()) break;
    all.read(next, std::span(record));
    const auto length = extended.at<std::uint64_t>(20);
    if (length > size - next - record.size()) break;
    if (length <= most_record) {
      record.resize(60 + static_cast<std::size_t>(length));
      all.read(next, std::span(record));
      take(extended, 0, 60, static_cast<std::size_t>(length));
    }
    next += 60 + length;
  }
  return system;
}

/// Returns the command for coordinates in degrees, with the zone of the middle of the file.
std::string project_remedy(const Bytes& header) {
  const auto middle = [&](std::size_t at) { return 0.5 * (header.at<double>(at) + header.at<double>(at + 8)); };
  const std::string code = utm_code(middle(179), middle(195));
  return "export it in a projected system such as EPSG:" + code +
         ", or as text of x y z, and project that: gdaltransform -s_srs EPSG:4326 -t_srs EPSG:" + code +
         " < in.xyz > out.xyz";
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
    fail(ErrorKind::content, path, ": is LAS ", major, ".", minor, ", expected 1.0 to 1.4; export it as one of these");
  // The upper bits say that the points are packed.
  const unsigned announced = start.at<std::uint8_t>(104), format = announced & 0x3f;
  const bool packed = announced != format;
  if (packed && *laz_remedy) fail(ErrorKind::content, path, ": its points are compressed (LAZ); ", laz_remedy);
  if (format >= point_formats.size())
    fail(ErrorKind::content, path, ": point data record format ", format,
         ", expected 0 to 10; export it in one of these");
  const PointFormat& layout = point_formats[format];

  RowFile file;
  file.path = path;
  file.packed = packed;
  file.format = std::string(packed ? "LAZ " : "LAS ") + std::to_string(major) + "." + std::to_string(minor) +
                ", point format " + std::to_string(format);
  file.begin = start.at<std::uint32_t>(96);
  file.stride = start.at<std::uint16_t>(105);
  const std::uint64_t many = minor >= 4 ? start.at<std::uint64_t>(247) : 0;
  file.rows = many > 0 ? many : start.at<std::uint32_t>(107);
  if (file.stride < layout.bytes)
    fail(ErrorKind::content, path, ": a point has ", file.stride, " bytes, format ", format, " needs ", layout.bytes);
  const std::size_t size = file_size_of(path);
  if (file.begin > size || (!packed && file.rows > (size - file.begin) / file.stride))
    fail(ErrorKind::content, path, ": cut off: the header announces ", file.rows, " points of ", file.stride,
         " bytes from byte ", file.begin, ", the file has ", size, " bytes; copy or export the file again");
  add_columns(start, layout, format < 6, file);
  const bool old = format < 6;
  const std::size_t at = layout.classification;
  file.marks = old ? RowMarks{at, at, 0x80, 0x1f} : RowMarks{at - 1, at, 0x04, 0xff};
  file.meaning.classes.value.reset(7).reset(18);
  if (format == 4 || format == 5 || format >= 9) file.notes.push_back("the waveforms of its points are not read");

  const SystemRecords system = read_records(layout, file);
  take_system(path, system, project_remedy(start), file.meaning);
  return file;
}

RawCloud read_las(const std::string& path, const ReadOptions& options) {
  const RowFile file = *find_las_rows(path);
  RawCloud raw = raw_of(file);
  fill_cloud(raw, all_rows(file), options);
  return raw;
}

}  // namespace insonify
