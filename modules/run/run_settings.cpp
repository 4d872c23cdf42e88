// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_settings.hpp"

#include <fmt/format.h>

#include "run/asked_simulation.hpp"

namespace insonify {
namespace {

/// The value of a setting as a key of run.toml has it.
KeyValue key_value(const RunSetting& setting) {
  const OptionRules& rules = setting.rules;
  if (std::string* const* text = std::get_if<std::string*>(&setting.value))
    return setting.is_path ? path(**text) : word(**text, rules.words);
  if (double* const* value = std::get_if<double*>(&setting.value)) {
    KeyValue key = insonify::number(**value, {.infinite = true});
    key.text = [x = *value] { return fmt::format("{}", *x); };
    return key;
  }
  if (int* const* value = std::get_if<int*>(&setting.value)) {
    const auto [least, most] = rules.within.value_or(std::pair(-1000000000, 1000000000));
    return insonify::number(**value, {.least = 1.0 * least, .most = 1.0 * most, .whole = true});
  }
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

PingOptions load_mission_settings(const std::string& path) {
  PingOptions options;
  read_sections(path, load_toml(path), keys_of(mission_settings(options)));
  require_valid_file(path, options);
  return options;
}

PingOptions load_ping_settings(const std::string& path) {
  const TomlValue document = load_toml(path);
  if (!document.find("insonify_version") || !document.find("ping"))
    fail(ErrorKind::content, path, ": is not the run.toml of a ping");
  PingOptions options;
  const std::vector<Key> keys = keys_of(all_settings(options));
  read_sections(path, document, keys);
  // Sonar and environment have readers of their own, which refuse what they do not know.
  std::vector<std::string> others{"schema", "insonify_version", "environment_file", "profile_file"};
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (document.items[i].kind == TomlValue::Kind::table || document.keys[i] == "mirror")
      others.push_back(document.keys[i]);
  read_keys(path, document, keys, "", others);
  options.run.sonar = options.run.environment = path;
  return options;
}

}  // namespace insonify
