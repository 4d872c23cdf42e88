// SPDX-License-Identifier: BSD-3-Clause
#include "store/sonar_file.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "store/sonar_keys.hpp"
#include "store/sourced_values_internal.hpp"

namespace insonify {
namespace {

constexpr int sonar_schema = 1;

/// Returns the keys of a file: those of the spec, and those that are no property of the sonar itself.
std::vector<Key> keys_of_file(SonarFile& file) {
  std::vector<Key> keys = sonar_keys(file.spec);
  keys.push_back({"", "description", "", text(file.description), "what it is"});
  keys.push_back(mounting_key(file));
  return keys;
}

/// Lists the default of an omitted key among the numbers.
void note_default(SonarFile& file, const Key& key) {
  const std::string name = key.name;
  if (name == "shading")
    file.numbers.push_back(
        {name, shading_name(shading_of(file.spec)), "derived", "from side_lobe_db: below 0 taylor, else uniform"});
  if (name != "side_lobe_db" && name != "elevation_deg" && name != "elevation_shape") return;
  std::string value = key.value.text().value_or("");
  if (value.empty()) return;
  std::erase(value, '"');
  file.numbers.push_back({name, value, "assumed", "omitted in the file: default of insonify"});
}

/// Adds the line number to errors of require_valid, which name the key ("path: key = value, must be ...").
void require_valid_in_file(const SonarFile& file, const TomlValue& table) {
  try {
    require_valid(file.spec, "sonar");
  } catch (const Error& error) {
    const std::string text = std::string(error.what()).substr(std::string("sonar: ").size());
    std::string key = text.substr(0, text.find(" = "));
    if (key == "bandwidth_hz" && !table.find(key)) key = "range_resolution_m";
    const TomlValue* value = table.find(key);
    fail_in_file(file.path, value ? value->line : table.line, text);
  }
}

}  // namespace

Key mounting_key(SonarFile& file) {
  return {"", "mounting_deg", "deg", vector(file.mounting, "yaw, pitch, roll", in_degrees),
          "attitude of the head on a vehicle: yaw to port, pitch nose down, roll starboard down"};
}

SonarFile load_sonar_file(const std::string& path) {
  const TomlValue document = load_toml(path);
  // A run.toml holds its sonar in the table [sonar].
  const TomlValue* section = document.find("sonar");
  SonarFile file;
  file.path = path;
  file.of_run = section && section->kind == TomlValue::Kind::table;
  TomlValue table = file.of_run ? *section : document;
  require_schema(path, table, sonar_schema);

  const std::vector<SonarNumber> numbers = take_sources(path, table);
  const std::vector<Key> keys = keys_of_file(file);
  read_keys(path, table, keys, "", {"schema"});
  for (const Key& key : keys) {
    const auto number = std::ranges::find(numbers, key.name, &SonarNumber::key);
    if (number == numbers.end())
      note_default(file, key);
    else if (number->key != "name" && number->key != "description")
      file.numbers.push_back(*number);
    if (number != numbers.end() && number->key == "range_resolution_m")
      file.numbers.push_back(
          {"bandwidth_hz", as_toml(file.spec.bandwidth), "derived", "1500 m/s / (2 range_resolution_m)"});
  }
  require_valid_in_file(file, table);
  return file;
}

std::string sonar_as_toml(const SonarSpec& spec) {
  SonarSpec written = spec;
  return "schema = " + std::to_string(sonar_schema) + "\n" + keys_as_toml(sonar_keys(written));
}

void set_sonar_value(SonarSpec& spec, const std::string& key, const std::string& value) {
  set_key(sonar_keys(spec), key, value, "sonar: ");
}

}  // namespace insonify
