// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/column_names_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

/// Reads a number with a point or a comma before its decimals, and an exponent after E or D.
bool to_real(std::string_view cell, double& value, bool& comma) {
  if (to_number(cell, value)) return true;
  std::string text(cell);
  const std::size_t at = text.find(',');
  if (at != text.npos) text[at] = '.';
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  if (std::count(text.begin(), text.end(), '.') > 1 || !to_number(text, value)) return false;
  comma = comma || at != text.npos;
  return true;
}

char delimiter_of(std::string_view line) {
  if (line.find(';') != line.npos) return ';';
  if (line.find(',') == line.npos) return ' ';
  // Commas are decimal commas if the words between blanks are numbers.
  double value = 0;
  bool comma = false;
  for (int k = 0; k < 3; ++k)
    if (!to_real(take_word(line), value, comma)) return ',';
  return ' ';
}

constexpr std::size_t most_columns = 4096;

/// Splits a line into its first most_columns + 1 cells; an empty cell after the last delimiter does not count.
void split(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  if (delimiter == ' ') {
    for (std::string_view word = take_word(line); !word.empty() && cells.size() <= most_columns; word = take_word(line))
      cells.push_back(trimmed(word, "\""));
    return;
  }
  while (cells.size() <= most_columns) {
    const std::size_t quoted = line.substr(0, 1) == "\"" ? line.find('"', 1) : 0;
    const std::size_t end = std::min(line.find(delimiter, quoted == line.npos ? 0 : quoted), line.size());
    cells.push_back(trimmed(line.substr(0, end), " \t\""));
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
  }
  if (cells.back().empty()) cells.pop_back();
}

bool is_comment(std::string_view line) {
  return line.starts_with("#") || line.starts_with("//") || line.starts_with("%");
}

/// Returns the names in a line without its comment marks. With `marks`, delimiters within quotes and brackets count as
/// letters, and so do blanks before brackets.
std::vector<std::string> names_in(std::string_view line, char delimiter, bool marks) {
  line.remove_prefix(std::min(line.find_first_not_of("#/% \t"), line.size()));
  std::vector<std::string> names(1);
  bool quoted = false;
  int depth = 0;
  for (std::size_t i = 0; i < line.size() && names.size() <= most_columns; ++i) {
    const char c = line[i];
    quoted = quoted != (marks && c == '"');
    depth += !marks ? 0 : c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    const std::size_t next = std::min(line.find_first_not_of(' ', i), line.size() - 1);
    const bool unit = marks && c == ' ' && (line[next] == '(' || line[next] == '[');
    if (c != delimiter || quoted || depth > 0 || unit) {
      if (c != '"') names.back() += c;
    } else if (c != ' ' || !names.back().empty()) {
      names.emplace_back();
    }
  }
  for (std::string& name : names) name = std::string(trimmed(name, " \t"));
  return names;
}

struct TextRows {
  std::vector<std::vector<std::string>> headings;  ///< possible names in the line of column names; empty without one
  std::vector<std::string> names;
  std::vector<double> numbers;
  std::size_t columns = 0, announced = 0;  ///< announced: number of points in a line that holds one whole number
  bool list = false, comma = false;  ///< list: more numbers may follow the columns; comma: a number has a decimal comma

  std::size_t count() const { return columns == 0 ? 0 : numbers.size() / columns; }
};

/// Reads the names of a line before the first row. Returns true if they name the coordinates; throws for other names.
bool take_names(std::string_view line, const std::string& where, TextRows& rows) {
  std::vector<std::string> first;
  for (const char delimiter : {';', '\t', ',', ' '}) {
    if (line.find(delimiter) == line.npos) continue;
    for (const bool marks : {true, false}) {
      std::vector<std::string> names = names_in(line, delimiter, marks);
      if (first.empty()) first = names;
      if (name_coordinates(names)) rows.headings.push_back(std::move(names));
    }
  }
  if (!rows.headings.empty()) return true;
  const auto is_word = [](const std::string& name) {
    double value = 0;
    bool comma = false;
    return !to_real(name, value, comma);
  };
  if (first.size() > 1 && !is_comment(line) && std::all_of(first.begin(), first.end(), is_word))
    find_columns(table_of_doubles(first, {}), where, "");  // throws, because coordinates are missing
  return false;
}

/// Chooses the names of the columns by the first row, which has `cells` numbers.
void choose_columns(TextRows& rows, std::size_t cells) {
  rows.columns = cells;
  if (rows.headings.empty()) return;
  for (std::vector<std::string>& names : rows.headings)
    if (names.size() == cells + 1 && names.back().empty()) names.pop_back();
  // A list at the end, such as the tracks of COLMAP, has any length.
  rows.names = rows.headings.front();
  rows.list = rows.names.size() != cells && rows.names.back().find("[]") != std::string::npos;
  const auto found = std::find_if(rows.headings.begin(), rows.headings.end(),
                                  [&](const std::vector<std::string>& names) { return names.size() == cells; });
  if (rows.list)
    rows.names.pop_back();
  else if (found != rows.headings.end())
    rows.names = *found;
  for (std::string& name : rows.names)
    if (is_legal_name(name)) name = lower_case(name);
  rows.columns = rows.names.size();
}

void add_row(TextRows& rows, const std::vector<std::string_view>& cells, const std::string& path, std::size_t line,
             std::string_view text) {
  for (std::size_t k = 0; k < rows.columns; ++k) {
    double value = 0;
    if (!to_real(cells[k], value, rows.comma))
      fail(ErrorKind::content, path, ":", line, ": '", shown(cells[k]), "' in '", shown(text),
           "' is not a number; expected columns x y z ..., separated by blanks, commas or semicolons, and names in the "
           "first line only");
    rows.numbers.push_back(value);
  }
}

TextRows read_rows(const std::string& path, const std::string& text) {
  TextRows rows;
  LineReader lines(text);
  std::string_view line;
  std::vector<std::string_view> cells;
  char delimiter = ' ';
  const auto where = [&] { return path + ":" + std::to_string(lines.number()); };
  while (lines.next_filled(line)) {
    if (lines.number() == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.remove_prefix(3);
    if (rows.columns == 0 && rows.headings.empty() && take_names(line, where(), rows)) continue;
    if (is_comment(line)) continue;
    if (rows.columns == 0) delimiter = delimiter_of(line);
    split(line, delimiter, cells);
    if (cells.size() > most_columns)
      fail(ErrorKind::content, where(), ": holds more than ", most_columns, " columns; give one point a line");
    std::size_t announced = 0;
    if (cells.size() == 1 && rows.count() == rows.announced && to_number(cells[0], announced)) {
      rows.announced += announced;
      continue;
    }
    if (rows.columns == 0) choose_columns(rows, cells.size());
    if (cells.size() < rows.columns || (cells.size() > rows.columns && !rows.list) || cells.size() < 3)
      fail(ErrorKind::content, where(), ": expected ", std::max<std::size_t>(rows.columns, 3),
           " columns (x y z ...), found ", cells.size(), " in '", shown(line),
           "'; correct the line, or export the file again if it is cut off");
    add_row(rows, cells, path, lines.number(), line);
  }
  return rows;
}

/// Returns true if columns 4 to 6 hold unit vectors in every row, within 2 %.
bool has_unit_vectors(const TextRows& rows) {
  if (rows.columns < 6 || rows.numbers.empty()) return false;
  for (std::size_t at = 0; at < rows.numbers.size(); at += rows.columns) {
    const double norm = std::hypot(rows.numbers[at + 3], rows.numbers[at + 4], rows.numbers[at + 5]);
    if (!(std::abs(norm - 1) < 0.02)) return false;
  }
  return true;
}

/// Names the columns of a file without a heading: x y z, then a normal if it is one; in points of a scanner (.pts)
/// intensity and colour. Other columns are not guessed.
void name_columns(const std::string& path, TextRows& rows, RawCloud& raw) {
  rows.names = {"x", "y", "z"};
  const bool scanner = extension_of(path) == ".pts";
  if (scanner && (rows.columns == 4 || rows.columns == 7)) rows.names.push_back("intensity");
  if (scanner && (rows.columns == 6 || rows.columns == 7))
    rows.names.insert(rows.names.end(), {"red", "green", "blue"});
  else if (has_unit_vectors(rows))
    rows.names.insert(rows.names.end(), {"nx", "ny", "nz"});
  if (rows.names.size() < rows.columns)
    raw.notes.push_back("columns after " + rows.names.back() +
                        " were ignored: name them in a first line, e.g. 'x y z nx ny nz area label'");
  rows.names.resize(rows.columns, "ignored");
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
  const std::size_t found = rows.count();
  if (rows.announced > found)
    fail(ErrorKind::content, path, ": cut off: the first line announces ", rows.announced, " points, found ", found,
         "; copy or export the file again");
  if (rows.headings.empty()) name_columns(path, rows, raw);
  if (rows.comma) raw.notes.push_back("commas within numbers were taken as decimal points");
  for (const std::string& name : rows.names) raw.fields.push_back({name, "text"});
  raw.width = found;
  fill_cloud(raw, table_of_doubles(rows.names, std::move(rows.numbers)), options);
  return raw;
}

}  // namespace insonify
