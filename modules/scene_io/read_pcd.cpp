// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <fstream>

#include <pcl/io/lzf.h>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "files/read_apart.hpp"
#include "scene_io/row_file_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// Reads PCD without PCL 1.13, which takes words that are not numbers, and rows of a wrong length, without a message.
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
  std::size_t end = 0, lines = 0;  ///< offset of the data [bytes], and lines before it

  std::size_t stride() const {
    std::size_t bytes = 0;
    for (const Field& f : fields) bytes += f.size * f.count;
    return bytes;
  }
};

[[noreturn]] void bad_header(const Header& header, const std::string& found, const char* expected) {
  fail(ErrorKind::content, header.path, ":", header.lines, ": the PCD header says '", shown(found), "', expected ",
       expected, "; export the file again");
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
  const char* const kind = field.type == 'F' ? "float" : field.type == 'I' ? "int" : field.type == 'U' ? "uint" : "";
  if (const auto type = type_named(kind + std::to_string(8 * field.size))) return *type;
  bad_header(header, field.name + " of type " + field.type + " and size " + std::to_string(field.size),
             "type F, I or U of size 1, 2, 4 or 8");
}

void check_header(const Header& header) {
  if (header.fields.empty()) bad_header(header, "DATA before FIELDS", "FIELDS x y z");
  for (const Field& field : header.fields) {
    if (field.name != "_") type_of(header, field);
    if (field.size > 8 || field.count > 1000000) bad_header(header, field.name, "a size of 1, 2, 4 or 8");
    if (field.count == 0) bad_header(header, field.name + " with COUNT 0", "at least one number per field");
  }
  if (header.width > (1ull << 40) || header.height > (1ull << 20))
    bad_header(header, "WIDTH or HEIGHT", "less than 2^40");
  const std::size_t cells = header.width * header.height;
  if (cells != 0 && cells != header.points)
    bad_header(header, "POINTS " + std::to_string(header.points), "WIDTH times HEIGHT");
  if (header.points == 0) fail(ErrorKind::content, header.path, ": holds no point; export the cloud again");
  if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
    bad_header(header, "DATA " + header.data, "DATA ascii, binary or binary_compressed");
}

Header read_pcd_header(const std::string& path) {
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
      if (header.fields.empty())
        fail(ErrorKind::content, path, ": not a PCD file: expected header lines VERSION, FIELDS, ... DATA, found ",
             what_it_looks_like(path), "; plain columns of numbers are read from a .xyz, .txt or .csv file");
      bad_header(header, line, "VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS or DATA");
    }
    read_header_line(header, words, line);
    if (words[0] == "DATA") {
      header.end = file.eof() ? file_size_of(path) : static_cast<std::size_t>(file.tellg());
      check_header(header);
      return header;
    }
  }
  fail(ErrorKind::content, path, ": cut off inside the PCD header: expected a DATA line, found the end after ",
       header.lines, " lines; copy or export the file again");
}

[[noreturn]] void cut_off(const Header& header, std::size_t expected, std::size_t found) {
  fail(ErrorKind::content, header.path, ": cut off: the header announces ", header.points, " points, ", expected,
       " bytes of data, the file holds ", found, "; copy or export the file again");
}

// LZF writes at most 264 bytes for three bytes.
constexpr std::uint32_t lzf_most = 88;

/// Compares the sizes of the compressed block with the file and the header. Throws Error(content) if they differ.
void check_compressed(const Header& header, std::size_t held) {
  // Writers differ in whether the block has padding fields: refuse them.
  if (std::any_of(header.fields.begin(), header.fields.end(), [](const Field& f) { return f.name == "_"; }))
    fail(ErrorKind::content, header.path, ": compressed points with padding fields '_' cannot be read; export them as ",
         "DATA binary or DATA ascii, or without these fields");
  if (held < 8) cut_off(header, 8, held);
  const std::string sizes = read_beginning(header.path, header.end + 8).substr(header.end);
  const auto packed = read_as<std::uint32_t>(sizes.data()), unpacked = read_as<std::uint32_t>(sizes.data() + 4);
  if (held - 8 < packed) cut_off(header, packed, held - 8);
  const double announced = static_cast<double>(header.points) * static_cast<double>(header.stride());
  if (announced != static_cast<double>(unpacked))
    fail(ErrorKind::content, header.path, ": the header announces ", announced,
         " bytes of points, the compressed block ", unpacked, "; export the file again");
  if (unpacked / lzf_most > packed)
    fail(ErrorKind::content, header.path, ": announces ", unpacked, " bytes of points in a compressed block of ",
         packed, ", which holds at most ", lzf_most, " times its size; copy or export the file again");
}

/// Throws Error(content) if the file has fewer data than its header announces.
void check_data(const Header& header) {
  const std::size_t held = file_size_of(header.path) - header.end, stride = header.stride();
  if (header.data == "ascii") {
    // A number takes two bytes with the blank after it. read_text_rows() finds the row that lacks numbers.
    std::size_t row = 0;
    for (const Field& f : header.fields) row += 2 * f.count;
    if (header.points > held || row > held + 1) cut_off(header, std::max(header.points, row), held);
  } else if (header.data == "binary_compressed") {
    check_compressed(header, held);
  } else if (stride == 0 || header.points > held / stride) {
    cut_off(header, header.points * stride, held);
  }
}

/// Returns points of text as the rows of a binary file, whose padding is 0.
std::shared_ptr<const std::string> read_text_rows(const Header& header) {
  struct Number {
    NumberType type;
    std::size_t padding;  ///< bytes of padding in place of a number
  };
  std::vector<Number> columns;
  for (const Field& f : header.fields)
    columns.resize(columns.size() + f.count,
                   f.name == "_" ? Number{NumberType::float64, f.size} : Number{type_of(header, f), 0});
  const std::string text = read_whole_file(header.path);
  LineReader lines(std::string_view(text).substr(header.end), header.lines);
  std::string_view line;
  std::string rows;
  const auto refuse = [&](const auto&... what) {
    fail(ErrorKind::content, header.path, ":", lines.number(), ": expected ", what...,
         "'; correct the line, or export the file again if it is cut off");
  };
  for (std::size_t row = 0; row < header.points; ++row) {
    if (!lines.next(line))
      fail(ErrorKind::content, header.path, ": cut off: the header announces ", header.points, " point rows, found ",
           row, "; copy or export the file again");
    std::string_view rest = line;
    for (const auto& [type, padding] : columns) {
      const std::string_view word = take_word(rest);
      double value = 0;
      // Leave a missing word to the message with both counts below.
      if (!word.empty() && (!to_number(word, value) || !fits(value, type)))
        refuse("a number in this point row that fits ", name_of(type), ", found '", shown(word));
      rows.append(padding, '\0');
      if (padding == 0) append_number(rows, type, value);
    }
    if (const std::size_t found = count_words(line); found != columns.size())
      refuse(columns.size(), " numbers as the header says, found ", found, " words in '", shown(line));
  }
  return std::make_shared<const std::string>(std::move(rows));
}

/// The points of a compressed block, where they stand field by field, as rows.
std::shared_ptr<const std::string> unpacked_rows(const Header& header, std::size_t checked_bytes) {
  const std::string bytes = read_whole_file(header.path);
  if (bytes.size() != checked_bytes)
    fail(ErrorKind::content, header.path, ": changed while it was read; wait until it is complete");
  const char* const packed = bytes.data() + header.end + 8;
  const std::size_t stride = header.stride();
  std::string fields(header.points * stride, '\0'), rows(fields.size(), '\0');
  const auto size = static_cast<unsigned>(fields.size());
  if (pcl::lzfDecompress(packed, read_as<std::uint32_t>(packed - 8), fields.data(), size) != size)
    fail(ErrorKind::content, header.path, ": PCL cannot unpack the compressed points; the file is damaged: copy or ",
         "export it again");
  const char* from = fields.data();
  std::size_t offset = 0;
  for (const Field& field : header.fields) {
    const std::size_t length = field.size * field.count;
    for (std::size_t i = 0; i < header.points; ++i, from += length)
      std::copy_n(from, length, &rows[i * stride + offset]);
    offset += length;
  }
  return std::make_shared<const std::string>(std::move(rows));
}

std::optional<Eigen::Vector3d> viewpoint_of(const Header& header) {
  // Writers put the identity pose if they know none.
  if (header.viewpoint == std::vector<double>{0, 0, 0, 1, 0, 0, 0}) return std::nullopt;
  return Eigen::Vector3d(header.viewpoint[0], header.viewpoint[1], header.viewpoint[2]);
}

/// Returns the layout of the rows of a binary file, or the function that reads those of another file.
RowFile row_file(const Header& header) {
  RowFile file{header.path, "PCD binary", {},          header.points,       header.stride(),
               header.end,  false,        header.tags, viewpoint_of(header)};
  std::size_t offset = 0;
  for (const Field& field : header.fields) {
    if (field.name != "_") file.columns.push_back({field.name, type_of(header, field), offset});
    offset += field.size * field.count;
  }
  return file;
}

}  // namespace

RawCloud read_pcd(const std::string& path, const ReadOptions& options) {
  const Header header = read_pcd_header(path);
  const std::size_t bytes = file_size_of(path), stride = header.stride();
  check_data(header);
  RowFile file = row_file(header);
  file.format = "PCD " + header.data;
  RawCloud raw = raw_of(file);
  if (header.width * header.height != 0) raw.width = header.width, raw.height = header.height;
  if (header.data == "binary") {
    fill_cloud(raw, all_rows(file), options);
  } else {
    const bool text = header.data == "ascii";
    if (!text) expect_from_file(path, bytes, {static_cast<double>(header.points * stride), "bytes of points", 1});
    const auto rows = text ? read_text_rows(header) : unpacked_rows(header, bytes);
    fill_cloud(raw, {file.columns, header.points, stride, rows->data(), rows}, options);
  }
  return raw;
}

std::optional<RowFile> find_pcd_rows(const std::string& path) {
  const Header header = read_pcd_header(path);
  if (header.data != "binary") return std::nullopt;
  check_data(header);
  return row_file(header);
}

}  // namespace insonify
