#include "store/sonar_file.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_keys_internal.hpp"
#include "store/toml_tree_internal.hpp"

namespace insonify {
namespace {

constexpr int sonar_schema = 1;
constexpr const char* mounting_key = "mounting_deg";  // of the file, not of the spec: no property of the sonar itself

bool is_status(const std::string& status) {
  const std::vector<std::string> known = {"sourced", "recalled", "derived", "assumed", "unknown", "user"};
  return std::find(known.begin(), known.end(), status) != known.end();
}

SonarValue value_of(const std::string& path, const std::string& key, const TomlValue& value) {
  if (value.is_number()) return value.number;
  if (value.kind == TomlValue::Kind::text) return value.text;
  if (value.kind == TomlValue::Kind::array) {
    std::vector<double> list;
    for (const TomlValue& item : value.items) {
      if (!item.is_number()) fail_in_file(path, item.line, key, " must be a list of numbers");
      list.push_back(item.number);
    }
    return list;
  }
  fail_in_file(path, value.line, key, " must be a number, text or list, or a table {value, status, source}");
}

Eigen::Vector3d mounting_of(const SonarValue& value) {
  const auto* angles = std::get_if<std::vector<double>>(&value);
  if (!angles || angles->size() != 3)
    fail(ErrorKind::argument, mounting_key, " = ", toml_text_of(value), ", must be three numbers: yaw, pitch, roll");
  return radians(1) * Eigen::Vector3d::Map(angles->data());
}

// Reads a key, plain or with its source, into the file and the list of numbers.
void read_key(SonarFile& file, const std::string& key, const TomlValue& entry) {
  SonarNumber number{key, "", "user", ""};
  const TomlValue* value = &entry;
  if (entry.kind == TomlValue::Kind::table) {
    require_known_keys(file.path, entry, {"value", "status", "source"});
    value = entry.find("value");
    if (!value) fail_in_file(file.path, entry.line, key, ": missing key 'value'");
    number.status = toml_text(file.path, entry, "status");
    if (!is_status(number.status))
      fail_in_file(file.path, entry.line, key, ": status = \"", number.status,
                   "\", must be sourced, recalled, derived, assumed, unknown or user");
    if (entry.find("source")) number.source = toml_text(file.path, entry, "source");
  }
  const SonarValue parsed = value_of(file.path, key, *value);
  try {
    if (key == mounting_key)
      file.mounting = mounting_of(parsed);
    else
      set_sonar_key(file.spec, key, parsed);
  } catch (const Error& error) {
    fail_in_file(file.path, value->line, error.what());
  }
  number.value = std::holds_alternative<std::string>(parsed) ? std::get<std::string>(parsed) : toml_text_of(parsed);
  file.numbers.push_back(number);
  if (key == "range_resolution_m")
    file.numbers.push_back(
        {"bandwidth_hz", toml_text_of(file.spec.bandwidth), "derived", "1500 m/s / (2 range_resolution_m)"});
}

// Lists the default of an omitted key among the numbers.
void note_default(SonarFile& file, const std::string& key) {
  if (key == "shading")
    file.numbers.push_back(
        {key, shading_name(shading_of(file.spec)), "derived", "from side_lobe_db: below 0 taylor, else uniform"});
  if (key == "elevation_deg" && !file.spec.elevations.empty()) return;
  if (key != "side_lobe_db" && key != "elevation_deg" && key != "elevation_shape") return;
  std::string text = sonar_key_text(file.spec, key).value_or("");
  text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
  file.numbers.push_back({key, text, "assumed", "omitted in the file: default of insonify"});
}

void require_complete(const std::string& path, const TomlValue& table) {
  for (const std::string& key : required_sonar_keys())
    if (!table.find(key)) fail_in_file(path, table.line, "missing key '", key, "'");
  const TomlValue* resolution = table.find("range_resolution_m");
  if (!table.find("bandwidth_hz") && !resolution)
    fail_in_file(path, table.line, "missing key 'bandwidth_hz' (or 'range_resolution_m')");
  if (table.find("bandwidth_hz") && resolution)
    fail_in_file(path, resolution->line, "bandwidth_hz and range_resolution_m say the same thing; leave one out");
  if (const TomlValue* tilt = table.find("elevation_deg"); tilt && table.find("elevations_deg"))
    fail_in_file(path, tilt->line, "elevation_deg follows from elevations_deg; leave it out");
  const bool given_beams = table.find("azimuths_deg") != nullptr;
  for (const std::string key : {"beams", "field_of_view_deg"}) {
    const TomlValue* value = table.find(key);
    if (given_beams && value) fail_in_file(path, value->line, key, " follows from azimuths_deg; leave it out");
    if (!given_beams && !value) fail_in_file(path, table.line, "missing key '", key, "' (or 'azimuths_deg')");
  }
}

// Adds the line number to errors of require_valid, which name the key ("path: key = value, must be ...").
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

// Parses the text of a --set: a number, a list of numbers, or else text.
SonarValue value_from_text(const std::string& text) {
  std::string bare = text;
  std::replace_if(
      bare.begin(), bare.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream words(bare);
  std::vector<double> list;
  for (std::string word; words >> word;) {
    if (!to_number(word, list.emplace_back())) return text;
  }
  if (list.empty()) return text;
  if (list.size() == 1 && text.find_first_of("[,") == std::string::npos) return list[0];
  return list;
}

}  // namespace

SonarFile load_sonar_file(const std::string& path) {
  const TomlValue document = load_toml(path);
  // A run.toml holds its sonar in the table [sonar].
  const TomlValue* section = document.find("sonar");
  const bool of_run = section && section->kind == TomlValue::Kind::table;
  const TomlValue& table = of_run ? *section : document;

  std::vector<std::string> known = sonar_key_names();
  known.insert(known.end(), {"schema", "name", "description", mounting_key});
  require_known_keys(path, table, known);
  if (const double schema = toml_number(path, table, "schema"); schema != sonar_schema)
    fail_in_file(path, table.find("schema")->line, "schema = ", schema, ", this version reads schema ", sonar_schema);
  require_complete(path, table);

  SonarFile file;
  file.path = path;
  file.of_run = of_run;
  file.spec.name = toml_text(path, table, "name");
  if (table.find("description")) file.description = toml_text(path, table, "description");
  for (const std::string& key : sonar_key_names()) {
    const TomlValue* entry = table.find(key);
    if (entry)
      read_key(file, key, *entry);
    else
      note_default(file, key);
  }
  if (const TomlValue* mounting = table.find(mounting_key)) read_key(file, mounting_key, *mounting);
  require_valid_in_file(file, table);
  return file;
}

std::string sonar_as_toml(const SonarSpec& spec) {
  std::string text = "schema = " + std::to_string(sonar_schema) + "\nname = " + toml_text_of(spec.name) + "\n";
  for (const std::string& key : sonar_key_names())
    if (const auto value = sonar_key_text(spec, key)) text += key + " = " + *value + "\n";
  return text;
}

void set_sonar_value(SonarSpec& spec, const std::string& key, const std::string& value) {
  if (key == "name") {
    spec.name = value;
    return;
  }
  std::vector<std::string> known = sonar_key_names();
  if (std::find(known.begin(), known.end(), key) == known.end()) {
    known.emplace_back("name");
    fail(ErrorKind::argument, "sonar: unknown key '", key, "'", did_you_mean(key, known));
  }
  SonarValue parsed = value_from_text(value);
  const bool is_list = key == "azimuths_deg" || key == "elevations_deg";
  if (is_list && std::holds_alternative<double>(parsed)) parsed = std::vector{std::get<double>(parsed)};
  try {
    set_sonar_key(spec, key, parsed);
  } catch (const Error& error) {
    fail(ErrorKind::argument, "sonar: ", error.what());
  }
}

}  // namespace insonify
