#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/toml_tree_internal.hpp"

// Private to store: tables of mission files, each key a row that says what it sets.
namespace insonify {

/// A value of the file, with what an error must name.
struct MissionEntry {
  const std::string& path;
  const char* key;
  const TomlValue& value;

  template <typename... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    fail_in_file(path, value.line, key, parts...);
  }
  std::string text() const {
    if (value.kind != TomlValue::Kind::text) refuse(" must be text in quotes");
    return value.text;
  }
  std::string file_path() const { return path_named_in(path, text()); }
  double number() const {
    if (!value.is_number()) refuse(" must be a number");
    return value.number;
  }
  double positive() const {
    if (!(number() > 0 && std::isfinite(number()))) refuse(" = ", number(), ", must be finite and > 0");
    return number();
  }
  double not_negative() const {
    if (!(number() >= 0 && std::isfinite(number()))) refuse(" = ", number(), ", must be finite and at least 0");
    return number();
  }
  double angle() const { return radians(number()); }
  bool flag() const {
    if (value.kind != TomlValue::Kind::boolean) refuse(" must be true or false");
    return value.number != 0;
  }
  std::uint64_t seed() const {
    const bool whole = value.kind == TomlValue::Kind::integer && value.number >= 0 && value.number < 0x1p53;
    std::uint64_t seed = static_cast<std::uint64_t>(whole ? value.number : 0);
    if (!whole && !(value.kind == TomlValue::Kind::text && to_number(value.text, seed)))
      refuse(" must be an integer from 0, in quotes from 2^53");
    return seed;
  }
  /// A list, member by member.
  template <typename Member>
  auto list(Member member) const {
    if (value.kind != TomlValue::Kind::array) refuse(" must be a list");
    std::vector<std::decay_t<decltype(member(*this))>> members;
    for (const TomlValue& item : value.items) members.push_back(member(MissionEntry{path, key, item}));
    return members;
  }
  Eigen::Vector3d vector() const {
    const std::vector<double> v = list(&MissionEntry::number_of);
    if (v.size() != 3) refuse(" has ", v.size(), " numbers, must have three");
    return {v[0], v[1], v[2]};
  }
  static double number_of(const MissionEntry& entry) { return entry.number(); }
  static std::string text_of(const MissionEntry& entry) { return entry.text(); }
  static Eigen::Vector3d vector_of(const MissionEntry& entry) { return entry.vector(); }

  /// One of a table of words.
  template <typename Table>
  auto word(const Table& table) const {
    const auto* found = find_named(table, text());
    if (!found)
      refuse(" = '", text(), "', must be one of ",
             joined(table, ", ", [](const auto& row) { return std::string(row.name); }));
    return *found;
  }
};

/// A key of a table and what it sets.
template <typename Object>
using MissionKey = std::pair<const char*, std::function<void(const MissionEntry&, Object&)>>;

template <typename Object>
void read_table(const MissionEntry& table, const std::vector<MissionKey<Object>>& keys, Object& object) {
  if (table.value.kind != TomlValue::Kind::table) table.refuse(" must be a table, with keys and values of its own");
  std::vector<std::string> known;
  for (const auto& [name, set] : keys) known.emplace_back(name);
  require_known_keys(table.path, table.value, known);
  for (const auto& [name, set] : keys)
    if (const TomlValue* value = table.value.find(name)) set({table.path, name, *value}, object);
}

/// Adds file and line to what `body` refuses.
template <typename Body>
void at_line(const std::string& path, int line, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    fail_in_file(path, line, error.what());
  }
}

/// The table with what it takes from the table [template.NAME] that its key `template` names: the keys that it lacks. Throws
/// Error(content) if there is no such template.
TomlValue with_template(const std::string& path, const TomlValue& document, const TomlValue& table);

}  // namespace insonify
