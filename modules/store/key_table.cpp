// SPDX-License-Identifier: BSD-3-Clause
#include "store/key_table.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/message.hpp"
#include "store/nearest_word.hpp"

namespace insonify {
namespace {

using Kind = TomlValue::Kind;

std::string full_name(const std::string& section, const std::string& name) {
  return section.empty() ? name : section + "." + name;
}

std::string full_name(const Key& key) { return full_name(key.section, key.name); }

const Key* find_key(const std::vector<Key>& keys, const std::string& name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return full_name(key) == name; });
  return found == keys.end() ? nullptr : &*found;
}

/// Returns true if a table holds keys, or tables that hold keys.
bool is_section(const std::vector<Key>& keys, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
    const std::string section = key.section;
    return section == name || section.starts_with(name + ".");
  });
}

/// Returns "unknown key ..." or "unknown table ..." with the nearest name, or with all names if none is near.
std::string refusal_of_unknown(const std::vector<Key>& keys, const std::string& name, bool is_table = false) {
  std::vector<std::string> known = names_of(keys);
  if (is_table) {
    std::ranges::transform(keys, known.begin(), &Key::section);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    std::erase(known, "");
    if (known.empty()) return refusal_of_unknown(keys, name);
  }
  std::string near = nearest_word(name, known);
  // Prefer the same key of another section to a key with another name.
  for (const Key& key : keys)
    if (near.empty() && !is_table && key.name == name.substr(name.rfind('.') + 1)) near = full_name(key);
  const std::string open = is_table ? "[" : "'", close = is_table ? "]" : "'";
  return (is_table ? "unknown table " : "unknown key ") + open + shortened(name) + close +
         (!near.empty() ? "; did you mean " + open + near + close + "?"
          : is_table ? "; known are " + shortened_list(known, " ", [](const std::string& of) { return "[" + of + "]"; })
                     : "; known are " + shortened_list(known));
}

std::string refusal_of_value(const Key& key, const TomlValue& value) {
  const std::string unit = value.is_number() && *key.unit ? std::string(" ") + key.unit : "";
  return full_name(key) + " = " + shortened(as_toml(value)) + unit + ", must be " + key.value.rule;
}

/// Returns the values that a text of the command line may mean, the likeliest first.
std::vector<TomlValue> values_of_text(const std::string& text) {
  std::string bare = text;
  std::ranges::replace_if(
      bare, [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream words(bare);
  TomlValue list{.kind = Kind::array};
  TomlValue as_text{.kind = Kind::text, .text = text};
  for (std::string word; words >> word;)
    if (TomlValue& number = list.items.emplace_back(TomlValue{.kind = Kind::number}); !to_number(word, number.number))
      return {as_text};
  if (list.items.empty()) return {as_text};
  if (list.items.size() == 1 && text.find_first_of("[,") == std::string::npos) return {list.items[0], list, as_text};
  return {list, as_text};
}

}  // namespace

void read_keys(const std::string& path, const TomlValue& table, const std::vector<Key>& keys,
               const std::string& section, const std::vector<std::string>& others) {
  if (table.kind != Kind::table)
    fail_in_file(path, table.line, section, " = ", shortened(as_toml(table)), ", must be a table with keys of its own");
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const std::string name = full_name(section, table.keys[i]);
    const TomlValue& item = table.items[i];
    if (std::ranges::find(others, table.keys[i]) != others.end()) continue;
    if (is_section(keys, name))
      read_keys(path, item, keys, name);
    else if (!find_key(keys, name))
      fail_in_file(path, item.line, refusal_of_unknown(keys, name, item.kind == Kind::table));
  }
  for (const Key& key : keys) {
    if (key.section != section) continue;
    const TomlValue *found = table.find(key.name), *instead = table.find(key.unless);
    if (found && instead)
      fail_in_file(path, found->line, full_name(key), " follows from ", key.unless, "; leave it out");
    if (!found && !instead && key.required)
      fail_in_file(path, table.line, "missing key '", full_name(key), "'",
                   *key.unless ? std::string(" (or '") + key.unless + "')" : "");
    if (found && !key.value.set(*found, path)) fail_in_file(path, found->line, refusal_of_value(key, *found));
  }
}

void require_schema(const std::string& path, const TomlValue& document, int schema) {
  const TomlValue* found = document.find("schema");
  if (!found) fail_in_file(path, document.line, "missing key 'schema'");
  if (found->kind != Kind::integer || found->number != schema)
    fail_in_file(path, found->line, "schema = ", shortened(as_toml(*found)), ", this version reads schema ", schema,
                 found->number > schema ? "; the file is of a newer insonify" : "");
}

void set_key(const std::vector<Key>& keys, const std::string& name, const std::string& text, const std::string& who) {
  set_key(keys, name, values_of_text(text), who);
}

void set_key(const std::vector<Key>& keys, const std::string& name, const std::vector<TomlValue>& values,
             const std::string& who) {
  const Key* key = find_key(keys, name);
  if (!key) fail(ErrorKind::argument, who, refusal_of_unknown(keys, name));
  if (std::ranges::none_of(values, [&](const TomlValue& value) { return key->value.set(value, ""); }))
    fail(ErrorKind::argument, who, refusal_of_value(*key, values.front()));
}

std::string keys_as_toml(const std::vector<Key>& keys) {
  std::string text, section;
  for (const Key& key : keys) {
    const std::optional<std::string> value = key.value.text();
    if (!value) continue;
    if (section != key.section) text += (text.empty() ? "[" : "\n[") + (section = key.section) + "]\n";
    text += std::string(key.name) + " = " + *value + "\n";
  }
  return text;
}

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(full_name(key));
  return names;
}

}  // namespace insonify
