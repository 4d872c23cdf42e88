// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "core/text.hpp"
#include "core/units.hpp"
#include "store/toml_tree_internal.hpp"

// Private to store and tool: the keys of TOML files as rows. The rows serve to read, check and write files, to read
// --set, and to make the tables of the docs. Rows are bound to the object that they read and write, and must not
// outlive it.
namespace insonify {

/// The value of a key: access and rule.
struct KeyValue {
  std::string rule;  ///< rule for values, as text: "a number > 0"
  /// Sets the value; returns false if it breaks the rule. `path` is the path of the file, for relative paths in it.
  std::function<bool(const TomlValue& value, const std::string& path)> set;
  /// Returns the value as TOML that reads back to the same bits; nothing if files omit the key.
  std::function<std::optional<std::string>()> text;
};

/// A key of a file.
struct Key {
  const char* section;  ///< table that holds it, "survey.anchor"; "": none
  const char* name;
  const char* unit;  ///< "": none
  KeyValue value;
  std::string help;
  bool required = false;
  const char* unless = "";  ///< name of an alternative key in the same section; a file must not hold both
};

/// Reads a table of a file, including the tables in it. Keys and tables in `others` are skipped. Throws Error(content)
/// "path:line: ..." for an unknown key (with the nearest known one), a missing key, or a value that breaks its rule.
void read_keys(const std::string& path, const TomlValue& table, const std::vector<Key>& keys,
               const std::string& section = "", const std::vector<std::string>& others = {});

/// Throws Error(content) unless the document says `schema = SCHEMA`.
void require_schema(const std::string& path, const TomlValue& document, int schema);

/// Sets the key "section.name" from the text of a command line: a number, a list as "-10, 0, 10", or a word. Throws
/// Error(argument), its text after `who`, for an unknown key or a value that breaks its rule.
void set_key(const std::vector<Key>& keys, const std::string& name, const std::string& text, const std::string& who);

/// Sets the key from the first of `values` that obeys the rule. Several values are possible readings of one text, which
/// may mean a list, for example.
void set_key(const std::vector<Key>& keys, const std::string& name, const std::vector<TomlValue>& values,
             const std::string& who);

/// The keys as TOML, each section under its title.
std::string keys_as_toml(const std::vector<Key>& keys);

/// The keys as rows of a table in Markdown: key, unit, default, rule, help.
std::string keys_as_markdown(const std::vector<Key>& keys);

/// "section.name" of all keys.
std::vector<std::string> names_of(const std::vector<Key>& keys);

/// The units of a number in files and in memory.
struct Scale {
  double (*from_file)(double);
  double (*to_file)(double);
};
/// Returns the degrees with the shortest text that reads back to the same radians.
double shortest_degrees(double angle);
inline constexpr Scale as_it_is{[](double x) { return x; }, [](double x) { return x; }};
inline constexpr Scale in_degrees{radians, shortest_degrees};
inline constexpr Scale in_decibels{power_from_db, db_from_power};

/// Rule for a number, in the unit of files.
struct NumberRule {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false;     ///< `least` itself is refused
  bool whole = false;     ///< no fraction
  bool infinite = false;  ///< infinity and NaN are numbers too
  const char* note = "";  ///< reason or remedy
};
inline constexpr NumberRule positive{.least = 0, .above = true}, not_negative{.least = 0};

/// A number of an object.
struct Number {
  std::function<std::optional<double>()> get;
  std::function<void(double)> set;
};
template <typename T>
Number at(T& x) {
  return {[&x] { return static_cast<double>(x); }, [&x](double value) { x = static_cast<T>(value); }};
}
template <typename T>
Number at(std::optional<T>& x) {
  return {[&x]() -> std::optional<double> { return x; }, [&x](double value) { x = value; }};
}
/// A number of a part that may be absent; setting it makes the part present.
template <typename Part, typename Field>
Number at(std::optional<Part>& part, Field Part::*field) {
  return {
      [&part, field]() -> std::optional<double> { return part ? std::optional<double>((*part).*field) : std::nullopt; },
      [&part, field](double value) {
        if (!part) part.emplace();
        (*part).*field = value;
      }};
}

KeyValue number(const Number& number, const NumberRule& rule = {}, const Scale& scale = as_it_is);
KeyValue list(std::vector<double>& numbers, const NumberRule& rule = {}, const Scale& scale = as_it_is);
KeyValue vector(Eigen::Vector3d& vector, const char* meaning, const Scale& scale = as_it_is);
KeyValue points(std::vector<Eigen::Vector3d>& points);
KeyValue flag(bool& flag);
KeyValue seed(std::uint64_t& seed);
/// Text for which `allowed` returns true; `rule` states the condition.
KeyValue text(
    std::string& text, const char* rule = "text in quotes",
    bool (*allowed)(const std::string&) = [](const std::string&) { return true; });
/// The path of a file (path_named_in).
KeyValue path(std::string& path);
/// Texts, each of them one of `words` unless there are none.
KeyValue texts(std::vector<std::string>& texts, const std::vector<std::string>& words = {});
/// One table [[name]] or more, which read_keys reads one by one.
KeyValue list_of_tables();
/// One of a list of words; any text if there are none.
KeyValue word(std::string& text, const std::vector<std::string>& words);
/// One of a table of names. `Value` is the type of the table's values, or an optional of it.
template <typename Value, typename Table>
KeyValue word(Value& value, const Table& table) {
  const auto set = [&](const TomlValue& from, const std::string&) {
    const auto* found = from.kind == TomlValue::Kind::text ? find_named(table, from.text) : nullptr;
    if (found) value = *found;
    return found != nullptr;
  };
  const auto text = [&]() -> std::optional<std::string> {
    const std::string name = name_of(table, value);
    return name.empty() ? std::nullopt : std::optional(as_toml(name));
  };
  return {"one of " + joined(table, ", ", [](const auto& row) { return std::string(row.name); }), set, text};
}

/// The value; each time it is set, `action` is called.
KeyValue then(KeyValue value, const std::function<void()>& action);
/// The value, which files omit while `condition` holds.
KeyValue omitted_if(KeyValue value, const std::function<bool()>& condition);

}  // namespace insonify
