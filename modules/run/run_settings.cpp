// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_settings.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "run/parse_values.hpp"
#include "run/requested_simulation.hpp"

namespace insonify {
namespace {

/// Numbers as a text with commas, or as a list; a number alone stands for a list of one.
KeyValue list_value(const NumberList& list) {
  const auto read = [list](const TomlValue& value) -> std::optional<std::vector<double>> {
    if (value.kind == TomlValue::Kind::text) {
      if (value.text.empty()) return std::vector<double>{};
      try {
        return parse_numbers("", value.text, list.count, list.meaning);
      } catch (const Error&) {
        return std::nullopt;
      }
    }
    const std::vector<TomlValue> items = value.kind == TomlValue::Kind::array ? value.items : std::vector{value};
    std::vector<double> numbers;
    for (const TomlValue& item : items)
      if (item.is_number() && std::isfinite(item.number)) numbers.push_back(item.number);
    const bool good = numbers.size() == items.size() && numbers.size() == list.count;
    return good ? std::optional(numbers) : std::nullopt;
  };
  KeyValue value =
      value_in<std::vector<double>>(list.numbers, {std::string(list.meaning) + ", as text or as a list", read, {}});
  value.text = [numbers = list.numbers] {
    return as_toml(fmt::format("{}", fmt::join(numbers.get().value_or(std::vector<double>{}), ",")));
  };
  return value;
}

KeyValue key_value(const RunSetting& setting) {
  const OptionRules& rules = setting.rules;
  if (std::string* const* text = std::get_if<std::string*>(&setting.value))
    return setting.is_path ? path(**text) : word(**text, rules.words);
  if (double* const* value = std::get_if<double*>(&setting.value)) {
    KeyValue key = insonify::number(**value, {.infinite = true});
    key.text = [x = *value] { return fmt::format("{}", *x); };
    return key;
  }
  const auto [least, most] = rules.within.value_or(std::pair(-1000000000, 1000000000));
  const NumberRule whole{.least = 1.0 * least, .most = 1.0 * most, .whole = true};
  if (int* const* value = std::get_if<int*>(&setting.value)) return insonify::number(**value, whole);
  if (const auto* shown = std::get_if<Shown<int>>(&setting.value)) {
    const auto get = [get = shown->value.get] { return std::optional<double>(get()); };
    return insonify::number({get, [set = shown->value.set](double x) { set(static_cast<int>(x)); }}, whole);
  }
  if (const auto* shown = std::get_if<Shown<std::string>>(&setting.value))
    return shown->key ? *shown->key : word(shown->value, rules.words);
  if (const auto* shown = std::get_if<Shown<bool>>(&setting.value)) return flag(shown->value);
  if (const auto* list = std::get_if<NumberList>(&setting.value)) return list_value(*list);
  if (std::uint64_t* const* value = std::get_if<std::uint64_t*>(&setting.value)) return seed(**value);
  if (bool* const* value = std::get_if<bool*>(&setting.value)) return flag(**value);
  return texts(*std::get<std::vector<std::string>*>(setting.value), rules.words);
}

}  // namespace

std::vector<Key> keys_of(const std::vector<RunSetting>& settings) {
  std::vector<Key> keys;
  for (const RunSetting& s : settings) keys.push_back({s.section, s.key, "", key_value(s), s.help});
  return keys;
}

namespace {

/// Reads [scene] and [ping] of a document, of which it may have neither.
void read_sections(const std::string& path, const TomlValue& document, const std::vector<Key>& keys) {
  for (const char* section : {"scene", "ping"}) {
    if (const TomlValue* table = document.find(section)) read_keys(path, *table, keys, section);
  }
}

}  // namespace

std::string settings_as_toml(const std::vector<RunSetting>& settings) { return keys_as_toml(keys_of(settings)); }

SceneOptions load_scene_settings(const std::string& path) {
  SceneOptions options;
  const TomlValue document = load_toml(path);
  if (const TomlValue* table = document.find("scene"))
    read_keys(path, *table, keys_of(scene_settings(options)), "scene");
  return options;
}

Run load_mission_settings(const std::string& path) {
  Run run;
  read_sections(path, load_toml(path), keys_of(mission_settings(run)));
  require_valid_file(path, run);
  return run;
}

Run load_ping_settings(const std::string& path) {
  const TomlValue document = load_toml(path);
  if (!document.find("insonify_version") || !document.find("ping"))
    fail(ErrorKind::content, path, ": is not the run.toml of a ping");
  Run run;
  const std::vector<Key> keys = keys_of(all_settings(run));
  read_sections(path, document, keys);
  // Sonar and environment have readers of their own, which refuse what they do not know.
  std::vector<std::string> others{"schema", "insonify_version", "environment_file", "profile_file"};
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (document.items[i].kind == TomlValue::Kind::table || document.keys[i] == "mirror")
      others.push_back(document.keys[i]);
  read_keys(path, document, keys, "", others);
  run.head.sonar = run.head.environment = path;
  return run;
}

}  // namespace insonify
