#include "scene_io/text_lines.hpp"

#include "core/error.hpp"

#include <cctype>

namespace insonify {

std::string shown(std::string_view line) {
  std::string text(line.substr(0, 60));
  for (char& c : text) {
    if (!std::isprint(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128) c = '?';
  }
  return text + (line.size() > 60 ? "..." : "");
}

std::vector<double> read_number_rows(LineReader& lines, std::size_t rows, std::size_t columns,
                                     const std::string& path) {
  std::vector<double> numbers;
  numbers.reserve(rows * columns);
  std::string_view line;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!lines.next_filled(line)) {
      fail(ErrorKind::content, path, ": cut off: the header announces ", rows, " points, found ", row,
           "; copy or export the file again");
    }
    std::string_view rest = line;
    std::size_t found = 0;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest), ++found) {
      double value = 0;
      if (!to_number(word, value)) {
        fail(ErrorKind::content, path, ":", lines.number(), ": '", shown(word),
             "' is not a number; correct the line");
      }
      if (found < columns) numbers.push_back(value);
    }
    if (found != columns) {
      fail(ErrorKind::content, path, ":", lines.number(), ": expected ", columns,
           " numbers as the header says, found ", found, " in '", shown(line),
           "'; correct the line, or export the file again if it is cut off");
    }
  }
  return numbers;
}

}  // namespace insonify
