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

// Returns the names that contain the word ("oculus" matches six presets), or else the nearest one by spelling.
std::string suggestion(const std::string& word, const std::map<std::string, std::string>& presets) {
  const std::string wanted = lower_case(word);
  std::vector<std::string> names, with_it;
  for (const auto& [name, path] : presets) {
    names.push_back(name);
    if (!wanted.empty() && name.find(wanted) != std::string::npos) with_it.push_back(name);
  }
  const std::string list = with_it.empty() ? nearest_word(wanted, names) : joined(with_it);
  return list.empty() ? "." : "; did you mean " + list + "?";
}

constexpr Named<ElevationShape> elevation_shapes[] = {
    {"gaussian", ElevationShape::gaussian}, {"line", ElevationShape::line}, {"sector", ElevationShape::sector}};

// Returns the names of enumerators, as their own function states them.
template <typename Value, typename NameOf>
std::vector<Named<Value>> named(const NameOf& name_of, const std::vector<Value>& values) {
  std::vector<Named<Value>> table;
  for (const Value value : values) table.push_back({name_of(value), value});
  return table;
}
// Returns the first enumerators.
template <typename Value>
std::vector<Value> first_of(std::size_t count) {
  std::vector<Value> values;
  while (values.size() < count) values.push_back(static_cast<Value>(values.size()));
  return values;
}
const auto pulses = named(pulse_shape_name, first_of<PulseShape>(std::size(pulse_kinds)));
const auto arrays = named([](ArrayShape shape) { return array_kinds[static_cast<std::size_t>(shape)].name; },
                          first_of<ArrayShape>(std::size(array_kinds)));
const auto windows = named(replica_window_name, first_of<ReplicaWindow>(3));
const auto shadings =
    named<Shading>(shading_name, {Shading::taylor, Shading::uniform, Shading::hamming, Shading::chebyshev});

/// Returns true if the shading follows from side_lobe_db alone.
bool is_default_shading(const SonarSpec& spec) {
  SonarSpec plain = spec;
  plain.shading.reset();
  return shading_of(spec) == shading_of(plain);
}

/// Restores an evenly spaced fan: drops azimuths and the elevations that belong to them, but keeps those of rows.
void drop_table(SonarSpec& spec) {
  if (spec.azimuths.empty()) return;
  spec.azimuths.clear();
  spec.elevations.clear();
}

/// Sets number and field of view of beams at given azimuths. The field of view extends half a mean spacing beyond the
/// outermost beams, as in an evenly spaced fan, and is at least one beam width.
void fit_fan(SonarSpec& spec) {
  if (spec.azimuths.empty()) return;
  spec.beams = spec.azimuths.size();
  const auto [low, high] = std::minmax_element(spec.azimuths.begin(), spec.azimuths.end());
  const double n = static_cast<double>(spec.beams);
  spec.field_of_view = std::clamp((*high - *low) * n / std::max(n - 1, 1.0), std::min(spec.beam_width, 2 * pi), 2 * pi);
}

/// The rule for a width that is 0 in the spec if files omit it.
constexpr NumberRule width_rule{.least = 0, .above = true, .note = "omit the key if there is none"};

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

  const std::vector<SourcedNumber> numbers = take_sources(path, table);
  const std::vector<Key> keys = keys_of_file(file);
  read_keys(path, table, keys, "", {"schema"});
  for (const Key& key : keys) {
    const auto number = std::ranges::find(numbers, key.name, &SourcedNumber::key);
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

std::map<std::string, std::string> data_files(const std::string& folder) {
  std::map<std::string, std::string> files;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(data_folder()) / folder))
      if (entry.path().extension() == ".toml") files[entry.path().stem().string()] = entry.path().string();
  });
  return files;
}

SonarFile find_sonar(const std::string& name_or_path) {
  if (fs::path(name_or_path).extension() == ".toml") return load_sonar_file(name_or_path);
  const auto presets = data_files("sonars");
  const auto found = presets.find(name_or_path);
  if (found == presets.end())
    fail(ErrorKind::argument, "sonar '", name_or_path, "' is not a preset", suggestion(name_or_path, presets),
         " `insonify sonars` lists all; a path ending in .toml is read as a file");
  return load_sonar_file(found->second);
}

std::vector<SonarFile> list_sonars() {
  std::vector<SonarFile> sonars;
  for (const auto& [name, path] : data_files("sonars")) sonars.push_back(load_sonar_file(path));
  return sonars;
}

std::vector<Key> sonar_keys(SonarSpec& s) {
  const auto fit = [&s] { fit_fan(s); };
  const auto even = [&s] { drop_table(s); };
  const auto has_azimuths = [&s] { return !s.azimuths.empty(); };
  const Member<double> resolution{[] { return std::optional<double>(); },
                                  [&s](double metres) { s.bandwidth = nominal_sound_speed / (2 * metres); }};
  return {
      {"", "name", "", text(s.name), "name of the sonar", true},
      {"", "centre_frequency_hz", "Hz", number(s.centre_frequency), "centre frequency of the pulse", true},
      {"", "bandwidth_hz", "Hz", number(s.bandwidth), "full width of the pulse's spectrum at -3 dB", true,
       "range_resolution_m"},
      {"", "range_resolution_m", "m", number(resolution, positive), "range resolution c / 2B at 1500 m/s"},
      {"", "source_level_db", "dB", number(s.source_level_db), "source level re 1 uPa at 1 m", true},
      {"", "beams", "",
       then(omitted_if(number(s.beams, {.least = 1, .most = 65536, .whole = true}), has_azimuths), even),
       "number of evenly spaced beams", true, "azimuths_deg"},
      {"", "field_of_view_deg", "deg", then(omitted_if(angle(s.field_of_view), has_azimuths), even),
       "angle that evenly spaced beams cover", true, "azimuths_deg"},
      {"", "beam_width_deg", "deg", then(angle(s.beam_width), fit), "-3 dB width of a beam in azimuth", true},
      {"", "azimuths_deg", "deg", then(list(given(s.azimuths), {.least = -180, .most = 180}, in_degrees), fit),
       "azimuths of the beams"},
      {"", "elevations_deg", "deg",
       then(list(given(s.elevations), {.least = -90, .most = 90}, in_degrees), [&s] { s.elevation = 0; }),
       "elevations of rows of beams; beside `azimuths_deg`: one elevation for each beam"},
      {"", "column_beam_width_deg", "deg", angle(given(s.column_beam_width), width_rule),
       "beam width of a planar array in elevation; without the key: a line array"},
      {"", "array", "", omitted_if(word(s.array, arrays), [&s] { return s.array == ArrayShape{}; }),
       "shape of the receive array; default: line; an array that is curved has an array_radius_m"},
      {"", "array_radius_m", "m", number(given(s.array_radius), width_rule), "radius of a curved array"},
      {"", "side_lobe_db", "dB", number(s.side_lobe_db),
       "level of the side lobes of taylor and chebyshev shading; 0: uniform shading"},
      {"", "shading", "", omitted_if(word(s.shading, shadings), [&s] { return is_default_shading(s); }),
       "shading of the array; default: taylor, or uniform if `side_lobe_db = 0`"},
      {"", "transmit_width_deg", "deg", angle(given(s.transmit_width), width_rule),
       "width of the transmitter's main lobe in azimuth; without the key: uniform over the fan"},
      {"", "elevation_width_deg", "deg", angle(s.elevation_width), "-3 dB width of the pattern in elevation", true},
      {"", "elevation_deg", "deg",
       then(omitted_if(angle(s.elevation), [&s] { return !s.elevations.empty(); }), [&s] { s.elevations.clear(); }),
       "elevation of the fan's axis", false, "elevations_deg"},
      {"", "elevation_shape", "", word(s.elevation_shape, elevation_shapes), "shape of the pattern in elevation"},
      {"", "min_range_m", "m", number(s.min_range), "range at which listening begins", true},
      {"", "max_range_m", "m", number(s.max_range), "range at which listening ends", true},
      {"", "bin_size_m", "m", number(s.bin_size), "size of a range bin; default and most: 0.44 c / 2B"},
      {"", "pulse", "", omitted_if(word(s.pulse, pulses), [&s] { return s.pulse == PulseShape{}; }),
       "shape of the pulse; default: gaussian; a sweep has a pulse_length_s, the length of others follows from the "
       "bandwidth"},
      {"", "pulse_length_s", "s", number(s.pulse_length), "duration of a sweep"},
      {"", "replica_window", "", word(s.replica_window, windows),
       "window of the matched filter of a sweep; default: hamming"},
  };
}

}  // namespace insonify
