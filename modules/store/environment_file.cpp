// SPDX-License-Identifier: BSD-3-Clause
#include "store/environment_file.hpp"

#include "core/error.hpp"
#include "store/environment_keys_internal.hpp"

namespace insonify {
namespace {

constexpr Named<SoundSpeedFormula> sound_speed_formulas[] = {{"unesco", SoundSpeedFormula::unesco},
                                                             {"mackenzie", SoundSpeedFormula::mackenzie},
                                                             {"leroy", SoundSpeedFormula::leroy}};
constexpr Named<AbsorptionFormula> absorption_formulas[] = {{"francois-garrison", AbsorptionFormula::francois_garrison},
                                                            {"fisher-simmons", AbsorptionFormula::fisher_simmons},
                                                            {"ainslie-mccolm", AbsorptionFormula::ainslie_mccolm}};

/// A list of the profile.
KeyValue profile_list(Environment& e, std::vector<double> SoundSpeedProfile::*member) {
  const auto set = [&e, member](const TomlValue& value, const std::string& path) {
    return list((e.profile ? *e.profile : e.profile.emplace()).*member).set(value, path);
  };
  const auto text = [&e, member]() -> std::optional<std::string> {
    return e.profile ? std::optional(as_toml((*e.profile).*member)) : std::nullopt;
  };
  return {"a list of numbers", set, text};
}

/// Tables of a run.toml, which is recognised by its version, that are none of the environment; all keys outside of
/// tables.
std::vector<std::string> others_of_run(const TomlValue& document) {
  std::vector<std::string> others;
  if (!document.find("insonify_version")) return others;
  others = {"sonar", "scene", "ping"};
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    if (document.items[i].kind != TomlValue::Kind::table) others.push_back(document.keys[i]);
  return others;
}

}  // namespace

std::vector<Key> environment_keys(Environment& e) {
  Water& w = e.water;
  return {
      {"water", "temperature_c", "deg C", number(at(w.temperature_c)), ""},
      {"water", "salinity_psu", "psu", number(at(w.salinity_psu)), ""},
      {"water", "depth_m", "m", number(at(w.depth)),
       "depth of the head, of scenes without a surface. With one, depth is `surface.height_m` or `water.level_m` less "
       "the "
       "z of the head, for each ping; a depth that is given too must agree to 1 cm"},
      {"water", "level_m", "m", number(at(e.water_level)),
       "world z of the surface of the water, from which depth counts; it has no echoes, as `surface.height_m` has. A "
       "mission's `[water] level_m` sets it"},
      {"water", "ph", "", number(at(w.ph)), ""},
      {"water", "latitude_deg", "deg", number(at(w.latitude_deg)), ""},
      {"water", "sound_speed_formula", "", word(e.sound_speed_formula, sound_speed_formulas), ""},
      {"water", "absorption_formula", "", word(e.absorption_formula, absorption_formulas), ""},
      {"surface", "height_m", "m", number(at(e.surface, &SeaSurface::height)),
       "world z of the sea surface, from which depth counts: every head must be below it"},
      {"surface", "rms_height_m", "m", number(at(e.surface, &SeaSurface::rms_height)),
       "rms height of the waves; 0: smooth; default: from the wind"},
      {"surface", "scattering_db", "dB re 1 m^2/m^2", number(at(e.surface, &SeaSurface::scattering_strength_db)),
       "reverberation of the surface"},
      {"bottom", "height_m", "m", number(at(e.bottom, &FlatBottom::height)), "world z of a flat bed"},
      {"bottom", "density_ratio", "", number(at(e.bottom, &FlatBottom::density_ratio)),
       "sediment to water; the default of this and the next two is medium sand (APL-UW TR 9407)"},
      {"bottom", "sound_speed_ratio", "", number(at(e.bottom, &FlatBottom::sound_speed_ratio)), "sediment to water"},
      {"bottom", "loss", "", number(at(e.bottom, &FlatBottom::loss)),
       "imaginary to real part of the wavenumber in the sediment"},
      {"bottom", "rms_height_m", "m", number(at(e.bottom, &FlatBottom::rms_height)), "rms height of its relief"},
      {"bottom", "lambert_mu_db", "dB re 1/sr",
       number(at(e.bottom, &FlatBottom::lambert_mu), {.infinite = true}, in_decibels),
       "reverberation of the bottom; at most -4.97"},
      {"volume", "scattering_db", "dB re 1 m^2/m^3", number(at(e.volume_scattering_db)), "reverberation of the water"},
      {"wind", "speed_m_s", "m/s", number(at(e.wind_speed)),
       "at 10 m height: wave height, and with `--noise` wind noise"},
      {"noise", "self_db", "dB re 1 uPa^2/Hz", number(at(e.self_noise_db)),
       "self noise of platform and electronics, with `--noise`"},
      {"profile", "depth_m", "m", profile_list(e, &SoundSpeedProfile::depth),
       "of the sound-speed profile; `--profile` reads it from CSV. One that changes with depth needs "
       "`surface.height_m` or "
       "`water.level_m`; `--without multipath` leaves the surface's echoes out",
       true},
      {"profile", "sound_speed", "m/s", profile_list(e, &SoundSpeedProfile::sound_speed), "at these depths", true},
  };
}

Environment load_environment(const std::string& path) {
  const TomlValue document = load_toml(path);
  Environment e;
  if (document.find("surface")) e.surface.emplace();
  if (document.find("bottom")) e.bottom.emplace();
  read_keys(path, document, environment_keys(e), "", others_of_run(document));
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
  set_key(environment_keys(e), name, value, "");
}

std::string environment_as_toml(const Environment& e) {
  Environment written = e;
  return keys_as_toml(environment_keys(written));
}

std::vector<std::string> environment_key_names() {
  Environment e;
  std::vector<std::string> names = names_of(environment_keys(e));
  std::erase_if(names, [](const std::string& name) { return name.starts_with("profile."); });
  return names;
}

}  // namespace insonify
