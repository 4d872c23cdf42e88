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

void check_number_rows(LineReader& lines, std::size_t rows, const std::vector<NumberType>& columns,
                       const std::string& what, const std::string& path) {
  std::string_view line;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!lines.next(line))
      fail(ErrorKind::content, path, ": cut off: the header announces ", rows, " ", what, " rows, found ", row,
           "; copy or export the file again");
    std::string_view rest = line;
    for (const NumberType type : columns) {
      const std::string_view word = take_word(rest);
      double value = 0;
      // A missing word is reported with both counts.
      if (!word.empty() && (!to_number(word, value) || !fits(value, type)))
        fail(ErrorKind::content, path, ":", lines.number(), ": expected a number in this ", what, " row that fits ",
             name_of(type), ", found '", shown(word), "'; correct the line, or export the file again if it is cut off");
    }
    if (const std::size_t found = count_words(line); found != columns.size())
      fail(ErrorKind::content, path, ":", lines.number(), ": expected ", columns.size(),
           " numbers as the header says, found ", found, " words in '", shown(line),
           "'; correct the line, or export the file again if it is cut off");
  }
}

}  // namespace insonify
