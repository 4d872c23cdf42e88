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

/// Returns a pose in z-up axes from one in north-east-down axes: half a turn about x on both sides.
Pose from_ned(const Pose& pose) {
  const Eigen::AngleAxisd half(pi, Vector3d::UnitX());
  Pose turned = Pose::Identity();
  turned.linear() = half * pose.linear() * half;
  turned.translation() = Vector3d(pose.translation().x(), -pose.translation().y(), -pose.translation().z());
  return turned;
}

/// Returns the water level of a mission as a series. Throws Error(argument) if there is none.
TideSeries water_of(const MissionFile& m) {
  if (!m.mission.tide.time.empty()) return m.mission.tide;
  if (!m.water.level)
    fail(ErrorKind::argument, "trajectory.heights_from = \"water\" must come with [tide], or level_m in [water]");
  const Trajectory& way = m.mission.trajectory;
  return {{way.time.front(), way.time.back()}, {*m.water.level, *m.water.level}};
}

/// Reads the file of a tide, and refuses a second water level.
void read_tide(const std::string& path, const TomlValue& table, MissionFile& m) {
  TideSeries& tide = m.mission.tide;
  const bool lists = !tide.time.empty() || !tide.height.empty();
  if (lists != m.water.tide.empty()) fail_in_file(path, table.line, "tide: must have file, or time_s and height_m");
  if (m.water.level) fail_in_file(path, table.line, "tide: replaces level_m in [water]; leave one of them out");
  if (!m.water.tide.empty()) tide = load_tide(m.water.tide);
}

void read_trajectory(const std::string& path, const TomlValue& table, const MissionTables& t, MissionFile& m) {
  const bool along_way = table.find("waypoints_m") || table.find("speed_m_s") || table.find("turn_radius_m");
  if (m.trajectory.empty() != along_way)
    fail_in_file(path, table.line, "trajectory: must have file, or waypoints_m and speed_m_s");
  Trajectory& trajectory = m.mission.trajectory;
  if (along_way && t.max_gap > 0)
    fail_in_file(path, table.line, "trajectory.max_gap_s: is of a file; a way along waypoints has no gaps");
  if (along_way)
    at_line(path, table.line, [&] { trajectory = waypoint_trajectory(t.way); });
  else
    trajectory =
        lower_case(m.trajectory).ends_with(".csv") ? load_trajectory(m.trajectory) : load_tum_trajectory(m.trajectory);
  for (double& time : trajectory.time) time += t.time_offset;
  if (!along_way) m.mission.max_gap = t.max_gap > 0 ? t.max_gap : gap_of(trajectory);
  if (t.ned)
    for (Pose& pose : trajectory.pose) pose = from_ned(pose);
  at_line(path, table.line, [&] { require_valid(trajectory, "mission"); });
  if (t.afloat) at_line(path, table.line, [&] { trajectory = on_the_water(trajectory, water_of(m)); });
  if (table.find("nav_noise")) {
    at_line(path, table.line, [&] { m.mission.navigation = navigation_errors(trajectory, t.noise, m.seed); });
    m.position_deviation = t.noise.position;
    if (!m.instruments && (t.noise.position > 0 || t.noise.heading > 0 || t.noise.attitude > 0))
      m.instruments = {t.noise.position, t.noise.position, t.noise.heading, t.noise.attitude};
  }
}

/// Reads the limits of random poses, which replace trajectory and legs.
void read_random_poses(const std::string& path, const TomlValue& document, const TomlValue& table,
                       const MissionTables& t, MissionFile& m) {
  for (const char* other : {"trajectory", "leg"})
    if (const TomlValue* found = document.find(other))
      fail_in_file(path, found->line, "[", other,
                   "] beside [randomise.pose]: random poses have no order; leave one out");
  RandomPoses& poses = m.random_poses;
  if (t.box.size() != 2)
    fail_in_file(path, table.line, "randomise.pose.box_m has ", t.box.size(), " corners, must have two opposite ones");
  poses.low = t.box[0].cwiseMin(t.box[1]);
  poses.high = t.box[0].cwiseMax(t.box[1]);
  poses.pings = m.mission.random_pings = static_cast<std::int64_t>(t.random_pings);
  at_line(path, table.line, [&] { require_valid(poses, "randomise.pose"); });
}

/// Returns the pose of a head on its vehicle: the attitude of its sonar file (yaw, pitch, roll), turned by the mounting
/// of the mission, Rz(heading) Ry(pitch) Rx(roll) in ship axes. If one of them is zero, the other keeps its bits.
Pose vehicle_from_head(const MissionTables& t, const Vector3d& of_sonar) {
  const double mirrored = t.starboard ? -1 : 1;
  // Ship axes are half a turn about x from vehicle axes (x forward, y port, z up).
  const Vector3d turn(mirrored * -t.heading + 0.0, -t.pitch + 0.0, mirrored * t.roll + 0.0);
  const Vector3d own = of_sonar.cwiseProduct(Vector3d(mirrored, 1, mirrored));
  const Vector3d first = turn.isZero(0) ? own : turn;
  const Pose turned = pose_from_yaw_pitch_roll(t.offset, first[0], first[1], first[2]);
  if (turn.isZero(0) || own.isZero(0)) return turned;
  return turned * pose_from_yaw_pitch_roll(Vector3d::Zero(), own[0], own[1], own[2]);
}

/// Reads what the processing believes of the mounting of a head, after the head itself.
void read_assumed(const TomlValue& head, const Vector3d& of_sonar, MissionTables& t) {
  const TomlValue* table = head.find("assumed");
  if (!table) return;
  if (t.head.assumed.draught && !head.find("draught_m"))
    fail(ErrorKind::argument, "head.assumed.draught_m: the true draught must be stated, too: head.draught_m");
  MissionTables believed = t;
  believed.offset = t.assumed_offset.value_or(t.offset);
  believed.roll = t.assumed_roll.value_or(t.roll);
  believed.pitch = t.assumed_pitch.value_or(t.pitch);
  believed.heading = t.assumed_heading.value_or(t.heading);
  if (t.assumed_offset || t.assumed_roll || t.assumed_pitch || t.assumed_heading)
    t.head.assumed.vehicle_from_head = vehicle_from_head(believed, of_sonar);
}

void read_head(const std::string& path, const TomlValue& table, MissionFile& m) {
  MissionTables t;
  if (const TomlValue* angles = table.find("angles_deg"))
    fail_in_file(
        path, angles->line, "head.angles_deg: state the mounting by roll_deg (starboard side down), pitch_deg ",
        "(bow up) and heading_deg (clockwise), which turn the head after mounting_deg of the sonar file; for a ",
        "sonar without mounting_deg, angles_deg = [y, p, r] is heading_deg = -y, pitch_deg = -p, roll_deg = r");
  read_keys(path, table, mission_keys(t, m), "head");
  if (t.head.name.empty()) t.head.name = t.sonar.sonar;
  if (table.find("scan")) t.head.scan = t.scan;
  if (t.rate > 0 && t.dwell > 0)
    fail_in_file(path, table.line, "rate_hz and dwell_s say the same thing; leave one out");
  if (t.rate > 0 || t.dwell > 0) t.head.interval = t.rate > 0 ? 1 / t.rate : t.dwell;
  at_line(path, table.line, [&] {
    const Vector3d of_sonar = find_sonar(t.sonar.sonar).mounting;
    t.head.vehicle_from_head = vehicle_from_head(t, of_sonar);
    read_assumed(table, of_sonar, t);
  });
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

/// Returns the table with the keys that it lacks from the table [template.NAME], where NAME is its key `template`.
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

/// Reads every table [[name]].
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

/// Reads the tables of a mission except heads and legs, of which there may be many.
void read_tables(const std::string& path, const TomlValue& document, MissionTables& t, MissionFile& m) {
  const TomlValue& survey = required_table(path, document, "survey");
  read_keys(path, document, mission_keys(t, m), "", {"schema", "head", "leg", "template", "scene", "ping"});
  if (document.find("instruments")) m.instruments = t.instruments;
  const TomlValue* anchor = survey.find("anchor");
  if (anchor) m.anchor = t.anchor;
  if (anchor && !m.system.empty())
    fail_in_file(path, anchor->line,
                 "anchor is the place of a world with its own origin, and system that of projected ",
                 "coordinates; leave one out");
  if (const TomlValue* tide = document.find("tide")) read_tide(path, *tide, m);
}

}  // namespace

MissionFile load_mission_tables(const std::string& path) {
  MissionTables t;
  MissionFile m;
  read_tables(path, load_toml(path), t, m);
  return m;
}

MissionFile load_mission(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_schema(path, document, mission_schema);
  MissionTables t;
  MissionFile m;
  m.path = path;
  m.text = read_text_file(path);
  read_tables(path, document, t, m);
  const TomlValue* randomise = document.find("randomise");
  if (const TomlValue* pose = randomise ? randomise->find("pose") : nullptr)
    read_random_poses(path, document, *pose, t, m);
  else
    read_trajectory(path, required_table(path, document, "trajectory"), t, m);
  if (const TomlValue* tide = document.find("tide"))
    at_line(path, tide->line, [&] {
      if (m.mission.random_pings > 0) fail(ErrorKind::argument, "[tide] beside random poses, which have no time");
      require_valid(m.mission.tide, m.mission.trajectory, "mission");
    });
  read_each(path, document, "head", [&](const TomlValue& table) { read_head(path, table, m); });
  if (m.mission.heads.empty()) fail_in_file(path, document.line, "missing table [[head]]");
  read_each(path, document, "leg", [&](const TomlValue& table) { read_leg(path, table, m); });
  return m;
}

}  // namespace insonify
