// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "files/utc.hpp"
#include "store/mission_keys_internal.hpp"

namespace insonify {
namespace {

constexpr const char* utc_rule = "a time of UTC like 2026-05-01T08:30:00Z";

/// "2026-05-01T08:30:00Z", perhaps with fractions of the second.
bool is_utc(const std::string& text) {
  try {
    utc_after(text, 0);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Text of printable ASCII, as formats of other programs hold it.
bool is_datum(const std::string& text) {
  const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
  return !text.empty() && text.size() <= 32 && printable;
}

constexpr Named<bool> frames[] = {{"z-up", false}, {"ned", true}};
constexpr Named<bool> sides[] = {{"port", false}, {"starboard", true}};
constexpr Named<ScanMode> scan_modes[] = {
    {"continuous", ScanMode::continuous}, {"sector", ScanMode::sector}, {"single", ScanMode::single}};

/// A rate [Hz] of an interval [s]; 0: neither is given.
Member<double> rate_of(double& interval) {
  return {[&interval] { return interval > 0 ? std::optional(1 / interval) : std::nullopt; },
          [&interval](double rate) { interval = 1 / rate; }};
}

/// How many pings have the same draw of a scene's bodies; 0: all of the survey.
KeyValue pings_of_draw(std::int64_t& pings) {
  constexpr Named<std::int64_t> words[] = {{"ping", 1}, {"survey", 0}};
  const auto read = [=](const TomlValue& value) -> std::optional<std::int64_t> {
    if (const std::int64_t* found = find_named(words, value.text)) return *found;
    if (value.kind != TomlValue::Kind::integer || value.number < 1 || value.number >= 0x1p40) return std::nullopt;
    return static_cast<std::int64_t>(value.number);
  };
  const auto write = [=](std::int64_t number) {
    const std::string word = name_of(words, number);
    return word.empty() ? std::to_string(number) : as_toml(word);
  };
  return value_in<std::int64_t>(pings, {"\"ping\", \"survey\" or a whole number of pings", read, write});
}

/// Rows of [survey] and [trajectory].
std::vector<Key> survey_keys(MissionTables& t, MissionFile& m) {
  const NumberRule latitude{.least = -90, .most = 90}, longitude{.least = -360, .most = 360};
  return {
      {"survey", "scene", "", path(m.scene), "cloud, mesh, `.tiles` or a scene of parts ([scenes.md](scenes.md))",
       true},
      {"survey", "seed", "", seed(m.seed),
       "of all random numbers. Speckle belongs to the scene; noise and reverberation of ping i of a head depend on "
       "seed, "
       "head and i alone"},
      {"survey", "environment", "", path(given(m.environment)), "file as for `ping`"},
      {"survey", "profile", "", path(given(m.profile)), "file as for `ping`"},
      {"survey", "coverage", "", flag(m.coverage),
       "the survey keeps what its pings did to each surfel of a cloud or of tiles (see below)"},
      {"survey", "start_utc", "", text(given(m.start_utc), utc_rule, is_utc), "time 0"},
      {"survey.anchor", "latitude_deg", "deg", number(t.anchor.latitude_deg, latitude),
       "of the world's origin, on the WGS 84 ellipsoid. `merge` notes anchor and time in `manifest.json` and writes "
       "`track.geojson` (E90)"},
      {"survey.anchor", "longitude_deg", "deg", number(t.anchor.longitude_deg, longitude), "of the world's origin"},
      {"survey.anchor", "heading_deg", "deg", number(t.anchor.heading_deg),
       "of the world's x axis, clockwise from north"},
      {"trajectory", "file", "", path(given(m.trajectory)),
       "a CSV ([formats.md](formats.md)), or with another extension than `.csv` a TUM file: poses of the vehicle"},
      {"trajectory", "frame", "", word(t.ned, frames), "of the file"},
      {"trajectory", "time_offset_s", "s", number(t.time_offset), "added to all times of the file"},
      {"trajectory", "waypoints_m", "m", points(given(t.way.points)),
       "in place of a file: a way at constant speed from time 0, its corners blended by arcs that take at most half of "
       "each leg; the vehicle is level and looks ahead"},
      {"trajectory", "speed_m_s", "m/s", number(given(t.way.speed), positive), "along the waypoints"},
      {"trajectory", "turn_radius_m", "m", number(t.way.turn_radius, positive), "of the arcs at waypoints"},
      {"trajectory.nav_noise", "position_m", "m", number(t.noise.position, not_negative),
       "standard deviation of what the vehicle believes of each of its coordinates, a Gauss-Markov process of the seed "
       "(E98). Pings are made where the vehicle is; poses and returns are stored where it believes to be. The same "
       "mission without `nav_noise` is the truth"},
      {"trajectory.nav_noise", "heading_deg", "deg", angle(t.noise.heading, not_negative), "of its heading"},
      {"trajectory.nav_noise", "attitude_deg", "deg", angle(t.noise.attitude, not_negative),
       "of its pitch and roll, each"},
      {"trajectory.nav_noise", "correlation_s", "s", number(t.noise.correlation_time, positive),
       "time in which errors change"},
  };
}

/// Rows of a [[head]] and of a [[leg]].
std::vector<Key> head_keys(MissionTables& t) {
  MissionLeg& leg = t.leg;
  return {
      {"head", "sonar", "", text(given(t.sonar.sonar)), "preset or sonar file", true},
      {"head", "name", "", text(given(t.head.name)), "default: the sonar's; a folder of the survey"},
      {"head", "range", "", text(given(t.sonar.range)),
       "min:max in metres, default the sonar's own (`make-mission` writes one that ends with the scene, and `survey` "
       "notes one that ends far beyond it)"},
      {"head", "set", "", texts(t.sonar.settings), "`\"sonar.beams=128\"` and the like"},
      {"head", "offset_m", "m", vector(t.offset, "x, y, z"), "mounting in vehicle axes (x forward, y port, z up)"},
      {"head", "angles_deg", "deg", vector(t.angles, "yaw, pitch, roll", in_degrees),
       "yaw to port, pitch nose down, roll starboard down; default: `mounting_deg` of the sonar file"},
      {"head", "side", "", word(t.starboard, sides),
       "starboard: the mirror image of the angles, yaw and roll the other way"},
      {"head", "rate_hz", "Hz", number(given(t.rate), positive),
       "how often it pings: of this and the next two keys one"},
      {"head", "every_m", "m", number(given(t.head.distance), positive), "pings each time the vehicle has gone so far"},
      {"head", "times_s", "s", list(given(t.head.times)), "pings at these times"},
      {"head.scan", "start_deg", "deg", angle(t.scan.start),
       "the head turns about its own z axis, positive to port, between pings: from here"},
      {"head.scan", "stop_deg", "deg", angle(t.scan.stop), "to here; a negative stop turns it to starboard"},
      {"head.scan", "step_deg", "deg", angle(t.scan.step), "by so much"},
      {"head.scan", "mode", "", word(t.scan.mode, scan_modes),
       "at the end of a sweep: continuous from the start again, sector back the same way, single no more on this leg"},
      {"head.scan", "dwell_s", "s", number(given(t.dwell), positive),
       "time between steps; default, without a rate too: 2 max_range / c"},
      {"leg", "name", "", text(given(leg.name)), "each leg begins with a ping and a new sweep"},
      {"leg", "from_s", "s", number(leg.from),
       "pings are sent from here on; default: the end of the leg before, or the begin of the trajectory"},
      {"leg", "to_s", "s", number(leg.to), "pings are sent before; default: the end of the trajectory"},
      {"leg", "active", "", flag(leg.active), "false: a transit without pings"},
      {"leg", "heads", "", texts(leg.heads), "that ping on this leg; none: all"},
      {"leg", "rate_hz", "Hz", number(rate_of(leg.interval), positive), "in place of what the heads say"},
      {"leg", "every_m", "m", number(given(leg.distance), positive), "in place of what the heads say"},
  };
}

/// Rows of [randomise] and [water].
std::vector<Key> water_keys(Randomisation& r, MissionWater& water) {
  return {
      {"randomise", "source_level_db", "dB", number(r.source_level_db, not_negative),
       "half width of the uniform distribution by which each ping differs from what the mission says (E126), a "
       "function "
       "of seed, head and number of the ping alone: of the sonar's source level"},
      {"randomise", "noise_db", "dB", number(r.noise_db, not_negative),
       "of the noise of platform and electronics, which the environment must have"},
      {"randomise", "temperature_c", "deg C", number(r.temperature_c, not_negative), "of the water"},
      {"randomise", "salinity_psu", "psu", number(r.salinity_psu, not_negative), "of the water"},
      {"randomise", "position_m", "m", number(r.position, not_negative),
       "of the head's coordinates. Poses are stored as they were; `insonify dataset` notes the draws"},
      {"randomise", "heading_deg", "deg", angle(r.heading, not_negative), "of its yaw"},
      {"randomise", "attitude_deg", "deg", angle(r.attitude, not_negative), "of its pitch and roll"},
      {"randomise", "scene", "", pings_of_draw(r.scene_pings),
       "how often the bodies of a scene's `[[scatter]]` are drawn anew ([scenes.md](scenes.md)): for each ping, once "
       "for "
       "the survey, or for every so many pings of a head; a function of seed and number of the ping"},
      {"water", "level_m", "m", number(water.level),
       "height of the water level in the world, for [GSF](gsf.md); default: `surface.height_m` of the "
       "environment, from which it must not differ, else 0"},
      {"water", "datum", "",
       text(water.datum, "1 to 32 printable characters without blanks, such as MSL or LAT", is_datum),
       "name of the vertical datum z = 0"},
  };
}

}  // namespace

std::vector<Key> mission_keys(MissionTables& t, MissionFile& m) {
  std::vector<Key> all = survey_keys(t, m);
  for (const std::vector<Key>& more : {head_keys(t), water_keys(m.randomise, m.water)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace insonify
