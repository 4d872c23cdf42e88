// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/error.hpp"

namespace insonify {

/// A value of a TOML document with its line number.
struct TomlValue {
  /// The type of a value.
  enum class Kind { boolean, integer, number, text, array, table, date };
  Kind kind = Kind::table;
  int line = 1;
  double number = 0;                ///< value of a boolean (0, 1), integer or number
  std::string text{};               ///< value of a text
  std::vector<TomlValue> items{};   ///< entries of an array or table
  std::vector<std::string> keys{};  ///< keys of a table: keys[i] names items[i]

  /// Returns true for a number, with or without a fraction.
  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
  /// Returns the value of `key`, or nullptr.
  const TomlValue* find(const std::string& key) const;
};

/// Reads a TOML document. Throws Error(file) if it is missing, Error(content) "path:line: ..." if it is not TOML.
TomlValue load_toml(const std::string& path);

/// Throws Error(content) "path:line: ...".
template <typename... Parts>
[[noreturn]] void fail_in_file(const std::string& path, int line, const Parts&... parts) {
  fail(ErrorKind::content, path, ":", line, ": ", parts...);
}

/// Runs `body`. What it refuses becomes Error(content) "path:line: ..." with its text after `begin`.
template <typename Body>
void at_line(const std::string& path, int line, const Body& body, const char* begin = "") {
  try {
    body();
  } catch (const Error& error) {
    fail_in_file(path, line, begin, error.what());
  }
}

/// Returns a text as TOML, with quotes and escapes.
std::string as_toml(const std::string& text);
/// Returns a number as TOML, with the fewest digits that read back to the same bits.
std::string as_toml(double number);
/// Returns a list of numbers as TOML, each with the fewest digits that read back to the same bits.
std::string as_toml(const std::vector<double>& numbers);
/// Returns a value as TOML; a table as a list of its keys in braces, for messages.
std::string as_toml(const TomlValue& value);

/// Returns the text of a key. Throws Error(content) with the line if it is missing or of another type.
std::string toml_text(const std::string& path, const TomlValue& table, const std::string& key);
/// Returns the number of a key. Throws as toml_text.
double toml_number(const std::string& path, const TomlValue& table, const std::string& key);

/// Returns the path of a file that `file` names: unchanged if it exists or is absolute, else beside `file` or in the
/// folder above if it exists there, else unchanged.
std::string path_named_in(const std::string& file, const std::string& path);

}  // namespace insonify
