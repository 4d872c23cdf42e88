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
Number rate_of(double& interval) {
  return {[&interval]() -> std::optional<double> { return interval > 0 ? std::optional(1 / interval) : std::nullopt; },
          [&interval](double rate) { interval = 1 / rate; }};
}

/// A number > 0 that is 0 where it is not given.
KeyValue given_positive(double& x) {
  return omitted_if(number(at(x), positive), [&x] { return x == 0; });
}

/// Text that is empty where it is not given.
KeyValue given(KeyValue value, const std::string& text) {
  return omitted_if(std::move(value), [&text] { return text.empty(); });
}

/// How many pings have the same draw of a scene's bodies.
KeyValue pings_of_draw(std::int64_t& pings) {
  const auto set = [&pings](const TomlValue& value, const std::string&) {
    if (value.kind == TomlValue::Kind::text && (value.text == "ping" || value.text == "survey")) {
      pings = value.text == "ping" ? 1 : 0;
      return true;
    }
    const bool whole = value.kind == TomlValue::Kind::integer && value.number >= 1 && value.number < 0x1p40;
    if (whole) pings = static_cast<std::int64_t>(value.number);
    return whole;
  };
  const auto text = [&pings] {
    return pings == 0 ? as_toml("survey") : pings == 1 ? as_toml("ping") : std::to_string(pings);
  };
  return {"\"ping\", \"survey\" or a whole number of pings", set, text};
}

/// Rows of [survey].
std::vector<Key> survey_keys(MissionTables& t, MissionFile& m) {
  const NumberRule latitude{.least = -90, .most = 90}, longitude{.least = -360, .most = 360};
  return {
      {"survey", "scene", "", path(m.scene), "cloud, mesh, `.tiles` or a scene of parts ([scenes.md](scenes.md))",
       true},
      {"survey", "seed", "", seed(m.seed),
       "of all random numbers. Speckle belongs to the scene; noise and reverberation of ping i of a head depend on "
       "seed, "
       "head and i alone"},
      {"survey", "environment", "", given(path(m.environment), m.environment), "file as for `ping`"},
      {"survey", "profile", "", given(path(m.profile), m.profile), "file as for `ping`"},
      {"survey", "coverage", "", flag(m.coverage),
       "the survey keeps what its pings did to each surfel of a cloud or of tiles (see below)"},
      {"survey", "start_utc", "", given(text(m.start_utc, utc_rule, is_utc), m.start_utc), "time 0"},
      {"survey.anchor", "latitude_deg", "deg", number(at(t.anchor.latitude_deg), latitude),
       "of the world's origin, on the WGS 84 ellipsoid. `merge` notes anchor and time in `manifest.json` and writes "
       "`track.geojson` (E90)"},
      {"survey.anchor", "longitude_deg", "deg", number(at(t.anchor.longitude_deg), longitude), "of the world's origin"},
      {"survey.anchor", "heading_deg", "deg", number(at(t.anchor.heading_deg)),
       "of the world's x axis, clockwise from north"},
  };
}

/// Rows of [trajectory].
std::vector<Key> trajectory_keys(MissionTables& t, MissionFile& m) {
  return {
      {"trajectory", "file", "", given(path(m.trajectory), m.trajectory),
       "a CSV ([formats.md](formats.md)), or with another extension than `.csv` a TUM file: poses of the vehicle"},
      {"trajectory", "frame", "", word(t.ned, frames), "of the file"},
      {"trajectory", "time_offset_s", "s", number(at(t.time_offset)), "added to all times of the file"},
      {"trajectory", "waypoints_m", "m", points(t.way.points),
       "in place of a file: a way at constant speed from time 0, its corners blended by arcs that take at most half of "
       "each leg; the vehicle is level and looks ahead"},
      {"trajectory", "speed_m_s", "m/s", given_positive(t.way.speed), "along the waypoints"},
      {"trajectory", "turn_radius_m", "m", number(at(t.way.turn_radius), positive), "of the arcs at waypoints"},
      {"trajectory.nav_noise", "position_m", "m", number(at(t.noise.position), not_negative),
       "standard deviation of what the vehicle believes of each of its coordinates, a Gauss-Markov process of the seed "
       "(E98). Pings are made where the vehicle is; poses and returns are stored where it believes to be. The same "
       "mission without `nav_noise` is the truth"},
      {"trajectory.nav_noise", "heading_deg", "deg", number(at(t.noise.heading), not_negative, in_degrees),
       "of its heading"},
      {"trajectory.nav_noise", "attitude_deg", "deg", number(at(t.noise.attitude), not_negative, in_degrees),
       "of its pitch and roll, each"},
      {"trajectory.nav_noise", "correlation_s", "s", number(at(t.noise.correlation_time), positive),
       "time in which errors change"},
  };
}

/// Rows of a [[head]].
std::vector<Key> head_keys(MissionTables& t) {
  return {
      {"head", "sonar", "", given(text(t.sonar.sonar), t.sonar.sonar), "preset or sonar file", true},
      {"head", "name", "", given(text(t.head.name), t.head.name), "default: the sonar's; a folder of the survey"},
      {"head", "range", "", given(text(t.sonar.range), t.sonar.range),
       "min:max in metres, default the sonar's own (`make-mission` writes one that ends with the scene, and `survey` "
       "notes one that ends far beyond it)"},
      {"head", "set", "", texts(t.sonar.settings), "`\"sonar.beams=128\"` and the like"},
      {"head", "offset_m", "m", vector(t.offset, "x, y, z"), "mounting in vehicle axes (x forward, y port, z up)"},
      {"head", "angles_deg", "deg", vector(t.angles, "yaw, pitch, roll", in_degrees),
       "yaw to port, pitch nose down, roll starboard down; default: `mounting_deg` of the sonar file"},
      {"head", "side", "", word(t.starboard, sides),
       "starboard: the mirror image of the angles, yaw and roll the other way"},
      {"head", "rate_hz", "Hz", given_positive(t.rate), "how often it pings: of this and the next two keys one"},
      {"head", "every_m", "m", given_positive(t.head.distance), "pings each time the vehicle has gone so far"},
      {"head", "times_s", "s", list(t.head.times), "pings at these times"},
      {"head.scan", "start_deg", "deg", number(at(t.scan.start), {}, in_degrees),
       "the head turns about its own z axis, positive to port, between pings: from here"},
      {"head.scan", "stop_deg", "deg", number(at(t.scan.stop), {}, in_degrees),
       "to here; a negative stop turns it to starboard"},
      {"head.scan", "step_deg", "deg", number(at(t.scan.step), {}, in_degrees), "by so much"},
      {"head.scan", "mode", "", word(t.scan.mode, scan_modes),
       "at the end of a sweep: continuous from the start again, sector back the same way, single no more on this leg"},
      {"head.scan", "dwell_s", "s", given_positive(t.dwell),
       "time between steps; default, without a rate too: 2 max_range / c"},
  };
}

/// Rows of a [[leg]].
std::vector<Key> leg_keys(MissionLeg& leg) {
  return {
      {"leg", "name", "", given(text(leg.name), leg.name), "each leg begins with a ping and a new sweep"},
      {"leg", "from_s", "s", number(at(leg.from)),
       "pings are sent from here on; default: the end of the leg before, or the begin of the trajectory"},
      {"leg", "to_s", "s", number(at(leg.to)), "pings are sent before; default: the end of the trajectory"},
      {"leg", "active", "", flag(leg.active), "false: a transit without pings"},
      {"leg", "heads", "", texts(leg.heads), "that ping on this leg; none: all"},
      {"leg", "rate_hz", "Hz", number(rate_of(leg.interval), positive), "in place of what the heads say"},
      {"leg", "every_m", "m", given_positive(leg.distance), "in place of what the heads say"},
  };
}

/// Rows of [randomise] and [water].
std::vector<Key> water_keys(Randomisation& r, MissionWater& water) {
  return {
      {"randomise", "source_level_db", "dB", number(at(r.source_level_db), not_negative),
       "half width of the uniform distribution by which each ping differs from what the mission says (E126), a "
       "function "
       "of seed, head and number of the ping alone: of the sonar's source level"},
      {"randomise", "noise_db", "dB", number(at(r.noise_db), not_negative),
       "of the noise of platform and electronics, which the environment must have"},
      {"randomise", "temperature_c", "deg C", number(at(r.temperature_c), not_negative), "of the water"},
      {"randomise", "salinity_psu", "psu", number(at(r.salinity_psu), not_negative), "of the water"},
      {"randomise", "position_m", "m", number(at(r.position), not_negative),
       "of the head's coordinates. Poses are stored as they were; `insonify dataset` notes the draws"},
      {"randomise", "heading_deg", "deg", number(at(r.heading), not_negative, in_degrees), "of its yaw"},
      {"randomise", "attitude_deg", "deg", number(at(r.attitude), not_negative, in_degrees), "of its pitch and roll"},
      {"randomise", "scene", "", pings_of_draw(r.scene_pings),
       "how often the bodies of a scene's `[[scatter]]` are drawn anew ([scenes.md](scenes.md)): for each ping, once "
       "for "
       "the survey, or for every so many pings of a head; a function of seed and number of the ping"},
      {"water", "level_m", "m", number(at(water.level)),
       "height of the water level in the world, for [GSF](gsf.md); default: `surface.height_m` of the "
       "environment, from which it must not differ, else 0"},
      {"water", "datum", "",
       text(water.datum, "1 to 32 printable characters without blanks, such as MSL or LAT", is_datum),
       "name of the vertical datum z = 0"},
  };
}

}  // namespace

std::vector<Key> mission_keys(MissionTables& t, MissionFile& m) {
  std::vector<Key> all;
  for (auto& part :
       {survey_keys(t, m), trajectory_keys(t, m), head_keys(t), leg_keys(t.leg), water_keys(m.randomise, m.water)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace insonify
