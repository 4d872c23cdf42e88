#include "core/error.hpp"
#include "scene_io/file_probe.hpp"
#include "scene_io/pcl_rows_internal.hpp"
#include "scene_io/raw_cloud.hpp"
#include "scene_io/text_lines.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <pcl/io/pcd_io.h>

namespace insonify {
namespace {

struct Field {
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
};

struct Header {
  std::string path;
  std::vector<Field> fields;
  std::size_t width = 0, height = 1, points = 0;
  std::vector<double> viewpoint = {0, 0, 0, 1, 0, 0, 0};  ///< position, quaternion w x y z
  std::string data;
  SceneTags tags;
  std::size_t end = 0, lines = 0;  ///< [bytes] and lines up to the data

  std::size_t stride() const {
    std::size_t bytes = 0;
    for (const Field& f : fields) bytes += f.size * f.count;
    return bytes;
  }
};

[[noreturn]] void bad_header(const Header& header, const std::string& found, const char* expected) {
  fail(ErrorKind::content, header.path, ":", header.lines, ": the PCD header says '", shown(found),
       "', expected ", expected, "; export the file again");
}

template <typename T>
T header_number(const Header& header, const std::string& word) {
  T value = 0;
  if (!to_number(word, value)) bad_header(header, word, "a number");
  return value;
}

void read_header_line(Header& header, const std::vector<std::string>& words, const std::string& line) {
  const std::string& key = words[0];
  const std::size_t n = words.size() - 1;
  const bool per_field = key == "SIZE" || key == "TYPE" || key == "COUNT";
  if (per_field && n != header.fields.size()) bad_header(header, line, "one entry per field");
  if (n == 0) bad_header(header, line, "a value after the key word");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& word = words[i + 1];
    if (key == "FIELDS" || key == "COLUMNS") header.fields.push_back({word});
    if (key == "SIZE") header.fields[i].size = header_number<std::size_t>(header, word);
    if (key == "TYPE") header.fields[i].type = word[0];
    if (key == "COUNT") header.fields[i].count = header_number<std::size_t>(header, word);
    if (key == "VIEWPOINT" && i < 7) header.viewpoint[i] = header_number<double>(header, word);
  }
  if (key == "WIDTH") header.width = header_number<std::size_t>(header, words[1]);
  if (key == "HEIGHT") header.height = header_number<std::size_t>(header, words[1]);
  if (key == "POINTS") header.points = header_number<std::size_t>(header, words[1]);
  if (key == "DATA") header.data = words[1];
}

NumberType type_of(const Header& header, const Field& field) {
  for (const NumberType type : {NumberType::int8, NumberType::uint8, NumberType::int16, NumberType::uint16,
                                NumberType::int32, NumberType::uint32, NumberType::int64, NumberType::uint64,
                                NumberType::float32, NumberType::float64}) {
    const char letter = type >= NumberType::float32 ? 'F' : name_of(type)[0] == 'u' ? 'U' : 'I';
    if (letter == field.type && size_of(type) == field.size) return type;
  }
  bad_header(header, field.name + " of type " + field.type + " and size " + std::to_string(field.size),
             "type F, I or U of size 1, 2, 4 or 8");
}

void check_header(Header& header) {
  if (header.fields.empty()) bad_header(header, "DATA before FIELDS", "FIELDS x y z");
  for (const Field& field : header.fields) {
    if (field.name != "_") type_of(header, field);
    if (field.size > 8 || field.count > 1000000) bad_header(header, field.name, "a size of 1, 2, 4 or 8");
  }
  if (header.width > (1ull << 40) || header.height > (1ull << 20))
    bad_header(header, "WIDTH or HEIGHT", "less than 2^40");
  const std::size_t cells = header.width * header.height;
  if (header.points == 0) header.points = cells;
  if (cells != 0 && cells != header.points) {
    bad_header(header, "POINTS " + std::to_string(header.points), "WIDTH times HEIGHT");
  }
  if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed") {
    bad_header(header, "DATA " + header.data, "DATA ascii, binary or binary_compressed");
  }
}

Header read_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Header header;
  header.path = path;
  std::string line;
  while (std::getline(file, line)) {
    ++header.lines;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0][0] == '#') {
      if (line.size() > 2) read_tag(path, std::string_view(line).substr(2), header.tags);
      continue;
    }
    static const char* keys[] = {"VERSION", "FIELDS", "COLUMNS", "SIZE",      "TYPE", "COUNT",
                                 "WIDTH",   "HEIGHT", "POINTS",  "VIEWPOINT", "DATA"};
    if (std::find(std::begin(keys), std::end(keys), words[0]) == std::end(keys)) {
      if (header.fields.empty()) {
        fail(ErrorKind::content, path,
             ": not a PCD file: expected header lines VERSION, FIELDS, ... DATA, found ",
             what_it_looks_like(path), "; plain columns of numbers are read from a .xyz, .txt or .csv file");
      }
      bad_header(header, line,
                 "VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS or DATA");
    }
    read_header_line(header, words, line);
    if (words[0] == "DATA") {
      header.end = static_cast<std::size_t>(file.tellg());
      check_header(header);
      return header;
    }
  }
  fail(ErrorKind::content, path,
       ": cut off inside the PCD header: expected a DATA line, found the end after ", header.lines,
       " lines; copy or export the file again");
}

[[noreturn]] void cut_off(const Header& header, std::size_t expected, std::size_t found) {
  fail(ErrorKind::content, header.path, ": cut off: the header announces ", header.points, " points, ",
       expected, " bytes of data, the file holds ", found, "; copy or export the file again");
}

/// Byte counts of the compressed block against the file and the header, before PCL unpacks it.
void check_compressed(const Header& header) {
  const std::size_t held = file_size_of(header.path) - header.end;
  if (held < 8) cut_off(header, 8, held);
  std::ifstream file(header.path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(header.end));
  std::uint32_t sizes[2] = {0, 0};
  file.read(reinterpret_cast<char*>(sizes), 8);
  if (held - 8 < sizes[0]) cut_off(header, sizes[0], held - 8);
  if (sizes[1] != header.points * header.stride()) {
    fail(ErrorKind::content, header.path, ": the header announces ", header.points * header.stride(),
         " bytes of points, the compressed block ", sizes[1], "; export the file again");
  }
}

void read_compressed(const Header& header, RawCloud& raw, const ReadOptions& options) {
  check_compressed(header);
  const QuietPcl quiet;
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  int result = -1;
  try {
    result = pcl::PCDReader().read(header.path, cloud, origin, orientation, version);
  } catch (const std::exception&) {
    result = -1;
  }
  if (result < 0 ||
      cloud.data.size() != static_cast<std::size_t>(cloud.width) * cloud.height * cloud.point_step) {
    fail(ErrorKind::content, header.path,
         ": PCL cannot unpack the compressed points; the file is damaged: copy or "
         "export it again");
  }
  raw.fields.clear();
  fill_cloud(raw, table_of(cloud, raw), options);
}

/// Columns of the header's fields: packed as in the file, or as doubles one after the other for text.
std::vector<RowTable::Column> columns_of(const Header& header, bool text) {
  std::vector<RowTable::Column> columns;
  std::size_t at = 0;
  for (const Field& field : header.fields) {
    if (field.name != "_")
      columns.push_back({field.name, text ? NumberType::float64 : type_of(header, field), at});
    at += (text ? 8 : field.size) * field.count;
  }
  return columns;
}

void read_plain(const Header& header, RawCloud& raw, const ReadOptions& options) {
  const std::size_t held = file_size_of(header.path) - header.end;
  if (header.data == "ascii") {
    if (header.points > held) cut_off(header, header.points, held);
    std::size_t numbers = 0;
    for (const Field& f : header.fields) numbers += f.count;
    const std::string text = read_whole_file(header.path);
    LineReader lines(std::string_view(text).substr(header.end), header.lines);
    RowTable table = table_of_doubles(std::vector<std::string>(numbers, ""),
                                      read_number_rows(lines, header.points, numbers, header.path));
    table.columns = columns_of(header, true);
    fill_cloud(raw, table, options);
    return;
  }
  const std::size_t stride = header.stride();
  if (stride == 0 || header.points > held / stride) cut_off(header, header.points * stride, held);
  RowTable table = table_in_file(header.path, header.end, header.points, stride);
  table.columns = columns_of(header, false);
  fill_cloud(raw, table, options);
}

}  // namespace

RawCloud read_pcd(const std::string& path, const ReadOptions& options) {
  const Header header = read_header(path);
  RawCloud raw;
  raw.path = path;
  raw.format = "PCD " + header.data;
  raw.tags = header.tags;
  for (const Field& f : header.fields) {
    if (f.name != "_") raw.fields.push_back({f.name, name_of(type_of(header, f))});
  }
  raw.width = header.width;
  raw.height = header.height;
  // The identity pose is what writers put when they know nothing.
  if (header.viewpoint != std::vector<double>{0, 0, 0, 1, 0, 0, 0}) {
    raw.viewpoint = Eigen::Vector3d(header.viewpoint[0], header.viewpoint[1], header.viewpoint[2]);
  }
  if (header.data == "binary_compressed")
    read_compressed(header, raw, options);
  else
    read_plain(header, raw, options);
  return raw;
}

RowTable table_of(const pcl::PCLPointCloud2& cloud, RawCloud& raw) {
  static const NumberType types[] = {NumberType::int8,    NumberType::uint8,  NumberType::int16,
                                     NumberType::uint16,  NumberType::int32,  NumberType::uint32,
                                     NumberType::float32, NumberType::float64};
  RowTable table;
  table.stride = cloud.point_step;
  table.rows = static_cast<std::size_t>(cloud.width) * cloud.height;
  table.swap_bytes = cloud.is_bigendian != 0;
  if (table.rows * table.stride > cloud.data.size()) {
    fail(ErrorKind::content, raw.path, ": width x height x point_step = ", table.rows * table.stride,
         " bytes, the cloud holds ", cloud.data.size(), "; fill the cloud completely");
  }
  if (cloud.height > 1 && cloud.row_step != cloud.width * cloud.point_step) {
    fail(ErrorKind::content, raw.path, ": row_step = ", cloud.row_step,
         ", must be width x point_step = ", cloud.width * cloud.point_step, "; pack the rows");
  }
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name == "_" || field.datatype < 1 || field.datatype > 8) continue;
    const NumberType type = types[field.datatype - 1];
    if (field.offset + size_of(type) > table.stride) {
      fail(ErrorKind::content, raw.path, ": field '", field.name, "' ends beyond point_step = ", table.stride,
           " bytes; correct its offset");
    }
    table.columns.push_back({field.name, type, field.offset});
    raw.fields.push_back({field.name, name_of(type)});
  }
  raw.width = cloud.width;
  raw.height = cloud.height;
  table.fetch = [&cloud](std::size_t first, std::size_t, std::vector<char>&) {
    return reinterpret_cast<const char*>(cloud.data.data()) + first * cloud.point_step;
  };
  return table;
}

}  // namespace insonify
