// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace insonify {

/// Returns the text with its ASCII letters in lower case.
inline std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// Returns the text without `blanks` at either end.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r") {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Returns the words between the separators of a text; one word if it has none.
inline std::vector<std::string_view> split_at(char separator, std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(separator, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
  }
  return words;
}

/// Returns the texts that `text_of` gives for the members of a list, with `separator` between them.
template <typename List, typename TextOf = std::identity>
std::string joined(const List& list, const char* separator = ", ", TextOf text_of = {}) {
  std::string text;
  const char* before = "";
  for (const auto& member : list) text.append(before).append(std::invoke(text_of, member)), before = separator;
  return text;
}

/// Returns true and sets `value` if the whole word is one number; nan and inf are numbers, and a leading + is allowed.
template <typename Number>
bool to_number(std::string_view word, Number& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// Returns the number, if the whole word is one finite number.
inline std::optional<double> finite_number(std::string_view word) {
  double value = 0;
  return to_number(word, value) && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Returns numbers in the format of printf; at most 199 characters.
template <typename... Numbers>
std::string printed(const char* format, Numbers... numbers) {
  char text[200];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// An entry of a table of names.
template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};

/// Returns a pointer to the value of the entry called `name`; null if there is none.
template <typename Table>
const auto* find_named(const Table& table, std::string_view name) {
  const auto found =
      std::find_if(std::begin(table), std::end(table), [&](const auto& entry) { return entry.name == name; });
  return found == std::end(table) ? nullptr : &found->value;
}

/// Returns the name of `value`; empty if the table does not hold it.
template <typename Table, typename Value>
std::string name_of(const Table& table, const Value& value) {
  for (const auto& entry : table)
    if (entry.value == value) return std::string(entry.name);
  return {};
}

}  // namespace insonify
