// SPDX-License-Identifier: BSD-3-Clause
#include "store/mission_file.hpp"

#include <utility>

#include "core/text.hpp"
#include "files/utc.hpp"
#include "store/csv_tables.hpp"
#include "store/mission_keys_internal.hpp"
#include "store/run_directory.hpp"
#include "store/sonar_file.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr int mission_schema = 1;

/// From north-east-down axes to z-up ones: half a turn about x, on both sides.
Pose from_ned(const Pose& pose) {
  const Eigen::AngleAxisd half(pi, Vector3d::UnitX());
  Pose turned = Pose::Identity();
  turned.linear() = half * pose.linear() * half;
  turned.translation() = Vector3d(pose.translation().x(), -pose.translation().y(), -pose.translation().z());
  return turned;
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

void read_trajectory(const std::string& path, const TomlValue& table, const MissionTables& t, MissionFile& m) {
  const bool along_way = table.find("waypoints_m") || table.find("speed_m_s") || table.find("turn_radius_m");
  if (m.trajectory.empty() != along_way)
    fail_in_file(path, table.line, "trajectory: must have file, or waypoints_m and speed_m_s");
  Trajectory& trajectory = m.mission.trajectory;
  if (along_way)
    at_line(path, table.line, [&] { trajectory = waypoint_trajectory(t.way); });
  else
    trajectory =
        lower_case(m.trajectory).ends_with(".csv") ? load_trajectory(m.trajectory) : load_tum_trajectory(m.trajectory);
  for (double& time : trajectory.time) time += t.time_offset;
  if (t.ned)
    for (Pose& pose : trajectory.pose) pose = from_ned(pose);
  at_line(path, table.line, [&] { require_valid(trajectory, "mission"); });
  if (table.find("nav_noise")) {
    at_line(path, table.line, [&] { m.mission.navigation = navigation_errors(trajectory, t.noise, m.seed); });
    m.position_deviation = t.noise.position;
  }
}

void read_head(const std::string& path, const TomlValue& table, MissionFile& m) {
  MissionTables t;
  read_keys(path, table, mission_keys(t, m), "head");
  if (t.head.name.empty()) t.head.name = t.sonar.sonar;
  if (table.find("scan")) t.head.scan = t.scan;
  if (t.rate > 0 && t.dwell > 0)
    fail_in_file(path, table.line, "rate_hz and dwell_s say the same thing; leave one out");
  if (t.rate > 0 || t.dwell > 0) t.head.interval = t.rate > 0 ? 1 / t.rate : t.dwell;
  if (!table.find("angles_deg")) at_line(path, table.line, [&] { t.angles = find_sonar(t.sonar.sonar).mounting; });
  const Vector3d angles = t.starboard ? t.angles.cwiseProduct(Vector3d(-1, 1, -1)) : t.angles;
  t.head.vehicle_from_head = pose_from_yaw_pitch_roll(t.offset, angles[0], angles[1], angles[2]);
  m.mission.heads.push_back(t.head);
  m.sonars.push_back(t.sonar);
  at_line(path, table.line, [&] { require_valid_head(m.mission, m.mission.heads.size() - 1, "mission"); });
}

void read_leg(const std::string& path, const TomlValue& table, MissionFile& m) {
  MissionTables t;
  t.leg.from = m.mission.legs.empty() ? m.mission.trajectory.time.front() : m.mission.legs.back().to;
  t.leg.to = m.mission.trajectory.time.back();
  read_keys(path, table, mission_keys(t, m), "leg");
  m.mission.legs.push_back(t.leg);
  at_line(path, table.line, [&] { require_valid_leg(m.mission, m.mission.legs.size() - 1, "mission"); });
}

/// The table with what it takes from the table [template.NAME] that its key `template` names: the keys that it lacks.
/// Throws Error(content) if there is no such template.
TomlValue with_template(const std::string& path, const TomlValue& document, const TomlValue& table) {
  const TomlValue* name = table.find("template");
  if (!name) return table;
  const std::string wanted = toml_text(path, table, "template");
  const TomlValue* templates = document.find("template");
  const TomlValue* found = templates ? templates->find(wanted) : nullptr;
  if (!found || found->kind != TomlValue::Kind::table)
    fail_in_file(path, name->line, "template = '", wanted, "': there is no table [template.", wanted, "]");

  TomlValue whole = table;
  std::erase(whole.keys, "template");
  whole.items.clear();
  for (const std::string& key : whole.keys) whole.items.push_back(*table.find(key));
  for (std::size_t k = 0; k < found->keys.size(); ++k)
    if (!table.find(found->keys[k])) {
      whole.keys.push_back(found->keys[k]);
      whole.items.push_back(found->items[k]);
    }
  return whole;
}

/// Reads every [[name]].
template <typename Read>
void read_each(const std::string& path, const TomlValue& document, const char* name, const Read& read) {
  const TomlValue* tables = document.find(name);
  if (!tables) return;
  if (tables->kind != TomlValue::Kind::array)
    fail_in_file(path, tables->line, name, " must be a list of tables: [[", name, "]]");
  for (const TomlValue& table : tables->items) read(with_template(path, document, table));
}

const TomlValue& required_table(const std::string& path, const TomlValue& document, const char* name) {
  const TomlValue* table = document.find(name);
  if (!table) fail_in_file(path, document.line, "missing table [", name, "]");
  return *table;
}

/// Reads the tables of a mission but for heads and legs, of which there may be many.
void read_tables(const std::string& path, const TomlValue& document, MissionTables& t, MissionFile& m) {
  const TomlValue& survey = required_table(path, document, "survey");
  read_keys(path, document, mission_keys(t, m), "", {"schema", "head", "leg", "template", "scene", "ping"});
  if (survey.find("anchor")) m.anchor = t.anchor;
}

}  // namespace

SurveyFrame load_survey_frame(const std::string& path) {
  MissionTables t;
  MissionFile m;
  read_tables(path, load_toml(path), t, m);
  return {m.start_utc, m.anchor};
}

SurveyRandomisation load_survey_randomisation(const std::string& path) {
  MissionTables t;
  MissionFile m;
  read_tables(path, load_toml(path), t, m);
  return {m.randomise, m.seed};
}

MissionFile load_mission(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_schema(path, document, mission_schema);
  MissionTables t;
  MissionFile m;
  m.path = path;
  m.text = read_text_file(path);
  read_tables(path, document, t, m);
  read_trajectory(path, required_table(path, document, "trajectory"), t, m);
  read_each(path, document, "head", [&](const TomlValue& table) { read_head(path, table, m); });
  if (m.mission.heads.empty()) fail_in_file(path, document.line, "missing table [[head]]");
  read_each(path, document, "leg", [&](const TomlValue& table) { read_leg(path, table, m); });
  return m;
}

}  // namespace insonify
