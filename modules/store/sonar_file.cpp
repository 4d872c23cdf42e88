// SPDX-License-Identifier: BSD-3-Clause
#include "store/sonar_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <dlfcn.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/path_status.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_keys.hpp"
#include "store/sourced_values_internal.hpp"

namespace insonify {
namespace fs = std::filesystem;
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

bool is_data_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "sonars", ignored);
}

/// Returns the folder of the program, or of the library of Python's module, that this code is part of.
fs::path folder_of_this_code() {
  Dl_info found{};
  return dladdr(reinterpret_cast<void*>(&is_data_folder), &found) ? fs::path(found.dli_fname).parent_path()
                                                                  : fs::path();
}

std::vector<std::string> preset_names() {
  const fs::path folder = fs::path(data_folder()) / "sonars";
  std::vector<std::string> names;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  });
  std::sort(names.begin(), names.end());
  return names;
}

std::string preset_path(const std::string& name) {
  return (fs::path(data_folder()) / "sonars" / (name + ".toml")).string();
}

// Returns the names that contain the word ("oculus" matches six presets), or else the nearest one by spelling.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string wanted = lower_case(word);
  std::vector<std::string> with_it;
  std::copy_if(names.begin(), names.end(), std::back_inserter(with_it),
               [&](const std::string& name) { return !wanted.empty() && name.find(wanted) != std::string::npos; });
  const std::string list = with_it.empty() ? nearest_word(wanted, names) : joined(with_it);
  return list.empty() ? "." : "; did you mean " + list + "?";
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

std::string data_folder() {
  if (const char* chosen = std::getenv("INSONIFY_DATA"); chosen && *chosen) {
    if (!is_data_folder(chosen))
      fail(ErrorKind::file, "INSONIFY_DATA = ", chosen, ": is not a folder with sonars/ in it");
    return chosen;
  }
  // A wheel of Python contains its data. An installed program has ../share/insonify beside it, a program in
  // build/<preset>/bin the source tree.
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& folder :
       {folder_of_this_code() / "data", program / "../share/insonify", program / "../../../data",
        fs::path(INSONIFY_INSTALL_DATA), fs::path(INSONIFY_SOURCE_DATA),
        fs::path("/usr/share/insonify")})  // folder of Debian's package, for users of the library
    if (is_data_folder(folder)) return folder.lexically_normal().string();
  fail(ErrorKind::file, "data files (sonars/, materials.toml) found neither beside the program nor in ",
       INSONIFY_INSTALL_DATA, "; set INSONIFY_DATA to their folder");
}

SonarFile find_sonar(const std::string& name_or_path) {
  if (fs::path(name_or_path).extension() == ".toml") return load_sonar_file(name_or_path);
  const std::vector<std::string> names = preset_names();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end())
    fail(ErrorKind::argument, "sonar '", name_or_path, "' is not a preset", suggestion(name_or_path, names),
         " `insonify sonars` lists all; a path ending in .toml is read as a file");
  return load_sonar_file(preset_path(name_or_path));
}

std::vector<SonarFile> list_sonars() {
  std::vector<SonarFile> sonars;
  for (const std::string& name : preset_names()) sonars.push_back(load_sonar_file(preset_path(name)));
  return sonars;
}

}  // namespace insonify
