// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/meaning_override.hpp"
#include "store/toml_tree.hpp"

// The keys of TOML files as rows. Rows serve to read, check and write files, to read --set, and to test the tables of
// the docs. Rows are bound to the object that they read and write, and must not outlive it.
namespace insonify {

/// Access to a value. Setting it creates the optional part that holds it.
template <typename T>
struct Member {
  std::function<std::optional<T>()> get;  ///< nothing: files omit the key
  std::function<void(const T&)> set;

  /// Accesses a value by functions.
  Member(std::function<std::optional<T>()> getter, std::function<void(const T&)> setter)
      : get(std::move(getter)), set(std::move(setter)) {}
  /// Accesses an object of type T, of an optional T, or of a type that converts to T (a count is a number).
  template <typename Object>
  requires(!std::same_as<Object, Member>) Member(Object& object)
      : get([&object] { return std::optional<T>(object); }),
        set([&object](const T& value) { object = static_cast<Object>(value); }) {}
  /// Accesses a field of a part that may be absent.
  template <typename Part, typename Field>
  Member(std::optional<Part>& part, Field Part::*field)
      : get([&part, field] { return part ? std::optional<T>((*part).*field) : std::nullopt; }),
        set([&part, field](const T& value) {
          if (!part) part.emplace();
          (*part).*field = value;
        }) {}
};

/// Returns access to an object that files omit while it has its default: 0, or no text, or no entries.
template <typename T>
Member<T> given(T& object) {
  const auto get = [&object] { return object == T{} ? std::nullopt : std::optional<T>(object); };
  return {get, [&object](const T& value) { object = value; }};
}

/// The form of a value in files.
template <typename T>
struct Form {
  std::string rule;                                        ///< rule for values, as text: "a number > 0"
  std::function<std::optional<T>(const TomlValue&)> read;  ///< nothing: the value breaks the rule
  std::function<std::string(const T&)> write;              ///< TOML that reads back to the same bits
};

/// The value of a key: access and rule.
struct KeyValue {
  std::string rule;
  /// Sets the value; returns false if it breaks the rule. `path` is the path of the file, for relative paths in it.
  std::function<bool(const TomlValue& value, const std::string& path)> set;
  /// Returns the value as TOML; nothing if files omit the key.
  std::function<std::optional<std::string>()> text;
};

/// Returns the value at `member`, which files write in this form.
template <typename T>
KeyValue value_in(const Member<T>& member, const Form<T>& form) {
  const auto set = [=](const TomlValue& value, const std::string&) {
    const std::optional<T> read = form.read(value);
    if (read) member.set(*read);
    return read.has_value();
  };
  const auto text = [=] {
    const std::optional<T> value = member.get();
    return value ? std::optional(form.write(*value)) : std::nullopt;
  };
  return {form.rule, set, text};
}

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

/// Returns the keys as TOML, each section under its title.
std::string keys_as_toml(const std::vector<Key>& keys);

/// Returns "section.name" of all keys.
std::vector<std::string> names_of(const std::vector<Key>& keys);

/// The units of a number in files and in memory.
struct Scale {
  double (*from_file)(double);  ///< converts to the unit in memory
  double (*to_file)(double);    ///< converts to the unit of files
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

/// Rule for a list.
struct ListRule {
  std::size_t least = 1, most = std::numeric_limits<std::size_t>::max();  ///< limits of its length
  bool bare = false;                                                      ///< one entry may stand by itself
  bool ascending = false;                                                 ///< the last entry is not below the first
  const char* text = "";                                                  ///< the rule as text; "": that of an entry
};

/// Returns a number; `scale` converts between its units in files and in memory.
KeyValue number(const Member<double>& number, const NumberRule& rule = {}, const Scale& scale = as_it_is);
/// Returns an angle, which files state in degrees.
KeyValue angle(const Member<double>& angle, const NumberRule& rule = {});
/// Returns a list of numbers: `each` is the rule of a number, `rule` that of the list.
KeyValue list(const Member<std::vector<double>>& numbers, const NumberRule& each = {}, const Scale& scale = as_it_is,
              const ListRule& rule = {});
/// Returns a vector of three numbers; `meaning` is the rule as text.
KeyValue vector(const Member<Eigen::Vector3d>& vector, const char* meaning, const Scale& scale = as_it_is);
/// Returns a list of points of three coordinates each [m].
KeyValue points(const Member<std::vector<Eigen::Vector3d>>& points);
/// Returns the corners of a polygon, of two coordinates each [m].
KeyValue polygon(const Member<std::vector<Eigen::Vector2d>>& corners);
/// Returns a value that is true or false.
KeyValue flag(const Member<bool>& flag);
/// Returns a whole number of 64 bits.
KeyValue seed(const Member<std::uint64_t>& seed);
/// Returns a text for which `allowed` is true; `rule` states that condition.
KeyValue text(
    const Member<std::string>& text, const char* rule = "text in quotes",
    bool (*allowed)(const std::string&) = [](const std::string&) { return true; });
/// Returns the path of a file (path_named_in).
KeyValue path(const Member<std::string>& path);
/// Returns a list of texts, each of them one of `words` unless that is empty.
KeyValue texts(const Member<std::vector<std::string>>& texts, const std::vector<std::string>& words = {});
/// Returns an item of the meaning of a scene file: a text, or numbers where it is made of them. Setting it throws
/// Error(argument), in a file Error(content) with its line, for a text that it cannot be.
KeyValue meaning(MeaningOverride& meaning, const MeaningOption& item);
/// Returns one or more tables [[name]], which read_keys reads one by one.
KeyValue list_of_tables();
/// Returns a text that is one of `words`; any text if that is empty.
KeyValue word(const Member<std::string>& text, const std::vector<std::string>& words);
/// Returns a value whose text is one of a table of names.
template <typename Table, typename Value = std::remove_cvref_t<decltype(std::declval<Table&>()[0].value)>>
KeyValue word(const std::type_identity_t<Member<Value>>& value, const Table& table) {
  const auto read = [table](const TomlValue& from) -> std::optional<Value> {
    const Value* found = from.kind == TomlValue::Kind::text ? find_named(table, from.text) : nullptr;
    return found ? std::optional(*found) : std::nullopt;
  };
  const auto write = [table](const Value& of) { return as_toml(name_of(table, of)); };
  return value_in<Value>(
      value, {"one of " + joined(table, ", ", [](const auto& row) { return std::string(row.name); }), read, write});
}

/// Returns the value; `action` is called each time it is set.
KeyValue then(KeyValue value, const std::function<void()>& action);
/// Returns the value, which files omit while `condition` holds.
KeyValue omitted_if(KeyValue value, const std::function<bool()>& condition);

}  // namespace insonify
