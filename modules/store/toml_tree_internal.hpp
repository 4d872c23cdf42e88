// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/error.hpp"

namespace insonify {

/// A value of a TOML document with its line number.
struct TomlValue {
  enum class Kind { boolean, integer, number, text, array, table, date };
  Kind kind = Kind::table;
  int line = 1;
  double number = 0;                ///< of boolean (0, 1), integer, number
  std::string text{};               ///< of text
  std::vector<TomlValue> items{};   ///< of array and table
  std::vector<std::string> keys{};  ///< of table: keys[i] names items[i]

  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
  /// The value of `key`, or nullptr.
  const TomlValue* find(const std::string& key) const;
};

/// Reads a TOML document. Throws Error(file) if missing, Error(content) "path:line: ..." if it is not TOML.
TomlValue load_toml(const std::string& path);

/// Throws Error(content) "path:line: ...".
template <typename... Parts>
[[noreturn]] void fail_in_file(const std::string& path, int line, const Parts&... parts) {
  fail(ErrorKind::content, path, ":", line, ": ", parts...);
}

/// A value as TOML: text with quotes and escapes, numbers with the fewest digits that read back to the same bits.
std::string as_toml(const std::string& text);
std::string as_toml(double number);
std::string as_toml(const std::vector<double>& numbers);
std::string as_toml(const TomlValue& value);

/// The text or number of a key; throws Error(content) with the line if it is missing or of another type.
std::string toml_text(const std::string& path, const TomlValue& table, const std::string& key);
double toml_number(const std::string& path, const TomlValue& table, const std::string& key);

/// A path named in `file`: as it is if it exists or is absolute, else beside the file or in the folder above, else as
/// it is.
std::string path_named_in(const std::string& file, const std::string& path);

}  // namespace insonify
