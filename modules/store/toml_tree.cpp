// SPDX-License-Identifier: BSD-3-Clause
#include "store/toml_tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <boost/algorithm/string/replace.hpp>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "core/text.hpp"
#include "files/path_status.hpp"
#include "store/run_directory.hpp"

namespace insonify {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

TomlValue copied(const toml::node& node) {
  TomlValue value;
  value.line = line_of(node);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      value.keys.emplace_back(key.str());
      value.items.push_back(copied(child));
    }
  } else if (const toml::array* array = node.as_array()) {
    value.kind = TomlValue::Kind::array;
    for (const toml::node& child : *array) value.items.push_back(copied(child));
  } else if (const auto* text = node.as_string()) {
    value.kind = TomlValue::Kind::text;
    value.text = text->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = TomlValue::Kind::number;
    value.number = number->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = TomlValue::Kind::integer;
    value.number = static_cast<double>(integer->get());
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = TomlValue::Kind::boolean;
    value.number = boolean->get() ? 1 : 0;
  } else {
    value.kind = TomlValue::Kind::date;
  }
  return value;
}

const TomlValue& required(const std::string& path, const TomlValue& table, const std::string& key) {
  const TomlValue* value = table.find(key);
  if (!value) fail_in_file(path, table.line, "missing key '", key, "'");
  return *value;
}

/// Throws Error(content) for a key of very many parts, because the parser calls itself for each.
void require_shallow_keys(const std::string& path, const std::string& text) {
  constexpr std::ptrdiff_t most = 64;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto end = std::find(line.begin(), line.end(), '=');
    if (std::count(line.begin(), end, '.') > most && line.find_first_of("\"'#") == std::string::npos)
      fail_in_file(path, number, "key of more than ", most, " parts");
  }
}

}  // namespace

const TomlValue* TomlValue::find(const std::string& key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key) return &items[i];
  return nullptr;
}

TomlValue load_toml(const std::string& path) {
  const std::string text = read_text_file(path);
  require_shallow_keys(path, text);
  try {
    return copied(toml::parse(text));
  } catch (const toml::parse_error& error) {
    fail_in_file(path, static_cast<int>(error.source().begin.line), error.description());
  }
}

std::string as_toml(const std::string& text) {
  // JSON has the escapes of TOML, but writes DEL as it is, which TOML refuses.
  const std::string quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return boost::replace_all_copy(quoted, "\x7f", "\\u007f");
}

std::string as_toml(double number) {
  const double size = std::abs(number);
  const bool everyday = number == 0 || (size >= 1e-5 && size < 1e15);
  std::array<char, 40> text{};
  const auto format = everyday ? std::chars_format::fixed : std::chars_format::scientific;
  std::string digits(text.begin(), std::to_chars(text.begin(), text.end(), number, format).ptr);
  if (digits.find_first_not_of("-0123456789") == std::string::npos) digits += ".0";
  return digits;
}

std::string as_toml(const std::vector<double>& numbers) {
  return "[" + joined(numbers, ", ", [](double x) { return as_toml(x); }) + "]";
}

std::string as_toml(const TomlValue& value) {
  using Kind = TomlValue::Kind;
  switch (value.kind) {
    case Kind::boolean:
      return value.number != 0 ? "true" : "false";
    case Kind::integer:
      return printed("%.0f", value.number);
    case Kind::number:
      return as_toml(value.number);
    case Kind::text:
      return as_toml(value.text);
    case Kind::array:
      return "[" + joined(value.items, ", ", [](const TomlValue& item) { return as_toml(item); }) + "]";
    case Kind::table:
      return "{" + joined(value.keys) + "}";
    case Kind::date:
      break;
  }
  return "a date";
}

std::string toml_text(const std::string& path, const TomlValue& table, const std::string& key) {
  const TomlValue& value = required(path, table, key);
  if (value.kind != TomlValue::Kind::text) fail_in_file(path, value.line, key, " must be text in quotes");
  return value.text;
}

double toml_number(const std::string& path, const TomlValue& table, const std::string& key) {
  const TomlValue& value = required(path, table, key);
  if (!value.is_number()) fail_in_file(path, value.line, key, " must be a number");
  return value.number;
}

std::string path_named_in(const std::string& file, const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty() || path_exists(path) || fs::path(path).is_absolute()) return path;
  const fs::path folder = fs::path(file).parent_path();
  for (const fs::path& start : {folder, folder.parent_path()})
    if (path_exists(start / path)) return (start / path).string();
  return path;
}

}  // namespace insonify
