// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"

namespace insonify {

/// Iterates over the lines of a text, without the mark of UTF-8 before them; lines end with LF or CR LF.
class LineReader {
 public:
  /// lines_before   lines of the file before the text
  explicit LineReader(std::string_view text, std::size_t lines_before = 0) : rest_(text), number_(lines_before) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }

  /// Takes the next line; returns false at the end of the text.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return true;
  }
  /// Takes the next line that is not blank.
  bool next_filled(std::string_view& line) {
    while (next(line)) {
      if (line.find_first_not_of(" \t") != std::string_view::npos) return true;
    }
    return false;
  }
  /// Returns the number of the current line in its file, from 1.
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_;
};

/// Removes the next word from the front of `rest` and returns it; empty at the end.
inline std::string_view take_word(std::string_view& rest) {
  const std::size_t begin = std::min(rest.find_first_not_of(" \t"), rest.size());
  rest.remove_prefix(begin);
  const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
  const std::string_view word = rest.substr(0, end);
  rest.remove_prefix(end);
  return word;
}

/// Returns the words of a line.
inline std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) words.emplace_back(word);
  return words;
}

/// Returns the number of words of a line.
inline std::size_t count_words(std::string_view line) {
  std::size_t words = 0;
  while (!take_word(line).empty()) ++words;
  return words;
}

/// Returns an excerpt of a line for a message: at most 60 characters, control characters as '?'.
std::string shown(std::string_view line);

}  // namespace insonify
