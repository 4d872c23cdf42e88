// SPDX-License-Identifier: BSD-3-Clause
#include "core/message.hpp"

#include <cctype>

namespace insonify {
namespace {

constexpr std::size_t most_quoted = 200, most_in_line = 2000;   // [bytes]
constexpr std::size_t longest_name = 255, longest_path = 4096;  // lengths in POSIX file systems [bytes]
constexpr std::size_t punctuation = 5;                          // characters beside a name in a message
constexpr std::string_view left_out = " ... ";

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Returns true if all names between slashes are short enough for a file system.
bool may_be_path(std::string_view word) {
  if (word.size() > longest_path) return false;
  while (true) {
    const std::size_t end = word.find('/');
    if (std::min(end, word.size()) > longest_name + punctuation) return false;
    if (end == word.npos) return true;
    word.remove_prefix(end + 1);
  }
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Shortens texts in single quotes, which messages put around texts of files and users. A quote between letters is an
/// apostrophe.
std::string with_short_quotes(const std::string& line) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t open = line.find('\''); open != line.npos; open = line.find('\'', open + 1)) {
    if (open < begin || (open > 0 && is_letter(line[open - 1]))) continue;
    std::size_t close = line.find('\'', open + 1);
    while (close != line.npos && close + 1 < line.size() && is_letter(line[close + 1]))
      close = line.find('\'', close + 1);
    if (close == line.npos) break;
    const std::string_view text = std::string_view(line).substr(open + 1, close - open - 1);
    result.append(line, begin, open + 1 - begin).append(may_be_path(text) ? std::string(text) : shortened(text));
    begin = close;
  }
  return result.append(line, begin);
}

/// Leaves out words in the middle until the others have at most most_in_line bytes; paths do not count.
std::string without_middle(const std::vector<std::string>& words) {
  const auto size_of = [](const std::string& word) { return word.size() > most_quoted ? 0 : word.size() + 1; };
  std::size_t begin = 0, end = words.size(), first = 0, last = 0;
  while (begin < end && first + size_of(words[begin]) <= most_in_line / 2) first += size_of(words[begin++]);
  while (begin < end && last + size_of(words[end - 1]) <= most_in_line / 2) last += size_of(words[--end]);
  const auto at = [&](std::size_t i) { return words.begin() + static_cast<std::ptrdiff_t>(i); };
  std::string line = joined(std::vector(words.begin(), at(begin)), " ");
  if (begin > 0 && begin < words.size()) line += begin < end ? left_out : " ";
  return line + joined(std::vector(at(end), words.end()), " ");
}

}  // namespace

std::string shortened(std::string_view text) {
  if (text.size() <= most_quoted) return std::string(text);
  constexpr std::size_t kept = (most_quoted - left_out.size()) / 2;
  constexpr int most_continued = 3;
  std::size_t end = kept, begin = text.size() - kept;
  for (int k = 0; k < most_continued && continues_character(text[end]); ++k) --end;
  for (int k = 0; k < most_continued && continues_character(text[begin]); ++k) ++begin;
  return std::string(text.substr(0, end)).append(left_out).append(text.substr(begin));
}

std::string message_line(std::string_view message) {
  std::string line(message);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
  line = with_short_quotes(line);
  std::vector<std::string> words;
  for (const std::string_view word : split_at(' ', line))
    words.push_back(may_be_path(word) ? std::string(word) : shortened(word));
  return without_middle(words);
}

}  // namespace insonify
