// SPDX-License-Identifier: BSD-3-Clause
#include "store/environment_file.hpp"

#include "acoustics/boundary_count.hpp"
#include "core/error.hpp"
#include "store/environment_keys.hpp"

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
    if (mirrors.size() == most_mirrors)
      fail_in_file(path, table.line, tables.items.size(), " mirrors, must be at most ", most_mirrors);
    MirrorEntry entry;
    read_keys(path, table, mirror_keys(entry), "mirror");
    Mirror& mirror = entry.mirror;
    const bool with_position = table.find("place_m") || table.find("normal");
    if (!mirror.corners.empty() == with_position)
      fail_in_file(path, table.line, "mirror '", mirror.name, "' must have either corners_m, or place_m and normal");
    if (!entry.size.empty() && (!with_position || entry.size.size() != 2))
      fail_in_file(path, table.line, "mirror.size_m must be [width, height] beside place_m and normal");
    if (!mirror.corners.empty()) mirror = with_corners(mirror, mirror.corners);
    if (!entry.size.empty()) mirror = with_size(mirror, entry.size[0], entry.size[1]);
    try {
      require_valid(mirror, (path + ":" + std::to_string(table.line)).c_str());
    } catch (const Error& error) {
      fail(ErrorKind::content, error.what());
    }
    mirrors.push_back(std::move(mirror));
  }
  return mirrors;
}

/// Returns the tables of a run.toml, which is recognised by its version, that do not belong to the environment, and all
/// keys outside of tables.
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
      {"water", "temperature_c", "deg C", number(w.temperature_c), "temperature of the water"},
      {"water", "salinity_psu", "psu", number(w.salinity_psu), "salinity of the water"},
      {"water", "depth_m", "m", number(w.depth),
       "depth of the head in a scene without a surface. With `surface.height_m` or `water.level_m`, the depth of each "
       "ping is that height less the z of the head, and a given depth must agree to 1 cm"},
      {"water", "level_m", "m", number(e.water_level),
       "world z of the water's surface, from which depth counts. This surface gives no echoes; `surface.height_m` "
       "gives one that does. `[water] level_m` of a mission sets this key"},
      {"water", "ph", "", number(w.ph), "acidity (pH) of the water"},
      {"water", "latitude_deg", "deg", number(w.latitude_deg), "latitude of the scene"},
      {"water", "sound_speed_formula", "", word(e.sound_speed_formula, sound_speed_formulas),
       "formula of the sound speed"},
      {"water", "absorption_formula", "", word(e.absorption_formula, absorption_formulas), "formula of the absorption"},
      {"surface", "height_m", "m", number({e.surface, &SeaSurface::height}),
       "world z of the sea surface, from which depth counts; every head must be below the surface"},
      {"surface", "rms_height_m", "m", number({e.surface, &SeaSurface::rms_height}),
       "rms height of the waves; 0: smooth; default: from the wind speed"},
      {"surface", "scattering_db", "dB re 1 m^2/m^2", number({e.surface, &SeaSurface::scattering_strength_db}),
       "scattering strength of the surface, for reverberation"},
      {"bottom", "height_m", "m", number({e.bottom, &FlatBottom::height}), "world z of a flat bottom"},
      {"bottom", "density_ratio", "", number({e.bottom, &FlatBottom::density_ratio}),
       "density of the sediment over that of water. The default of this key and of the next two is medium sand (APL-UW "
       "TR 9407)"},
      {"bottom", "sound_speed_ratio", "", number({e.bottom, &FlatBottom::sound_speed_ratio}),
       "sound speed of the sediment over that of water"},
      {"bottom", "loss", "", number({e.bottom, &FlatBottom::loss}),
       "imaginary over real part of the wavenumber in the sediment"},
      {"bottom", "rms_height_m", "m", number({e.bottom, &FlatBottom::rms_height}), "rms height of the bottom's relief"},
      {"bottom", "lambert_mu_db", "dB re 1/sr",
       number({e.bottom, &FlatBottom::lambert_mu}, {.infinite = true}, in_decibels),
       "Lambert coefficient of the bottom, for reverberation; at most -4.97"},
      {"volume", "scattering_db", "dB re 1 m^2/m^3", number(e.volume_scattering_db),
       "scattering strength of the water, for reverberation"},
      {"wind", "speed_m_s", "m/s", number(e.wind_speed),
       "wind speed at 10 m height; sets the wave height and, with `--noise`, the wind noise"},
      {"noise", "self_db", "dB re 1 uPa^2/Hz", number(e.self_noise_db),
       "noise level of platform and electronics, used with `--noise`"},
      {"tank", "size_m", "m", vector({e.tank, &Tank::size}, "length along x, y and z"),
       "size of a box of water with a free surface on top, which replaces surface and bottom "
       "([mirrors.md](mirrors.md))"},
      {"tank", "corner_m", "m", vector({e.tank, &Tank::corner}, "x, y, z"),
       "corner of the tank with the least x, y and z in the world"},
      {"tank", "reflection", "", number({e.tank, &Tank::reflection}, {.least = -1, .most = 1}),
       "pressure reflection coefficient of walls and floor"},
      {"tank", "rms_height_m", "m", number({e.tank, &Tank::rms_height}, not_negative),
       "rms height of the roughness of walls and floor"},
      {"", "mirror", "", list_of_tables(),
       "smooth planes ([mirrors.md](mirrors.md)); the keys of a plane are in the next table"},
      {"profile", "depth_m", "m", list({e.profile, &SoundSpeedProfile::depth}),
       "depths of the sound-speed profile; `--profile` reads a profile from CSV. A profile that changes with depth "
       "needs `surface.height_m` or `water.level_m`; `--without multipath` omits the surface's echoes",
       true},
      {"profile", "sound_speed", "m/s", list({e.profile, &SoundSpeedProfile::sound_speed}),
       "sound speeds at these depths", true},
  };
}

std::vector<Key> mirror_keys(MirrorEntry& entry) {
  Mirror& m = entry.mirror;
  const auto vector_of = [](Eigen::Vector3d& of, const char* meaning, bool written) {
    return omitted_if(vector(of, meaning), [=] { return !written; });
  };
  const bool endless = m.corners.empty();
  return {
      {"mirror", "name", "", text(m.name), "name of the mirror in messages"},
      {"mirror", "place_m", "m", vector_of(m.position, "x, y, z", endless),
       "a point of the plane; with `size_m`, the middle of the rectangle"},
      {"mirror", "normal", "", vector_of(m.normal, "x, y, z", endless), "direction into the water, of any length"},
      {"mirror", "size_m", "m", list(given(entry.size), positive),
       "width and height of a rectangle. The width lies along the level direction in the plane, or along x if the "
       "plane is level; default: an endless plane"},
      {"mirror", "corners_m", "m", omitted_if(points(m.corners), [endless] { return endless; }),
       "corners of a convex plane, counterclockwise as seen from the water; they replace the three keys above"},
      {"mirror", "reflection", "", number(m.reflection, {.least = -1, .most = 1}),
       "pressure reflection coefficient; 1: rigid, -1: air behind a thin skin"},
      {"mirror", "density_kg_m3", "kg/m^3", number({m.solid, &ElasticSolid::density}, positive),
       "density of a thick solid; together with both speeds it replaces `reflection` (E148)"},
      {"mirror", "pressure_speed", "m/s", number({m.solid, &ElasticSolid::pressure_speed}, positive),
       "speed of pressure waves in the solid"},
      {"mirror", "shear_speed", "m/s", number({m.solid, &ElasticSolid::shear_speed}, not_negative),
       "speed of shear waves in the solid; 0: a fluid"},
      {"mirror", "rms_height_m", "m", number(m.rms_height, not_negative), "rms height of the roughness"},
      {"mirror", "thickness_m", "m", number(m.thickness, not_negative),
       "distance from the plane within which captured surfels count as the mirror itself"},
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

}  // namespace insonify
