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

/// Reads [[mirror]] tables.
std::vector<Mirror> mirrors_in(const std::string& path, const TomlValue& tables) {
  std::vector<Mirror> mirrors;
  for (const TomlValue& table : tables.items) {
    MirrorEntry entry;
    read_keys(path, table, mirror_keys(entry), "mirror");
    Mirror& mirror = entry.mirror;
    const bool with_place = table.find("place_m") || table.find("normal");
    if (!mirror.corners.empty() == with_place)
      fail_in_file(path, table.line, "mirror '", mirror.name, "' must have either corners_m, or place_m and normal");
    if (!entry.size.empty() && (!with_place || entry.size.size() != 2))
      fail_in_file(path, table.line, "mirror.size_m must be [width, height] beside place_m and normal");
    if (!mirror.corners.empty()) mirror = with_corners(mirror, mirror.corners);
    if (!entry.size.empty()) mirror = with_size(mirror, entry.size[0], entry.size[1]);
    mirrors.push_back(std::move(mirror));
  }
  return mirrors;
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
      {"water", "temperature_c", "deg C", number(w.temperature_c), ""},
      {"water", "salinity_psu", "psu", number(w.salinity_psu), ""},
      {"water", "depth_m", "m", number(w.depth),
       "depth of the head, of scenes without a surface. With one, depth is `surface.height_m` or `water.level_m` less "
       "the "
       "z of the head, for each ping; a depth that is given too must agree to 1 cm"},
      {"water", "level_m", "m", number(e.water_level),
       "world z of the surface of the water, from which depth counts; it has no echoes, as `surface.height_m` has. A "
       "mission's `[water] level_m` sets it"},
      {"water", "ph", "", number(w.ph), ""},
      {"water", "latitude_deg", "deg", number(w.latitude_deg), ""},
      {"water", "sound_speed_formula", "", word(e.sound_speed_formula, sound_speed_formulas), ""},
      {"water", "absorption_formula", "", word(e.absorption_formula, absorption_formulas), ""},
      {"surface", "height_m", "m", number({e.surface, &SeaSurface::height}),
       "world z of the sea surface, from which depth counts: every head must be below it"},
      {"surface", "rms_height_m", "m", number({e.surface, &SeaSurface::rms_height}),
       "rms height of the waves; 0: smooth; default: from the wind"},
      {"surface", "scattering_db", "dB re 1 m^2/m^2", number({e.surface, &SeaSurface::scattering_strength_db}),
       "reverberation of the surface"},
      {"bottom", "height_m", "m", number({e.bottom, &FlatBottom::height}), "world z of a flat bed"},
      {"bottom", "density_ratio", "", number({e.bottom, &FlatBottom::density_ratio}),
       "sediment to water; the default of this and the next two is medium sand (APL-UW TR 9407)"},
      {"bottom", "sound_speed_ratio", "", number({e.bottom, &FlatBottom::sound_speed_ratio}), "sediment to water"},
      {"bottom", "loss", "", number({e.bottom, &FlatBottom::loss}),
       "imaginary to real part of the wavenumber in the sediment"},
      {"bottom", "rms_height_m", "m", number({e.bottom, &FlatBottom::rms_height}), "rms height of its relief"},
      {"bottom", "lambert_mu_db", "dB re 1/sr",
       number({e.bottom, &FlatBottom::lambert_mu}, {.infinite = true}, in_decibels),
       "reverberation of the bottom; at most -4.97"},
      {"volume", "scattering_db", "dB re 1 m^2/m^3", number(e.volume_scattering_db), "reverberation of the water"},
      {"wind", "speed_m_s", "m/s", number(e.wind_speed), "at 10 m height: wave height, and with `--noise` wind noise"},
      {"noise", "self_db", "dB re 1 uPa^2/Hz", number(e.self_noise_db),
       "self noise of platform and electronics, with `--noise`"},
      {"tank", "size_m", "m", vector({e.tank, &Tank::size}, "length along x, y and z"),
       "a box of water, instead of surface and bottom, with a free surface on top ([mirrors.md](mirrors.md))"},
      {"tank", "corner_m", "m", vector({e.tank, &Tank::corner}, "x, y, z"),
       "its corner of least x, y and z in the world"},
      {"tank", "reflection", "", number({e.tank, &Tank::reflection}, {.least = -1, .most = 1}),
       "of pressure, of walls and floor"},
      {"tank", "rms_height_m", "m", number({e.tank, &Tank::rms_height}, not_negative), "rms height of their roughness"},
      {"", "mirror", "", list_of_tables(), "smooth planes, see below"},
      {"profile", "depth_m", "m", list({e.profile, &SoundSpeedProfile::depth}),
       "of the sound-speed profile; `--profile` reads it from CSV. One that changes with depth needs "
       "`surface.height_m` or "
       "`water.level_m`; `--without multipath` leaves the surface's echoes out",
       true},
      {"profile", "sound_speed", "m/s", list({e.profile, &SoundSpeedProfile::sound_speed}), "at these depths", true},
  };
}

std::vector<Key> mirror_keys(MirrorEntry& entry) {
  Mirror& m = entry.mirror;
  const auto vector_of = [](Eigen::Vector3d& of, const char* meaning, bool written) {
    return omitted_if(vector(of, meaning), [=] { return !written; });
  };
  const bool endless = m.corners.empty();
  return {
      {"mirror", "name", "", text(m.name), "for messages"},
      {"mirror", "place_m", "m", vector_of(m.place, "x, y, z", endless),
       "a point of the plane; the middle, with `size_m`"},
      {"mirror", "normal", "", vector_of(m.normal, "x, y, z", endless), "into the water, of any length"},
      {"mirror", "size_m", "m", list(given(entry.size), positive),
       "width along the level direction in the plane (x, if the plane is level) and height of a rectangle; default: no "
       "edges"},
      {"mirror", "corners_m", "m", omitted_if(points(m.corners), [endless] { return endless; }),
       "instead of these: corners of a convex plane, counterclockwise as seen from the water"},
      {"mirror", "reflection", "", number(m.reflection, {.least = -1, .most = 1}),
       "of pressure; 1: rigid, -1: air behind a thin skin"},
      {"mirror", "density_kg_m3", "kg/m^3", number({m.solid, &ElasticSolid::density}, positive),
       "of a thick solid, with its speeds instead of `reflection` (E148)"},
      {"mirror", "pressure_speed", "m/s", number({m.solid, &ElasticSolid::pressure_speed}, positive),
       "of pressure waves in it"},
      {"mirror", "shear_speed", "m/s", number({m.solid, &ElasticSolid::shear_speed}, not_negative),
       "of shear waves in it; 0: a fluid"},
      {"mirror", "rms_height_m", "m", number(m.rms_height, not_negative), "rms height of its roughness"},
      {"mirror", "thickness_m", "m", number(m.thickness, not_negative),
       "captured surfels along the plane that are nearer are the mirror itself"},
  };
}

Environment load_environment(const std::string& path) {
  const TomlValue document = load_toml(path);
  Environment e;
  if (document.find("surface")) e.surface.emplace();
  if (document.find("bottom")) e.bottom.emplace();
  read_keys(path, document, environment_keys(e), "", others_of_run(document));
  if (const TomlValue* mirrors = document.find("mirror")) e.mirrors = mirrors_in(path, *mirrors);
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
  if (section == "mirror") fail(ErrorKind::argument, name, ": mirrors are set by [[mirror]] of an environment file");
  if (section == "profile")
    fail(ErrorKind::argument, name,
         ": a profile is set as a whole: by [profile] of an environment file, or by a CSV file (--profile)");
  set_key(environment_keys(e), name, value, "");
}

std::string environment_as_toml(const Environment& e) {
  Environment written = e;
  std::string text = keys_as_toml(environment_keys(written));
  for (const Mirror& mirror : e.mirrors) {
    MirrorEntry entry{mirror};
    text += (text.empty() ? "[" : "\n[") + keys_as_toml(mirror_keys(entry)).insert(8, "]");
  }
  return text;
}

std::vector<std::string> environment_key_names() {
  Environment e;
  std::vector<std::string> names = names_of(environment_keys(e));
  std::erase_if(names, [](const std::string& name) { return name.starts_with("profile.") || name == "mirror"; });
  return names;
}

}  // namespace insonify
