// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/text_lines_internal.hpp"

namespace insonify {
namespace {

char delimiter_of(std::string_view line) {
  if (line.find(';') != line.npos) return ';';
  return line.find(',') != line.npos ? ',' : ' ';
}

constexpr std::size_t most_columns = 4096;

/// The first most_columns + 1 cells of a line; an empty cell after the last delimiter does not count.
void split(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  if (delimiter == ' ') {
    for (std::string_view word = take_word(line); !word.empty() && cells.size() <= most_columns; word = take_word(line))
      cells.push_back(word);
    return;
  }
  while (cells.size() <= most_columns) {
    const std::size_t end = std::min(line.find(delimiter), line.size());
    cells.push_back(trimmed(line.substr(0, end), " \t\""));
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
  }
  if (cells.back().empty()) cells.pop_back();
}

bool is_comment(std::string_view line) { return line.rfind("#", 0) == 0 || line.rfind("//", 0) == 0; }

/// Column names if the line, comment marks aside, names x, y and z.
std::vector<std::string> names_in(std::string_view line) {
  while (!line.empty() && (line.front() == '#' || line.front() == '/' || line.front() == ' ')) line.remove_prefix(1);
  std::vector<std::string_view> cells;
  split(line, delimiter_of(line), cells);
  std::vector<std::string> names;
  for (const std::string_view cell : cells) names.push_back(lower_case(std::string(cell)));
  for (const char* axis : {"x", "y", "z"}) {
    if (std::find(names.begin(), names.end(), axis) == names.end()) return {};
  }
  return names;
}

struct TextRows {
  std::vector<std::string> names;  ///< from a header line; empty if there is none
  std::vector<double> numbers;
  std::size_t columns = 0, announced = 0;  ///< announced: by a first line that holds one whole number
};

void add_row(TextRows& rows, const std::vector<std::string_view>& cells, const std::string& path, std::size_t line,
             std::string_view text) {
  for (const std::string_view cell : cells) {
    double value = 0;
    if (!to_number(cell, value))
      fail(ErrorKind::content, path, ":", line, ": '", shown(cell), "' in '", shown(text),
           "' is not a number; expected columns x y z ..., with a decimal point, separated by blanks, commas "
           "or "
           "semicolons, and names in the first line only");
    rows.numbers.push_back(value);
  }
}

TextRows read_rows(const std::string& path, const std::string& text) {
  TextRows rows;
  LineReader lines(text);
  std::string_view line;
  std::vector<std::string_view> cells;
  char delimiter = ' ';
  while (lines.next_filled(line)) {
    if (lines.number() == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.remove_prefix(3);
    if (rows.columns == 0 && rows.names.empty()) {
      rows.names = names_in(line);
      if (!rows.names.empty()) continue;
    }
    if (is_comment(line)) continue;
    if (rows.columns == 0) delimiter = delimiter_of(line);
    split(line, delimiter, cells);
    if (cells.size() > most_columns)
      fail(ErrorKind::content, path, ":", lines.number(), ": holds more than ", most_columns,
           " columns; give one point a line");
    if (rows.columns == 0) {
      const bool may_be_count = cells.size() == 1 && rows.announced == 0 && rows.names.empty();
      if (may_be_count && to_number(cells[0], rows.announced)) continue;
      rows.columns = rows.names.empty() ? cells.size() : rows.names.size();
    }
    if (cells.size() != rows.columns || cells.size() < 3)
      fail(ErrorKind::content, path, ":", lines.number(), ": expected ", std::max<std::size_t>(rows.columns, 3),
           " columns (x y z ...), found ", cells.size(), " in '", shown(line),
           "'; correct the line, or export the file again if it is cut off");
    add_row(rows, cells, path, lines.number(), line);
  }
  return rows;
}

/// True if columns 4 to 6 hold unit vectors in every row, within 2 %.
bool has_unit_vectors(const TextRows& rows) {
  if (rows.columns < 6 || rows.numbers.empty()) return false;
  for (std::size_t at = 0; at < rows.numbers.size(); at += rows.columns) {
    const double norm = std::hypot(rows.numbers[at + 3], rows.numbers[at + 4], rows.numbers[at + 5]);
    if (!(std::abs(norm - 1) < 0.02)) return false;
  }
  return true;
}

}  // namespace

RawCloud read_text_cloud(const std::string& path, const ReadOptions& options) {
  const std::string text = read_whole_file(path);
  if (text.find('\0') != text.npos)
    fail(ErrorKind::content, path, ": not a text file: expected columns x y z, found ", what_it_looks_like(path),
         "; give the file the extension of its format");
  TextRows rows = read_rows(path, text);
  RawCloud raw;
  raw.path = path;
  raw.format = "text";
  if (rows.columns == 0)
    fail(ErrorKind::content, path, ": holds no point; expected lines 'x y z', found ", what_it_looks_like(path));
  const std::size_t found = rows.numbers.size() / rows.columns;
  if (rows.announced > found)
    fail(ErrorKind::content, path, ": cut off: the first line announces ", rows.announced, " points, found ", found,
         "; copy or export the file again");
  // Without names: x y z, then a normal if it is one; what else there may be is not guessed.
  if (rows.names.empty()) {
    rows.names = {"x", "y", "z"};
    if (has_unit_vectors(rows)) rows.names.insert(rows.names.end(), {"nx", "ny", "nz"});
    if (rows.names.size() < rows.columns)
      raw.notes.push_back("columns after " + rows.names.back() +
                          " were ignored: name them in a first line, e.g. 'x y z nx ny nz area label'");
    rows.names.resize(rows.columns, "ignored");
  }
  for (const std::string& name : rows.names) raw.fields.push_back({name, "text"});
  raw.width = found;
  fill_cloud(raw, table_of_doubles(rows.names, std::move(rows.numbers)), options);
  return raw;
}

}  // namespace insonify
