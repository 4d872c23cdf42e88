#include "store/mission_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/text.hpp"
#include "core/units.hpp"
#include "files/utc.hpp"
#include "store/csv_tables.hpp"
#include "store/mission_table_internal.hpp"
#include "store/run_directory.hpp"
#include "store/sonar_file.hpp"
#include "store/toml_tree_internal.hpp"
#include "survey/navigation_errors.hpp"
#include "survey/waypoint_trajectory.hpp"

namespace insonify {
namespace {

using Kind = TomlValue::Kind;
using Eigen::Vector3d;

constexpr int mission_schema = 1;

const std::vector<MissionKey<Anchor>> anchor_keys = {
    {"latitude_deg", [](const MissionEntry& e, Anchor& a) { a.latitude_deg = e.number(); }},
    {"longitude_deg", [](const MissionEntry& e, Anchor& a) { a.longitude_deg = e.number(); }},
    {"heading_deg", [](const MissionEntry& e, Anchor& a) { a.heading_deg = e.number(); }}};

Anchor read_anchor(const MissionEntry& e) {
  Anchor anchor;
  read_table(e, anchor_keys, anchor);
  if (!(std::abs(anchor.latitude_deg) <= 90))
    e.refuse(": latitude_deg = ", anchor.latitude_deg, ", must be within -90 and 90");
  if (!(std::abs(anchor.longitude_deg) <= 360))
    e.refuse(": longitude_deg = ", anchor.longitude_deg, ", must be within -360 and 360");
  return anchor;
}

/// "2026-05-01T08:30:00Z", perhaps with fractions of the second.
std::string read_utc(const MissionEntry& e) {
  const std::string text = e.text();
  try {
    utc_after(text, 0);
  } catch (const Error&) {
    e.refuse(" = '", text, "', must be a time of UTC like 2026-05-01T08:30:00Z");
  }
  return text;
}

const std::vector<MissionKey<MissionFile>> survey_keys = {
    {"scene", [](const MissionEntry& e, MissionFile& m) { m.scene = e.file_path(); }},
    {"seed", [](const MissionEntry& e, MissionFile& m) { m.seed = e.seed(); }},
    {"coverage", [](const MissionEntry& e, MissionFile& m) { m.coverage = e.flag(); }},
    {"environment", [](const MissionEntry& e, MissionFile& m) { m.environment = e.file_path(); }},
    {"profile", [](const MissionEntry& e, MissionFile& m) { m.profile = e.file_path(); }},
    {"start_utc", [](const MissionEntry& e, MissionFile& m) { m.start_utc = read_utc(e); }},
    {"anchor", [](const MissionEntry& e, MissionFile& m) { m.anchor = read_anchor(e); }}};

const std::vector<MissionKey<NavigationNoise>> noise_keys = {
    {"position_m", [](const MissionEntry& e, NavigationNoise& n) { n.position = e.number(); }},
    {"heading_deg", [](const MissionEntry& e, NavigationNoise& n) { n.heading = e.angle(); }},
    {"attitude_deg", [](const MissionEntry& e, NavigationNoise& n) { n.attitude = e.angle(); }},
    {"correlation_s", [](const MissionEntry& e, NavigationNoise& n) { n.correlation_time = e.positive(); }}};

/// Text of printable ASCII, as formats of other programs hold it.
std::string read_datum(const MissionEntry& e) {
  const std::string text = e.text();
  const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
  if (text.empty() || text.size() > 32 || !printable)
    e.refuse(" = '", text, "', must be 1 to 32 printable characters without blanks, such as MSL or LAT");
  return text;
}

const std::vector<MissionKey<MissionWater>> water_keys = {
    {"level_m",
     [](const MissionEntry& e, MissionWater& w) {
       w.level = e.number();
       if (!std::isfinite(*w.level)) e.refuse(" = ", *w.level, ", must be finite");
     }},
    {"datum", [](const MissionEntry& e, MissionWater& w) { w.datum = read_datum(e); }}};

const std::vector<MissionKey<Randomisation>> randomise_keys = {
    {"source_level_db", [](const MissionEntry& e, Randomisation& r) { r.source_level_db = e.not_negative(); }},
    {"noise_db", [](const MissionEntry& e, Randomisation& r) { r.noise_db = e.not_negative(); }},
    {"temperature_c", [](const MissionEntry& e, Randomisation& r) { r.temperature_c = e.not_negative(); }},
    {"salinity_psu", [](const MissionEntry& e, Randomisation& r) { r.salinity_psu = e.not_negative(); }},
    {"position_m", [](const MissionEntry& e, Randomisation& r) { r.position = e.not_negative(); }},
    {"heading_deg", [](const MissionEntry& e, Randomisation& r) { r.heading = radians(e.not_negative()); }},
    {"attitude_deg", [](const MissionEntry& e, Randomisation& r) { r.attitude = radians(e.not_negative()); }}};

void read_randomise(const std::string& path, const TomlValue& document, Randomisation& spread) {
  if (const TomlValue* table = document.find("randomise"))
    read_table({path, "randomise", *table}, randomise_keys, spread);
}

/// [trajectory] as it stands in the file.
struct TrajectoryTable {
  std::string file;
  bool ned = false;
  double time_offset = 0;
  std::optional<Waypoints> waypoints;
  std::optional<NavigationNoise> noise{};
  Waypoints& of_waypoints() { return waypoints ? *waypoints : waypoints.emplace(); }
};

constexpr Named<bool> frame_words[] = {{"z-up", false}, {"ned", true}};

const std::vector<MissionKey<TrajectoryTable>> trajectory_keys = {
    {"file", [](const MissionEntry& e, TrajectoryTable& t) { t.file = e.file_path(); }},
    {"frame", [](const MissionEntry& e, TrajectoryTable& t) { t.ned = e.word(frame_words); }},
    {"time_offset_s", [](const MissionEntry& e, TrajectoryTable& t) { t.time_offset = e.number(); }},
    {"waypoints_m",
     [](const MissionEntry& e, TrajectoryTable& t) { t.of_waypoints().points = e.list(&MissionEntry::vector_of); }},
    {"nav_noise", [](const MissionEntry& e, TrajectoryTable& t) { read_table(e, noise_keys, t.noise.emplace()); }},
    {"speed_m_s", [](const MissionEntry& e, TrajectoryTable& t) { t.of_waypoints().speed = e.positive(); }},
    {"turn_radius_m", [](const MissionEntry& e, TrajectoryTable& t) { t.of_waypoints().turn_radius = e.positive(); }}};

/// From north-east-down axes to z-up ones: half a turn about x, on both sides.
Pose from_ned(const Pose& pose) {
  const Eigen::AngleAxisd half(pi, Vector3d::UnitX());
  Pose turned = Pose::Identity();
  turned.linear() = half * pose.linear() * half;
  turned.translation() = Vector3d(pose.translation().x(), -pose.translation().y(), -pose.translation().z());
  return turned;
}

void read_trajectory(const std::string& path, const TomlValue& table, MissionFile& m) {
  TrajectoryTable t;
  read_table({path, "trajectory", table}, trajectory_keys, t);
  if (t.file.empty() != t.waypoints.has_value())
    fail_in_file(path, table.line, "trajectory: must have file, or waypoints_m and speed_m_s");
  m.trajectory = t.file;
  Trajectory& trajectory = m.mission.trajectory;
  if (t.waypoints)
    at_line(path, table.line, [&] { trajectory = waypoint_trajectory(*t.waypoints); });
  else
    trajectory = lower_case(t.file).ends_with(".csv") ? load_trajectory(t.file) : load_tum_trajectory(t.file);
  for (double& time : trajectory.time) time += t.time_offset;
  if (t.ned)
    for (Pose& pose : trajectory.pose) pose = from_ned(pose);
  at_line(path, table.line, [&] { require_valid(trajectory, "mission"); });
  if (t.noise) {
    at_line(path, table.line, [&] { m.mission.navigation = navigation_errors(trajectory, *t.noise, m.seed); });
    m.position_deviation = t.noise->position;
  }
}

constexpr Named<bool> side_words[] = {{"port", false}, {"starboard", true}};
constexpr Named<ScanMode> scan_words[] = {
    {"continuous", ScanMode::continuous}, {"sector", ScanMode::sector}, {"single", ScanMode::single}};

/// A head with its sonar.
struct HeadTable {
  MissionHead head;
  MissionSonar sonar;
  Vector3d offset = Vector3d::Zero();
  std::optional<Vector3d> angles{};
  bool starboard = false;
  double rate = 0, dwell = 0;
};

const std::vector<MissionKey<HeadTable>> scan_keys = {
    {"start_deg", [](const MissionEntry& e, HeadTable& h) { h.head.scan->start = e.angle(); }},
    {"stop_deg", [](const MissionEntry& e, HeadTable& h) { h.head.scan->stop = e.angle(); }},
    {"step_deg", [](const MissionEntry& e, HeadTable& h) { h.head.scan->step = e.angle(); }},
    {"mode", [](const MissionEntry& e, HeadTable& h) { h.head.scan->mode = e.word(scan_words); }},
    {"dwell_s", [](const MissionEntry& e, HeadTable& h) { h.dwell = e.positive(); }}};

const std::vector<MissionKey<HeadTable>> head_keys = {
    {"name", [](const MissionEntry& e, HeadTable& h) { h.head.name = e.text(); }},
    {"sonar", [](const MissionEntry& e, HeadTable& h) { h.sonar.sonar = e.text(); }},
    {"range", [](const MissionEntry& e, HeadTable& h) { h.sonar.range = e.text(); }},
    {"set", [](const MissionEntry& e, HeadTable& h) { h.sonar.settings = e.list(&MissionEntry::text_of); }},
    {"offset_m", [](const MissionEntry& e, HeadTable& h) { h.offset = e.vector(); }},
    {"angles_deg", [](const MissionEntry& e, HeadTable& h) { h.angles = e.vector() * radians(1); }},
    {"side", [](const MissionEntry& e, HeadTable& h) { h.starboard = e.word(side_words); }},
    {"rate_hz", [](const MissionEntry& e, HeadTable& h) { h.rate = e.positive(); }},
    {"every_m", [](const MissionEntry& e, HeadTable& h) { h.head.distance = e.positive(); }},
    {"times_s", [](const MissionEntry& e, HeadTable& h) { h.head.times = e.list(&MissionEntry::number_of); }},
    {"scan", [](const MissionEntry& e, HeadTable& h) {
       h.head.scan = HeadScan{0, 2 * pi, radians(1)};
       read_table(e, scan_keys, h);
     }}};

void read_head(const std::string& path, const TomlValue& table, MissionFile& m) {
  HeadTable h;
  read_table({path, "head", table}, head_keys, h);
  if (h.sonar.sonar.empty()) fail_in_file(path, table.line, "missing key 'sonar'");
  if (h.head.name.empty()) h.head.name = h.sonar.sonar;
  if (h.rate > 0 && h.dwell > 0)
    fail_in_file(path, table.line, "rate_hz and dwell_s say the same thing; leave one out");
  if (h.rate > 0 || h.dwell > 0) h.head.interval = h.rate > 0 ? 1 / h.rate : h.dwell;
  if (!h.angles) at_line(path, table.line, [&] { h.angles = find_sonar(h.sonar.sonar).mounting; });
  const Vector3d angles = h.starboard ? h.angles->cwiseProduct(Vector3d(-1, 1, -1)) : *h.angles;
  h.head.vehicle_from_head = pose_from_yaw_pitch_roll(h.offset, angles[0], angles[1], angles[2]);
  m.mission.heads.push_back(h.head);
  m.sonars.push_back(h.sonar);
  at_line(path, table.line, [&] { require_valid_head(m.mission, m.mission.heads.size() - 1, "mission"); });
}

const std::vector<MissionKey<MissionLeg>> leg_keys = {
    {"name", [](const MissionEntry& e, MissionLeg& l) { l.name = e.text(); }},
    {"from_s", [](const MissionEntry& e, MissionLeg& l) { l.from = e.number(); }},
    {"to_s", [](const MissionEntry& e, MissionLeg& l) { l.to = e.number(); }},
    {"active", [](const MissionEntry& e, MissionLeg& l) { l.active = e.flag(); }},
    {"heads", [](const MissionEntry& e, MissionLeg& l) { l.heads = e.list(&MissionEntry::text_of); }},
    {"rate_hz", [](const MissionEntry& e, MissionLeg& l) { l.interval = 1 / e.positive(); }},
    {"every_m", [](const MissionEntry& e, MissionLeg& l) { l.distance = e.positive(); }}};

void read_leg(const std::string& path, const TomlValue& table, MissionFile& m) {
  MissionLeg leg;
  leg.from = m.mission.legs.empty() ? m.mission.trajectory.time.front() : m.mission.legs.back().to;
  leg.to = m.mission.trajectory.time.back();
  read_table({path, "leg", table}, leg_keys, leg);
  m.mission.legs.push_back(leg);
  at_line(path, table.line, [&] { require_valid_leg(m.mission, m.mission.legs.size() - 1, "mission"); });
}

/// Reads every [[name]].
template <typename Read>
void read_each(const std::string& path, const TomlValue& document, const char* name, const Read& read) {
  const TomlValue* tables = document.find(name);
  if (!tables) return;
  if (tables->kind != Kind::array) fail_in_file(path, tables->line, name, " must be a list of tables: [[", name, "]]");
  for (const TomlValue& table : tables->items) read(with_template(path, document, table));
}

const TomlValue& required_table(const std::string& path, const TomlValue& document, const char* name) {
  const TomlValue* table = document.find(name);
  if (!table) fail_in_file(path, document.line, "missing table [", name, "]");
  return *table;
}

}  // namespace

SurveyFrame load_survey_frame(const std::string& path) {
  const TomlValue document = load_toml(path);
  const TomlValue& survey = required_table(path, document, "survey");
  SurveyFrame frame;
  if (const TomlValue* start = survey.find("start_utc")) frame.start_utc = read_utc({path, "start_utc", *start});
  if (const TomlValue* anchor = survey.find("anchor")) frame.anchor = read_anchor({path, "anchor", *anchor});
  return frame;
}

SurveyRandomisation load_survey_randomisation(const std::string& path) {
  const TomlValue document = load_toml(path);
  const TomlValue& survey = required_table(path, document, "survey");
  SurveyRandomisation found;
  if (const TomlValue* seed = survey.find("seed")) found.seed = MissionEntry{path, "seed", *seed}.seed();
  read_randomise(path, document, found.spread);
  return found;
}

MissionFile load_mission(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_known_keys(
      path, document,
      {"schema", "survey", "trajectory", "head", "leg", "template", "water", "scene", "ping", "randomise"});
  if (const double schema = toml_number(path, document, "schema"); schema != mission_schema)
    fail_in_file(path, document.find("schema")->line, "schema = ", schema, ", this version reads schema ",
                 mission_schema, schema > mission_schema ? "; the mission is of a newer insonify" : "");
  MissionFile m;
  m.path = path;
  m.text = read_text_file(path);
  const TomlValue& survey = required_table(path, document, "survey");
  read_table({path, "survey", survey}, survey_keys, m);
  if (m.scene.empty()) fail_in_file(path, survey.line, "missing key 'scene'");
  read_randomise(path, document, m.randomise);
  if (const TomlValue* water = document.find("water")) read_table({path, "water", *water}, water_keys, m.water);
  read_trajectory(path, required_table(path, document, "trajectory"), m);
  read_each(path, document, "head", [&](const TomlValue& table) { read_head(path, table, m); });
  if (m.mission.heads.empty()) fail_in_file(path, document.line, "missing table [[head]]");
  read_each(path, document, "leg", [&](const TomlValue& table) { read_leg(path, table, m); });
  return m;
}

}  // namespace insonify
