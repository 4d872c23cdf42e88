#include "store/mission_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/text.hpp"
#include "core/units.hpp"
#include "simulate/waypoint_trajectory.hpp"
#include "store/csv_tables.hpp"
#include "store/run_directory.hpp"
#include "store/sonar_file.hpp"
#include "store/toml_tree_internal.hpp"

namespace insonify {
namespace {

using Kind = TomlValue::Kind;
using Eigen::Vector3d;

constexpr int mission_schema = 1;

/// A value of the file, with what an error must name.
struct Entry {
  const std::string& path;
  const char* key;
  const TomlValue& value;

  template <typename... Parts>
  [[noreturn]] void refuse(const Parts&... parts) const {
    fail_in_file(path, value.line, key, parts...);
  }
  std::string text() const {
    if (value.kind != Kind::text) refuse(" must be text in quotes");
    return value.text;
  }
  std::string file_path() const { return path_named_in(path, text()); }
  double number() const {
    if (!value.is_number()) refuse(" must be a number");
    return value.number;
  }
  double positive() const {
    if (!(number() > 0 && std::isfinite(number()))) refuse(" = ", number(), ", must be finite and > 0");
    return number();
  }
  double angle() const { return radians(number()); }
  bool flag() const {
    if (value.kind != Kind::boolean) refuse(" must be true or false");
    return value.number != 0;
  }
  std::uint64_t seed() const {
    const bool whole = value.kind == Kind::integer && value.number >= 0 && value.number < 0x1p53;
    std::uint64_t seed = static_cast<std::uint64_t>(whole ? value.number : 0);
    if (!whole && !(value.kind == Kind::text && to_number(value.text, seed)))
      refuse(" must be an integer from 0, in quotes from 2^53");
    return seed;
  }
  /// A list, member by member.
  template <typename Member>
  auto list(Member member) const {
    if (value.kind != Kind::array) refuse(" must be a list");
    std::vector<std::decay_t<decltype(member(*this))>> members;
    for (const TomlValue& item : value.items) members.push_back(member(Entry{path, key, item}));
    return members;
  }
  Vector3d vector() const {
    const std::vector<double> v = list(&Entry::number_of);
    if (v.size() != 3) refuse(" has ", v.size(), " numbers, must have three");
    return {v[0], v[1], v[2]};
  }
  static double number_of(const Entry& entry) { return entry.number(); }
  static std::string text_of(const Entry& entry) { return entry.text(); }
  static Vector3d vector_of(const Entry& entry) { return entry.vector(); }

  /// One of a table of words.
  template <typename Table>
  auto word(const Table& table) const {
    const auto* found = find_named(table, text());
    if (!found)
      refuse(" = '", text(), "', must be one of ",
             joined(table, ", ", [](const auto& row) { return std::string(row.name); }));
    return *found;
  }
};

/// A key of a table and what it sets.
template <typename Object>
using Key = std::pair<const char*, std::function<void(const Entry&, Object&)>>;

template <typename Object>
void read_table(const std::string& path, const TomlValue& table, const std::vector<Key<Object>>& keys, Object& object) {
  if (table.kind != Kind::table) fail_in_file(path, table.line, "must be a table");
  std::vector<std::string> known;
  for (const auto& [name, set] : keys) known.emplace_back(name);
  require_known_keys(path, table, known);
  for (const auto& [name, set] : keys)
    if (const TomlValue* value = table.find(name)) set({path, name, *value}, object);
}

/// Adds file and line to what `body` refuses.
template <typename Body>
void at_line(const std::string& path, int line, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    fail_in_file(path, line, error.what());
  }
}

const std::vector<Key<Anchor>> anchor_keys = {
    {"latitude_deg", [](const Entry& e, Anchor& a) { a.latitude_deg = e.number(); }},
    {"longitude_deg", [](const Entry& e, Anchor& a) { a.longitude_deg = e.number(); }},
    {"heading_deg", [](const Entry& e, Anchor& a) { a.heading_deg = e.number(); }}};

Anchor read_anchor(const Entry& e) {
  Anchor anchor;
  read_table(e.path, e.value, anchor_keys, anchor);
  if (!(std::abs(anchor.latitude_deg) <= 90))
    e.refuse(": latitude_deg = ", anchor.latitude_deg, ", must be within -90 and 90");
  if (!(std::abs(anchor.longitude_deg) <= 360))
    e.refuse(": longitude_deg = ", anchor.longitude_deg, ", must be within -360 and 360");
  return anchor;
}

/// "2026-05-01T08:30:00Z", perhaps with fractions of the second.
std::string read_utc(const Entry& e) {
  const std::string text = e.text();
  try {
    utc_after(text, 0);
  } catch (const Error&) {
    e.refuse(" = '", text, "', must be a time of UTC like 2026-05-01T08:30:00Z");
  }
  return text;
}

const std::vector<Key<MissionFile>> survey_keys = {
    {"scene", [](const Entry& e, MissionFile& m) { m.scene = e.file_path(); }},
    {"seed", [](const Entry& e, MissionFile& m) { m.seed = e.seed(); }},
    {"coverage", [](const Entry& e, MissionFile& m) { m.coverage = e.flag(); }},
    {"environment", [](const Entry& e, MissionFile& m) { m.environment = e.file_path(); }},
    {"profile", [](const Entry& e, MissionFile& m) { m.profile = e.file_path(); }},
    {"start_utc", [](const Entry& e, MissionFile& m) { m.start_utc = read_utc(e); }},
    {"anchor", [](const Entry& e, MissionFile& m) { m.anchor = read_anchor(e); }}};

/// [trajectory] as it stands in the file.
struct TrajectoryTable {
  std::string file;
  bool ned = false;
  double time_offset = 0;
  std::optional<Waypoints> waypoints;
  Waypoints& of_waypoints() { return waypoints ? *waypoints : waypoints.emplace(); }
};

constexpr Named<bool> frame_words[] = {{"z-up", false}, {"ned", true}};

const std::vector<Key<TrajectoryTable>> trajectory_keys = {
    {"file", [](const Entry& e, TrajectoryTable& t) { t.file = e.file_path(); }},
    {"frame", [](const Entry& e, TrajectoryTable& t) { t.ned = e.word(frame_words); }},
    {"time_offset_s", [](const Entry& e, TrajectoryTable& t) { t.time_offset = e.number(); }},
    {"waypoints_m", [](const Entry& e, TrajectoryTable& t) { t.of_waypoints().points = e.list(&Entry::vector_of); }},
    {"speed_m_s", [](const Entry& e, TrajectoryTable& t) { t.of_waypoints().speed = e.positive(); }},
    {"turn_radius_m", [](const Entry& e, TrajectoryTable& t) { t.of_waypoints().turn_radius = e.positive(); }}};

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
  read_table(path, table, trajectory_keys, t);
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

const std::vector<Key<HeadTable>> scan_keys = {
    {"start_deg", [](const Entry& e, HeadTable& h) { h.head.scan->start = e.angle(); }},
    {"stop_deg", [](const Entry& e, HeadTable& h) { h.head.scan->stop = e.angle(); }},
    {"step_deg", [](const Entry& e, HeadTable& h) { h.head.scan->step = e.angle(); }},
    {"mode", [](const Entry& e, HeadTable& h) { h.head.scan->mode = e.word(scan_words); }},
    {"dwell_s", [](const Entry& e, HeadTable& h) { h.dwell = e.positive(); }}};

const std::vector<Key<HeadTable>> head_keys = {
    {"name", [](const Entry& e, HeadTable& h) { h.head.name = e.text(); }},
    {"sonar", [](const Entry& e, HeadTable& h) { h.sonar.sonar = e.text(); }},
    {"range", [](const Entry& e, HeadTable& h) { h.sonar.range = e.text(); }},
    {"set", [](const Entry& e, HeadTable& h) { h.sonar.settings = e.list(&Entry::text_of); }},
    {"offset_m", [](const Entry& e, HeadTable& h) { h.offset = e.vector(); }},
    {"angles_deg", [](const Entry& e, HeadTable& h) { h.angles = e.vector() * radians(1); }},
    {"side", [](const Entry& e, HeadTable& h) { h.starboard = e.word(side_words); }},
    {"rate_hz", [](const Entry& e, HeadTable& h) { h.rate = e.positive(); }},
    {"every_m", [](const Entry& e, HeadTable& h) { h.head.distance = e.positive(); }},
    {"times_s", [](const Entry& e, HeadTable& h) { h.head.times = e.list(&Entry::number_of); }},
    {"scan", [](const Entry& e, HeadTable& h) {
       h.head.scan = HeadScan{0, 2 * pi, radians(1)};
       read_table(e.path, e.value, scan_keys, h);
     }}};

void read_head(const std::string& path, const TomlValue& table, MissionFile& m) {
  HeadTable h;
  read_table(path, table, head_keys, h);
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

const std::vector<Key<MissionLeg>> leg_keys = {
    {"name", [](const Entry& e, MissionLeg& l) { l.name = e.text(); }},
    {"from_s", [](const Entry& e, MissionLeg& l) { l.from = e.number(); }},
    {"to_s", [](const Entry& e, MissionLeg& l) { l.to = e.number(); }},
    {"active", [](const Entry& e, MissionLeg& l) { l.active = e.flag(); }},
    {"heads", [](const Entry& e, MissionLeg& l) { l.heads = e.list(&Entry::text_of); }},
    {"rate_hz", [](const Entry& e, MissionLeg& l) { l.interval = 1 / e.positive(); }},
    {"every_m", [](const Entry& e, MissionLeg& l) { l.distance = e.positive(); }}};

void read_leg(const std::string& path, const TomlValue& table, MissionFile& m) {
  MissionLeg leg;
  leg.from = m.mission.legs.empty() ? m.mission.trajectory.time.front() : m.mission.legs.back().to;
  leg.to = m.mission.trajectory.time.back();
  read_table(path, table, leg_keys, leg);
  m.mission.legs.push_back(leg);
  at_line(path, table.line, [&] { require_valid_leg(m.mission, m.mission.legs.size() - 1, "mission"); });
}

/// Reads every [[name]].
template <typename Read>
void read_each(const std::string& path, const TomlValue& document, const char* name, const Read& read) {
  const TomlValue* tables = document.find(name);
  if (!tables) return;
  if (tables->kind != Kind::array) fail_in_file(path, tables->line, name, " must be a list of tables: [[", name, "]]");
  for (const TomlValue& table : tables->items) read(table);
}

const TomlValue& required_table(const std::string& path, const TomlValue& document, const char* name) {
  const TomlValue* table = document.find(name);
  if (!table) fail_in_file(path, document.line, "missing table [", name, "]");
  return *table;
}

}  // namespace

MissionFile load_mission(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_known_keys(path, document, {"schema", "survey", "trajectory", "head", "leg", "scene", "ping"});
  if (const double schema = toml_number(path, document, "schema"); schema != mission_schema)
    fail_in_file(path, document.find("schema")->line, "schema = ", schema, ", this version reads schema ",
                 mission_schema, schema > mission_schema ? "; the mission is of a newer insonify" : "");
  MissionFile m;
  m.path = path;
  m.text = read_text_file(path);
  const TomlValue& survey = required_table(path, document, "survey");
  read_table(path, survey, survey_keys, m);
  if (m.scene.empty()) fail_in_file(path, survey.line, "missing key 'scene'");
  read_trajectory(path, required_table(path, document, "trajectory"), m);
  read_each(path, document, "head", [&](const TomlValue& table) { read_head(path, table, m); });
  if (m.mission.heads.empty()) fail_in_file(path, document.line, "missing table [[head]]");
  read_each(path, document, "leg", [&](const TomlValue& table) { read_leg(path, table, m); });
  return m;
}

}  // namespace insonify
