// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "files/utc.hpp"
#include "store/mission_keys_internal.hpp"

namespace insonify {
namespace {

constexpr const char* utc_rule = "a time of UTC like 2026-05-01T08:30:00Z";

/// Returns true for a time such as "2026-05-01T08:30:00Z", also with fractions of the second.
bool is_utc(const std::string& text) {
  try {
    utc_after(text, 0);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Returns true for 1 to 32 printable ASCII characters without blanks, as the formats of other programs hold.
bool is_datum(const std::string& text) {
  const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
  return !text.empty() && text.size() <= 32 && printable;
}

/// Returns true for EPSG:N.
bool is_epsg(const std::string& text) {
  constexpr std::string_view begin = "EPSG:";
  return text.starts_with(begin) && text.size() > begin.size() && text.size() <= begin.size() + 5 &&
         text.find_first_not_of("0123456789", begin.size()) == std::string::npos;
}

constexpr Named<bool> frames[] = {{"z-up", false}, {"ned", true}};
constexpr Named<bool> height_origins[] = {{"datum", false}, {"water", true}};
constexpr Named<bool> sides[] = {{"port", false}, {"starboard", true}};
constexpr Named<ScanMode> scan_modes[] = {
    {"continuous", ScanMode::continuous}, {"sector", ScanMode::sector}, {"single", ScanMode::single}};

/// Returns access to an interval [s] as its rate [Hz]; 0: neither is given.
Member<double> rate_of(double& interval) {
  return {[&interval] { return interval > 0 ? std::optional(1 / interval) : std::nullopt; },
          [&interval](double rate) { interval = 1 / rate; }};
}

/// Returns the number of pings that share one draw of a scene's bodies; 0: all of the survey.
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

/// Returns the keys of [survey] and [trajectory].
std::vector<Key> survey_keys(MissionTables& t, MissionFile& m) {
  const NumberRule latitude{.least = -90, .most = 90}, longitude{.least = -360, .most = 360};
  return {
      {"survey", "scene", "", path(m.scene), "cloud, mesh, `.tiles` or a scene of parts ([scenes.md](scenes.md))",
       true},
      {"survey", "seed", "", seed(m.seed),
       "seed of all random numbers. Speckle belongs to the scene. Noise and reverberation of a ping depend only on the "
       "seed, the head and the number of the ping"},
      {"survey", "environment", "", path(given(m.environment)), "environment file, as for `ping`"},
      {"survey", "profile", "", path(given(m.profile)), "sound-speed profile, as for `ping`"},
      {"survey", "coverage", "", flag(m.coverage),
       "true: the survey stores for each surfel of a cloud or of tiles how it was insonified "
       "([survey.md](survey.md#coverage))"},
      {"survey", "start_utc", "", text(given(m.start_utc), utc_rule, is_utc), "time of day at the mission's time 0"},
      {"survey", "system", "", text(given(m.system), "EPSG:N, such as EPSG:32632", is_epsg),
       "projected system of the world's coordinates; default: the system that the scene's file states, which it must "
       "not contradict"},
      {"survey.anchor", "latitude_deg", "deg", number(t.anchor.latitude_deg, latitude),
       "latitude of the world's origin on the WGS 84 ellipsoid. `merge` writes anchor and time into `manifest.json`, "
       "and the track into `track.geojson` (E90)"},
      {"survey.anchor", "longitude_deg", "deg", number(t.anchor.longitude_deg, longitude),
       "longitude of the world's origin"},
      {"survey.anchor", "heading_deg", "deg", number(t.anchor.heading_deg),
       "heading of the world's x axis, clockwise from north"},
      {"trajectory", "file", "", path(given(m.trajectory)),
       "poses of the vehicle: a CSV file ([formats.md](formats.md)), or a TUM file if the extension is not `.csv`"},
      {"trajectory", "frame", "", word(t.ned, frames), "axes of the file"},
      {"trajectory", "heights_from", "", word(t.afloat, height_origins),
       "what z of file and waypoints counts from: datum is z = 0 of the world; water is the water level of `[tide]` or "
       "`water.level_m`, with which the vehicle then rises and falls"},
      {"trajectory", "time_offset_s", "s", number(t.time_offset), "time that is added to all times of the file"},
      {"trajectory", "max_gap_s", "s", number(given(t.max_gap), positive),
       "entries of the file that are farther apart than this leave a gap: no pings are sent there, which `survey` "
       "notes; across shorter intervals the vehicle moves in a straight line. Default: ten times the median interval "
       "of the file, at least 5 s"},
      {"trajectory", "waypoints_m", "m", points(given(t.way.points)),
       "points of a way that replaces the file. The vehicle follows the way at constant speed from time 0, level and "
       "looking ahead. Arcs blend the corners and take at most half of each leg"},
      {"trajectory", "speed_m_s", "m/s", number(given(t.way.speed), positive), "speed along the waypoints"},
      {"trajectory", "turn_radius_m", "m", number(t.way.turn_radius, positive), "radius of the arcs at waypoints"},
      {"trajectory.nav_noise", "position_m", "m", number(t.noise.position, not_negative),
       "standard deviation of the error in each coordinate of the estimated position. Pings are made at the true pose; "
       "poses and returns are stored at the estimated pose. The errors are a Gauss-Markov process of the seed (E98). "
       "The same mission without `nav_noise` gives the true poses"},
      {"trajectory.nav_noise", "heading_deg", "deg", angle(t.noise.heading, not_negative),
       "standard deviation of the error in the estimated heading"},
      {"trajectory.nav_noise", "attitude_deg", "deg", angle(t.noise.attitude, not_negative),
       "standard deviation of the error in the estimated pitch and in the estimated roll"},
      {"trajectory.nav_noise", "correlation_s", "s", number(t.noise.correlation_time, positive),
       "correlation time of the errors"},
  };
}

/// Returns the keys of [instruments].
std::vector<Key> instrument_keys(InstrumentDeviations& d) {
  return {
      {"instruments", "position_m", "m", number(d.position, not_negative),
       "standard deviation of each horizontal coordinate of the vehicle. The table states how good the instruments "
       "are: soundings get uncertainties (TVU and THU, E214), and nothing else changes. Without the table the "
       "deviations are those of `trajectory.nav_noise`, whose position is that of the height too"},
      {"instruments", "height_m", "m", number(d.height, not_negative),
       "standard deviation of the height of the vehicle, by heave, tide or satellites"},
      {"instruments", "heading_deg", "deg", angle(d.heading, not_negative), "standard deviation of the heading"},
      {"instruments", "attitude_deg", "deg", angle(d.attitude, not_negative),
       "standard deviation of pitch and of roll, alignment included"},
      {"instruments", "latency_s", "s", number(d.latency, not_negative),
       "standard deviation of the time of pings in that of the navigation"},
      {"instruments", "sound_speed_m_s", "m/s", number(d.sound_speed, not_negative),
       "standard deviation of the sound speed of the profile, from the head to the bottom"},
      {"instruments", "surface_sound_speed_m_s", "m/s", number(d.surface_sound_speed, not_negative),
       "standard deviation of the sound speed at the head, by which its beams are steered"},
  };
}

/// Returns the keys of [[head]] and [[leg]].
std::vector<Key> head_keys(MissionTables& t) {
  MissionLeg& leg = t.leg;
  return {
      {"head", "sonar", "", text(given(t.sonar.sonar)), "preset, or path of a sonar file", true},
      {"head", "name", "", text(given(t.head.name)),
       "name of the head and of its folder in the survey; default: the sonar's name"},
      {"head", "range", "", text(given(t.sonar.range)),
       "min:max in metres; default: the sonar's range. `make-mission` writes a range that ends with the scene. "
       "`survey` prints a note if a range ends far beyond the scene"},
      {"head", "set", "", texts(t.sonar.settings), "changes to the sonar, such as `\"sonar.beams=128\"`"},
      {"head", "offset_m", "m", vector(t.offset, "x, y, z"),
       "position of the head in vehicle axes (x forward, y port, z up)"},
      {"head", "roll_deg", "deg", angle(t.roll),
       "roll of the mounting, starboard side down, after the `mounting_deg` of the sonar file "
       "([picture](../survey.md#installation))"},
      {"head", "pitch_deg", "deg", angle(t.pitch), "pitch of the mounting, bow up"},
      {"head", "heading_deg", "deg", angle(t.heading), "heading of the mounting, clockwise from the bow"},
      {"head", "side", "", word(t.starboard, sides),
       "starboard mirrors the mounting with that of the sonar file: headings and rolls change their signs"},
      {"head", "latency_s", "s", number(t.head.latency),
       "age of the position and attitude that navigation delivers with a ping; counts by its difference from "
       "`head.assumed.latency_s`"},
      {"head", "draught_m", "m", number(given(t.head.draught)),
       "depth of the head below the water level at rest; counts by its difference from `head.assumed.draught_m`"},
      {"head", "rate_hz", "Hz", number(given(t.rate), positive),
       "pings per second; give only one of `rate_hz`, `every_m` and `times_s`"},
      {"head", "every_m", "m", number(given(t.head.distance), positive),
       "distance that the vehicle moves between two pings"},
      {"head", "times_s", "s", list(given(t.head.times)), "times of the pings"},
      {"head.scan", "start_deg", "deg", angle(t.scan.start),
       "first angle of a sweep. Between pings the head turns about its own z axis; angles are positive to port"},
      {"head.scan", "stop_deg", "deg", angle(t.scan.stop),
       "last angle of a sweep; a negative angle turns the head to starboard"},
      {"head.scan", "step_deg", "deg", angle(t.scan.step), "angle between two pings"},
      {"head.scan", "mode", "", word(t.scan.mode, scan_modes),
       "what follows a sweep: continuous begins again at the start, sector sweeps back the same way, single sends no "
       "more pings on this leg"},
      {"head.scan", "dwell_s", "s", number(given(t.dwell), positive),
       "time between two steps; default without `rate_hz`: 2 max_range / c"},
      {"leg", "name", "", text(given(leg.name)), "name of the leg. Each leg begins with a ping and a new sweep"},
      {"leg", "from_s", "s", number(leg.from),
       "time of the first ping; default: the end of the leg before, or the begin of the trajectory"},
      {"leg", "to_s", "s", number(leg.to), "time before which pings are sent; default: the end of the trajectory"},
      {"leg", "active", "", flag(leg.active), "false: the heads send no pings on this leg"},
      {"leg", "heads", "", texts(leg.heads), "names of the heads that ping on this leg; an empty list: all heads"},
      {"leg", "rate_hz", "Hz", number(rate_of(leg.interval), positive),
       "pings per second on this leg; replaces rate, distance and times of the heads"},
      {"leg", "every_m", "m", number(given(leg.distance), positive),
       "distance between two pings on this leg; replaces rate, distance and times of the heads"},
  };
}

/// Returns the keys of [head.assumed].
std::vector<Key> assumed_keys(MissionTables& t) {
  AssumedInstallation& assumed = t.head.assumed;
  return {
      {"head.assumed", "roll_deg", "deg", angle(t.assumed_roll),
       "roll of the mounting as the processing believes it ([survey.md](../survey.md#installation)). A key that is "
       "left out is as in truth"},
      {"head.assumed", "pitch_deg", "deg", angle(t.assumed_pitch), "pitch of the mounting, as believed"},
      {"head.assumed", "heading_deg", "deg", angle(t.assumed_heading), "heading of the mounting, as believed"},
      {"head.assumed", "offset_m", "m", vector(t.assumed_offset, "x, y, z"), "position of the head, as believed"},
      {"head.assumed", "latency_s", "s", number(assumed.latency),
       "age of the navigation for which the processing corrects"},
      {"head.assumed", "draught_m", "m", number(assumed.draught),
       "depth of the head below the water level at rest, as believed; `head.draught_m` is the true one"},
      {"head.assumed", "sound_speed_m_s", "m/s", number(assumed.sound_speed, {.least = 1300, .most = 1700}),
       "sound speed at the head to which the sonar is set. It steers its beams (E215) and converts delays to ranges"},
      {"head.assumed", "profile", "", path(given(t.sonar.assumed_profile)),
       "sound-speed profile by which the processing traces rays, as `export --processing-profile`, which goes before"},
  };
}

/// Returns two angles that ascend.
KeyValue angles_between(std::array<double, 2>& angles) {
  const Member<std::vector<double>> both{
      [&angles] {
        return std::vector<double>{angles[0], angles[1]};
      },
      [&angles](const std::vector<double>& given) { std::copy_n(given.begin(), angles.size(), angles.begin()); }};
  return list(both, {}, in_degrees, {.least = 2, .most = 2, .ascending = true, .text = "two numbers that ascend"});
}

/// Returns the keys of [randomise.pose].
std::vector<Key> pose_keys(MissionTables& t, RandomPoses& poses) {
  return {
      {"randomise.pose", "pings", "", number(given(t.random_pings), {.least = 1, .most = 1e8, .whole = true}),
       "number of random poses of the vehicle (E198), which replace `[trajectory]`: each head pings once at each, at "
       "rest, the i-th time at i seconds. A pose depends only on the seed and the number of the ping",
       true},
      {"randomise.pose", "box_m", "m", points(t.box),
       "two opposite corners of the box in which positions are drawn, in world axes", true},
      {"randomise.pose", "yaw_deg", "deg", angles_between(poses.yaw), "least and greatest yaw, positive to port"},
      {"randomise.pose", "pitch_deg", "deg", angles_between(poses.pitch), "least and greatest pitch, nose down"},
      {"randomise.pose", "roll_deg", "deg", angles_between(poses.roll), "least and greatest roll, starboard down"},
      {"randomise.pose", "clearance_m", "m", number(poses.clearance, not_negative),
       "least height of the vehicle above the ground below it and at eight places as far around, the bodies of the "
       "ping's draw included; a draw that is lower is drawn again. 0: any"},
  };
}

/// Returns the keys of [randomise], [water] and [tide].
std::vector<Key> water_keys(Randomisation& r, MissionWater& water, TideSeries& tide) {
  return {
      {"randomise", "source_level_db", "dB", number(r.source_level_db, not_negative),
       "half width of the uniform draw that each ping adds to the sonar's source level (E126). A draw depends only on "
       "the seed, the head and the number of the ping"},
      {"randomise", "noise_db", "dB", number(r.noise_db, not_negative),
       "half width of the draw added to the noise level of platform and electronics; the environment must give that "
       "level"},
      {"randomise", "temperature_c", "deg C", number(r.temperature_c, not_negative),
       "half width of the draw added to the temperature of the water"},
      {"randomise", "salinity_psu", "psu", number(r.salinity_psu, not_negative),
       "half width of the draw added to the salinity of the water"},
      {"randomise", "position_m", "m", number(r.position, not_negative),
       "half width of the draw added to each coordinate of the head. Cubes store the drawn poses; `insonify dataset` "
       "writes the draws, too"},
      {"randomise", "heading_deg", "deg", angle(r.heading, not_negative),
       "half width of the draw added to the yaw of the head"},
      {"randomise", "attitude_deg", "deg", angle(r.attitude, not_negative),
       "half width of the draws added to pitch and roll of the head"},
      {"randomise", "scene", "", pings_of_draw(r.scene_pings),
       "how often the bodies of a scene's `[[scatter]]` are drawn again ([scenes.md](scenes.md)): for each ping, once "
       "for the survey, or after this number of pings of a head. A draw depends only on the seed and the number of the "
       "ping"},
      {"water", "level_m", "m", number(water.level),
       "world height of the water level, for [GSF](gsf.md); default: `surface.height_m` of the environment, which must "
       "agree with a given level, else 0"},
      {"water", "datum", "",
       text(water.datum, "1 to 32 printable characters without blanks, such as MSL or LAT", is_datum),
       "name of the vertical datum at z = 0"},
      {"tide", "time_s", "s", list(given(tide.time), {}, as_it_is, {.least = 2}),
       "times of a tide in place of `water.level_m`. Between them the water level is linear (E217); a trajectory that "
       "begins before or ends after them is refused, as a tide table states nothing there"},
      {"tide", "height_m", "m", list(given(tide.height), {}, as_it_is, {.least = 2}),
       "world z of the water level at these times. The sea surface of an environment moves with it"},
      {"tide", "file", "", path(given(water.tide)), "CSV with the columns time_s and height_m instead of the lists"},
  };
}

}  // namespace

std::vector<Key> mission_keys(MissionTables& t, MissionFile& m) {
  std::vector<Key> all = survey_keys(t, m);
  for (const std::vector<Key>& more : {instrument_keys(t.instruments), head_keys(t), assumed_keys(t),
                                       water_keys(m.randomise, m.water, m.mission.tide), pose_keys(t, m.random_poses)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace insonify
