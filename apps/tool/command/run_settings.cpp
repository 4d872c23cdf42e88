#include "tool/command/run_settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "store/toml_tree_internal.hpp"

namespace insonify::tool {
namespace {

using Kind = TomlValue::Kind;

std::string as_toml(const std::string& text) { return toml_text(text); }
std::string as_toml(double number) { return fmt::format("{}", number); }
std::string as_toml(int number) { return fmt::format("{}", number); }
std::string as_toml(bool flag) { return flag ? "true" : "false"; }

/// TOML has no integers above 2^63, and its readers no exact ones above 2^53: those are text.
std::string as_toml(std::uint64_t number) {
  const std::string digits = fmt::format("{}", number);
  return number < (std::uint64_t{1} << 53) ? digits : toml_text(digits);
}

std::string as_toml(const std::vector<std::string>& words) { return "[" + joined(words, ", ", toml_text) + "]"; }

/// Calls `use` with the value of a setting.
template <typename Use>
void visit_value(const RunSetting& setting, const Use& use) {
  std::visit(
      [&](const auto& value) {
        if constexpr (requires { as_toml(*value); }) use(*value);
      },
      setting.value);
}

std::string toml_value(const RunSetting& setting) {
  std::string text;
  visit_value(setting, [&](const auto& value) { text = as_toml(value); });
  return text;
}

/// A value of run.toml with what an error must name.
struct FileValue {
  const std::string& path;
  const RunSetting& setting;
  const TomlValue& value;

  template <typename... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    fail_in_file(path, value.line, setting.key, parts...);
  }
  std::string text(const TomlValue& item) const {
    if (item.kind != Kind::text) refuse(" must be text in quotes");
    const auto& words = setting.rules.words;
    if (!words.empty() && std::find(words.begin(), words.end(), item.text) == words.end())
      refuse(" = '", item.text, "', must be one of ", joined(words));
    return item.text;
  }
};

void read(const FileValue& from, std::string& text) {
  text = from.text(from.value);
  if (from.setting.is_path) text = path_named_in(from.path, text);
}

void read(const FileValue& from, double& number) {
  if (!from.value.is_number()) from.refuse(" must be a number");
  number = from.value.number;
}

void read(const FileValue& from, int& number) {
  if (from.value.kind != Kind::integer || std::abs(from.value.number) > 1e9) from.refuse(" must be an integer");
  number = static_cast<int>(from.value.number);
  const auto& limits = from.setting.rules.within;
  if (limits && (number < limits->first || number > limits->second))
    from.refuse(" = ", number, ", must be within ", limits->first, " and ", limits->second);
}

void read(const FileValue& from, std::uint64_t& number) {
  const TomlValue& value = from.value;
  const std::string digits = value.kind == Kind::text      ? value.text
                             : value.kind == Kind::integer ? fmt::format("{:.0f}", value.number)
                                                           : "";
  if (!to_number(digits, number)) from.refuse(" must be an integer from 0, in quotes from 2^53");
}

void read(const FileValue& from, bool& flag) {
  if (from.value.kind != Kind::boolean) from.refuse(" must be true or false");
  flag = from.value.number != 0;
}

void read(const FileValue& from, std::vector<std::string>& words) {
  if (from.value.kind != Kind::array) from.refuse(" must be a list of texts");
  words.clear();
  for (const TomlValue& item : from.value.items) words.push_back(from.text(item));
}

const TomlValue no_table{};

/// Reads the settings of one section from its table, which may hold no other keys but `others`.
void read_section(const std::string& path, const TomlValue& table, const std::string& section,
                  const std::vector<RunSetting>& settings, std::vector<std::string> others = {}) {
  if (table.kind != Kind::table) fail_in_file(path, table.line, section, " must be a table: [", section, "]");
  std::vector<std::string> known = std::move(others);
  for (const RunSetting& setting : settings)
    if (setting.section == section) known.emplace_back(setting.key);
  if (section == "ping") {  // runs of before have it, nearly all with 0
    const TomlValue* gone = table.find("level_error_db");
    if (gone && !(gone->is_number() && gone->number == 0))
      fail_in_file(path, gone->line, "level_error_db is no setting any more; set scatterers_per_cell or rays_per_beam");
    known.emplace_back("level_error_db");
  }
  require_known_keys(path, table, known);
  for (const RunSetting& setting : settings)
    if (const TomlValue* found = setting.section == section ? table.find(setting.key) : nullptr)
      visit_value(setting, [&](auto& value) { read({path, setting, *found}, value); });
}

const TomlValue& table_of(const TomlValue& document, const std::string& section) {
  const TomlValue* table = document.find(section);
  return table ? *table : no_table;
}

}  // namespace

std::string toml_text(const std::string& text) {
  // JSON's escapes are TOML's, but for DEL, which TOML does not take as it is.
  return boost::replace_all_copy(nlohmann::json(text).dump(), "\x7f", "\\u007f");
}

std::string settings_as_toml(const std::vector<RunSetting>& settings) {
  std::string text, section;
  for (const RunSetting& setting : settings) {
    if (section != setting.section) text += fmt::format("\n[{}]\n", section = setting.section);
    text += fmt::format("{} = {}\n", setting.key, toml_value(setting));
  }
  return text;
}

SceneOptions load_scene_settings(const std::string& path) {
  SceneOptions options;
  read_section(path, table_of(load_toml(path), "scene"), "scene", scene_settings(options));
  return options;
}

PingOptions load_mission_settings(const std::string& path) {
  const TomlValue document = load_toml(path);
  PingOptions options;
  const std::vector<RunSetting> settings = mission_settings(options);
  for (const char* section : {"scene", "ping"}) read_section(path, table_of(document, section), section, settings);
  return options;
}

PingOptions load_ping_settings(const std::string& path) {
  const TomlValue document = load_toml(path);
  if (!document.find("insonify_version") || !document.find("ping"))
    fail(ErrorKind::content, path, ": is not the run.toml of a ping");
  PingOptions options;
  const std::vector<RunSetting> settings = all_settings(options);
  for (const char* section : {"scene", "ping"}) read_section(path, table_of(document, section), section, settings);
  // Sonar and environment have readers of their own, which refuse what they do not know.
  std::vector<std::string> others{"schema", "insonify_version", "environment_file", "profile_file"};
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (document.items[i].kind == Kind::table) others.push_back(document.keys[i]);
  read_section(path, document, "", settings, others);
  options.run.sonar = options.run.environment = path;
  return options;
}

}  // namespace insonify::tool
