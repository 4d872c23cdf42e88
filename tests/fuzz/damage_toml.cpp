// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/damage_toml.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace insonify {
namespace {

constexpr std::size_t most_bytes = 900'000;
constexpr const char* extremes[] = {"0",      "-0.0",   "1",     "-1",         "1e308", "-1e308",
                                    "1e-308", "5e-324", "nan",   "inf",        "-inf",  "1e9",
                                    "-1e9",   "1e-9",   "65535", "4294967296", "89.9",  "-89.99",
                                    "1e-16",  "100000", "180",   "0.5",        "1e5",   "9223372036854775807"};
constexpr std::size_t counts[] = {2, 3, 5, 10, 30, 60, 100, 300, 1000, 30'000};

using Lines = std::vector<std::string>;

template <typename Choices>
auto one_of(const Choices& choices, const DamageSource& source) {
  return choices[source.below(std::size(choices))];
}

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Replaces the numbers of a value; one of them, or all.
void make_extreme(std::string& line, const DamageSource& source) {
  constexpr const char *begins = "0123456789", *goes_on = "0123456789.eE+-";
  const std::size_t value = line.find('=');
  if (value == line.npos) return;
  const bool all = source.below(3) == 0;
  for (std::size_t at = line.find_first_of(begins, value); at != line.npos; at = line.find_first_of(begins, at)) {
    const std::size_t end = std::min(line.find_first_not_of(goes_on, at), line.size());
    const std::size_t sign = at > 0 && line[at - 1] == '-' ? 1 : 0;
    const std::string number = one_of(extremes, source);
    if (all || source.below(3) == 0) {
      line.replace(at - sign, end - at + sign, number);
      at += number.size() - sign;
    } else {
      at = end;
    }
  }
}

/// Repeats a table [[...]] of the text.
void repeat_table(Lines& lines, const DamageSource& source) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].starts_with("[[")) begins.push_back(i);
  if (begins.empty()) return;
  const std::size_t k = source.below(begins.size()), begin = begins[k];
  const Lines table(lines.begin() + static_cast<std::ptrdiff_t>(begin),
                    k + 1 < begins.size() ? lines.begin() + static_cast<std::ptrdiff_t>(begins[k + 1]) : lines.end());
  const std::size_t room = most_bytes / (text_of(table).size() + 10);
  const std::size_t count = std::min(one_of(counts, source), room);
  for (std::size_t copy = 1; copy < count; ++copy)
    for (std::string line : table) {
      if (const std::size_t end = line.rfind('"'); line.starts_with("name = ") && end != line.npos)
        line.insert(end, std::to_string(copy));
      lines.push_back(line);
    }
}

/// Repeats the entries of a list, as they are or each greater than those before it.
void repeat_entries(std::string& line, const DamageSource& source) {
  const std::size_t begin = line.rfind('['), end = line.find(']', begin == line.npos ? 0 : begin);
  if (line.find('=') == line.npos || begin == line.npos || end == line.npos || line.find('=') > begin) return;
  const std::string entries = line.substr(begin + 1, end - begin - 1);
  const std::size_t count = std::min(one_of(counts, source), most_bytes / (entries.size() + 10));
  const bool ascending = source.below(2) == 0;
  std::ostringstream more;
  for (std::size_t k = 1; k < count; ++k)
    if (ascending)
      more << ", " << 89.0 * static_cast<double>(k) / static_cast<double>(count);
    else
      more << ", " << entries;
  line.insert(end, more.str());
}

void swap_keys(Lines& lines, std::size_t a, std::size_t b) {
  const std::size_t end_a = lines[a].find('='), end_b = lines[b].find('=');
  if (end_a == std::string::npos || end_b == std::string::npos) return;
  const std::string key_a = lines[a].substr(0, end_a), key_b = lines[b].substr(0, end_b);
  lines[a].replace(0, end_a, key_b), lines[b].replace(0, end_b, key_a);
}

void damage_once(std::string& text, const DamageSource& source) {
  Lines lines = lines_of(text);
  if (lines.empty()) return;
  const std::size_t a = source.below(lines.size()), b = source.below(lines.size());
  switch (source.below(8)) {
    case 0:
      repeat_table(lines, source);
      break;
    case 1:
      repeat_entries(lines[a], source);
      break;
    case 2:
      swap_keys(lines, a, b);
      break;
    case 3:
      std::rotate(lines.begin() + static_cast<std::ptrdiff_t>(std::min(a, b)),
                  lines.begin() + static_cast<std::ptrdiff_t>(std::min(a, b) + 1),
                  lines.begin() + static_cast<std::ptrdiff_t>(std::max(a, b) + 1));
      break;
    default:
      make_extreme(lines[a], source);
  }
  if (std::string damaged = text_of(lines); damaged.size() < most_bytes) text = std::move(damaged);
}

}  // namespace

std::string damage_toml(const std::string& text, const DamageSource& source) {
  std::string damaged = text;
  for (std::size_t left = 1 + source.below(4); left > 0; --left) damage_once(damaged, source);
  return damaged;
}

}  // namespace insonify
