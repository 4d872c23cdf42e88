// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>

#include "core/error.hpp"
#include "scene_io/text_lines_internal.hpp"

namespace insonify {

std::string shown(std::string_view line) {
  std::string text(line.substr(0, 60));
  for (char& c : text) {
    if (!std::isprint(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128) c = '?';
  }
  return text + (line.size() > 60 ? "..." : "");
}

void check_number_rows(LineReader& lines, std::size_t rows, const std::vector<TextColumn>& columns,
                       const std::string& what, const std::string& path) {
  const bool lists = std::any_of(columns.begin(), columns.end(), [](const TextColumn& c) { return c.is_list; });
  std::string_view line, rest;
  // A missing word of a plain row is reported with both counts.
  const auto take = [&](NumberType type) {
    const std::string_view word = take_word(rest);
    double value = 0;
    if (word.empty() && !lists) return value;
    if (!to_number(word, value) || !fits(value, type))
      fail(ErrorKind::content, path, ":", lines.number(), ": expected a number in this ", what, " row that fits ",
           name_of(type), ", found '", shown(word), "'; correct the line, or export the file again if it is cut off");
    return value;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    if (!lines.next(line))
      fail(ErrorKind::content, path, ": cut off: the header announces ", rows, " ", what, " rows, found ", row,
           "; copy or export the file again");
    rest = line;
    for (const TextColumn& column : columns) {
      const double numbers = column.is_list ? take(NumberType::uint32) : 1;
      for (double i = 0; i < numbers; ++i) take(column.type);
    }
    const std::size_t found = lists ? 0 : count_words(line);
    if (lists ? !take_word(rest).empty() : found != columns.size())
      fail(ErrorKind::content, path, ":", lines.number(), ": expected ", columns.size(),
           lists ? " columns" : " numbers", " as the header says, found ", lists ? count_words(line) : found,
           " words in '", shown(line), "'; correct the line, or export the file again if it is cut off");
  }
}

}  // namespace insonify
