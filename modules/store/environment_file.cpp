#include "store/environment_file.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_keys_internal.hpp"
#include "store/toml_tree_internal.hpp"

namespace insonify {
namespace {

/// A numeric key of the file, with setter and getter; the getter returns nothing if the part is absent.
struct EnvironmentNumber {
  const char* section;
  const char* key;
  std::function<void(Environment&, double)> set;
  std::function<std::optional<double>(const Environment&)> get;
};

EnvironmentNumber water_key(const char* key, double Water::*field) {
  return {"water", key, [field](Environment& e, double x) { e.water.*field = x; },
          [field](const Environment& e) { return e.water.*field; }};
}

/// A number of an optional part of the environment; setting it makes the part present.
template <typename Part, typename Field>
EnvironmentNumber part_key(const char* section, const char* key, std::optional<Part> Environment::*part,
                           Field Part::*field) {
  return {section, key,
          [=](Environment& e, double x) {
            if (!(e.*part)) e.*part = Part{};
            (*(e.*part)).*field = x;
          },
          [=](const Environment& e) -> std::optional<double> {
            if (!(e.*part)) return std::nullopt;
            return (*(e.*part)).*field;
          }};
}

EnvironmentNumber plain_key(const char* section, const char* key, std::optional<double> Environment::*field) {
  return {section, key, [field](Environment& e, double x) { e.*field = x; },
          [field](const Environment& e) { return e.*field; }};
}

/// The Lambert coefficient is stored in files as 10 log10.
EnvironmentNumber bottom_mu_key() {
  EnvironmentNumber mu = part_key("bottom", "lambert_mu_db", &Environment::bottom, &FlatBottom::lambert_mu);
  mu.set = [set = mu.set](Environment& e, double x) { set(e, power_from_db(x)); };
  mu.get = [get = mu.get](const Environment& e) {
    const auto value = get(e);
    return value ? std::optional(db_from_power(*value)) : value;
  };
  return mu;
}

const std::vector<EnvironmentNumber>& environment_numbers() {
  using E = Environment;
  static const std::vector<EnvironmentNumber> keys = {
      water_key("temperature_c", &Water::temperature_c),
      water_key("salinity_psu", &Water::salinity_psu),
      water_key("depth_m", &Water::depth),
      plain_key("water", "level_m", &E::water_level),
      water_key("ph", &Water::ph),
      water_key("latitude_deg", &Water::latitude_deg),
      part_key("surface", "height_m", &E::surface, &SeaSurface::height),
      part_key("surface", "rms_height_m", &E::surface, &SeaSurface::rms_height),
      part_key("surface", "scattering_db", &E::surface, &SeaSurface::scattering_strength_db),
      part_key("bottom", "height_m", &E::bottom, &FlatBottom::height),
      part_key("bottom", "density_ratio", &E::bottom, &FlatBottom::density_ratio),
      part_key("bottom", "sound_speed_ratio", &E::bottom, &FlatBottom::sound_speed_ratio),
      part_key("bottom", "loss", &E::bottom, &FlatBottom::loss),
      part_key("bottom", "rms_height_m", &E::bottom, &FlatBottom::rms_height),
      bottom_mu_key(),
      plain_key("volume", "scattering_db", &E::volume_scattering_db),
      plain_key("wind", "speed_m_s", &E::wind_speed),
      plain_key("noise", "self_db", &E::self_noise_db)};
  return keys;
}

constexpr Named<SoundSpeedFormula> sound_speed_names[] = {{"unesco", SoundSpeedFormula::unesco},
                                                          {"mackenzie", SoundSpeedFormula::mackenzie},
                                                          {"leroy", SoundSpeedFormula::leroy}};
constexpr Named<AbsorptionFormula> absorption_names[] = {{"francois-garrison", AbsorptionFormula::francois_garrison},
                                                         {"fisher-simmons", AbsorptionFormula::fisher_simmons},
                                                         {"ainslie-mccolm", AbsorptionFormula::ainslie_mccolm}};

/// The formula called `name`. Throws Error(argument) listing the known names.
template <typename Formula>
void set_formula(std::span<const Named<Formula>> names, const std::string& key, const std::string& name,
                 Formula& formula) {
  const Formula* found = find_named(names, name);
  if (!found)
    fail(ErrorKind::argument, key, " = \"", name, "\", must be one of ", joined(names, ", ", &Named<Formula>::name));
  formula = *found;
}

bool is_formula(const std::string& name) {
  return name == "water.sound_speed_formula" || name == "water.absorption_formula";
}

void set_formula_key(Environment& e, const std::string& name, const std::string& value) {
  if (name == "water.sound_speed_formula")
    set_formula<SoundSpeedFormula>(sound_speed_names, name, value, e.sound_speed_formula);
  else
    set_formula<AbsorptionFormula>(absorption_names, name, value, e.absorption_formula);
}

/// Throws Error(argument), with the nearest key or all known ones, unless the key exists.
void require_known(const std::string& name) {
  const std::vector<std::string> known = environment_key_names();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near = nearest_word(name, known);
  if (!near.empty()) fail(ErrorKind::argument, name, " is unknown; did you mean ", near, "?");
  fail(ErrorKind::argument, name, " is unknown; known are ", joined(known));
}

void set_number(Environment& e, const std::string& section, const std::string& key, double value) {
  for (const EnvironmentNumber& candidate : environment_numbers())
    if (section == candidate.section && key == candidate.key) candidate.set(e, value);
}

void read_key(const std::string& path, const std::string& section, const std::string& key, const TomlValue& value,
              Environment& e) {
  const std::string name = section + "." + key;
  try {
    require_known(name);
    if (is_formula(name) != (value.kind == TomlValue::Kind::text) || (!is_formula(name) && !value.is_number()))
      fail(ErrorKind::argument, name, " must be ", is_formula(name) ? "the name of a formula" : "a number");
    if (is_formula(name))
      set_formula_key(e, name, value.text);
    else
      set_number(e, section, key, value.number);
  } catch (const Error& error) {
    fail_in_file(path, value.line, error.what());
  }
}

const std::vector<std::string> sections = {"water", "surface", "bottom", "volume", "wind", "noise", "profile"};

void require_known_table(const std::string& path, const std::string& section, const TomlValue& table) {
  if (table.kind != TomlValue::Kind::table)
    fail_in_file(path, table.line, section, " must be a table: [", section, "]");
  if (std::find(sections.begin(), sections.end(), section) != sections.end()) return;
  const std::string near = nearest_word(section, sections);
  fail_in_file(path, table.line, "unknown table [", section, "]",
               near.empty() ? "; known are [water] [surface] [bottom] [volume] [wind] [noise] [profile]"
                            : "; did you mean [" + near + "]?");
}

std::vector<double> list_of_numbers(const std::string& path, const TomlValue& table, const std::string& key) {
  const TomlValue* list = table.find(key);
  if (!list) fail_in_file(path, table.line, "profile: missing key '", key, "'");
  const char* rule = " must be a list of numbers";
  if (list->kind != TomlValue::Kind::array) fail_in_file(path, list->line, "profile.", key, rule);
  std::vector<double> numbers;
  for (const TomlValue& item : list->items) {
    if (!item.is_number()) fail_in_file(path, item.line, "profile.", key, rule);
    numbers.push_back(item.number);
  }
  return numbers;
}

SoundSpeedProfile read_profile(const std::string& path, const TomlValue& table) {
  require_known_keys(path, table, {"depth_m", "sound_speed"});
  return {list_of_numbers(path, table, "depth_m"), list_of_numbers(path, table, "sound_speed")};
}

void read_table(const std::string& path, const std::string& section, const TomlValue& table, Environment& e) {
  require_known_table(path, section, table);
  if (section == "surface") e.surface = SeaSurface{};
  if (section == "bottom") e.bottom = FlatBottom{};
  if (section == "profile")
    e.profile = read_profile(path, table);
  else
    for (std::size_t k = 0; k < table.keys.size(); ++k) read_key(path, section, table.keys[k], table.items[k], e);
}

/// True for the other contents of a run.toml, which is recognised by its version.
bool is_of_run(const TomlValue& document, std::size_t item) {
  const std::string& key = document.keys[item];
  return document.find("insonify_version") &&
         (document.items[item].kind != TomlValue::Kind::table || key == "sonar" || key == "scene" || key == "ping");
}

}  // namespace

Environment load_environment(const std::string& path) {
  const TomlValue document = load_toml(path);
  Environment e;
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (!is_of_run(document, i)) read_table(path, document.keys[i], document.items[i], e);
  try {
    require_valid(e, path.c_str());
  } catch (const Error& error) {
    fail(ErrorKind::content, error.what());
  }
  return e;
}

void set_environment_value(Environment& e, const std::string& section, const std::string& key,
                           const std::string& value) {
  const std::string name = section + "." + key;
  if (section == "profile")
    fail(ErrorKind::argument, name,
         ": a profile is set as a whole: by [profile] of an environment file, or by a CSV file (--profile)");
  require_known(name);
  if (is_formula(name)) {
    set_formula_key(e, name, value);
    return;
  }
  const auto number = finite_number(value);
  if (!number) fail(ErrorKind::argument, name, " = '", value, "', must be a number");
  set_number(e, section, key, *number);
}

std::string environment_as_toml(const Environment& e) {
  std::string text, section;
  for (const EnvironmentNumber& key : environment_numbers()) {
    const auto value = key.get(e);
    if (!value) continue;
    if (section != key.section) text += (text.empty() ? "[" : "\n[") + (section = key.section) + "]\n";
    text += std::string(key.key) + " = " + toml_text_of(*value) + "\n";
    if (key.key == std::string("latitude_deg"))
      text += "sound_speed_formula = \"" + name_of(sound_speed_names, e.sound_speed_formula) +
              "\"\nabsorption_formula = \"" + name_of(absorption_names, e.absorption_formula) + "\"\n";
  }
  if (e.profile)
    text += "\n[profile]\ndepth_m = " + toml_text_of(e.profile->depth) +
            "\nsound_speed = " + toml_text_of(e.profile->sound_speed) + "\n";
  return text;
}

std::vector<std::string> environment_key_names() {
  std::vector<std::string> names;
  for (const EnvironmentNumber& key : environment_numbers()) {
    names.push_back(std::string(key.section) + "." + key.key);
    if (names.back() == "water.latitude_deg")
      names.insert(names.end(), {"water.sound_speed_formula", "water.absorption_formula"});
  }
  return names;
}

}  // namespace insonify
