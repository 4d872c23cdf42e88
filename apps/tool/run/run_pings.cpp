// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/run_pings.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "run/parse_values.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/csv_tables.hpp"
#include "store/environment_file.hpp"
#include "store/survey_run.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

const SurveyRunHead& head_of_survey(const SurveyRun& survey, const std::string& run, const std::string& head) {
  for (const SurveyRunHead& each : survey.heads)
    if (each.name == head || (head.empty() && survey.heads.size() == 1)) return each;
  fail(ErrorKind::argument, "--head = '", head, "' must name a head of ", run, ": ",
       shortened_list(survey.heads, ", ", &SurveyRunHead::name));
}

/// Adds what a mission says of the pings of one of its heads, if it is there and has that head.
void add_mission(const std::string& path, const std::string& head, RunPings& pings) {
  if (!path_exists(path)) return;
  MissionFile file = load_mission(path);
  const auto found = std::find_if(file.mission.heads.begin(), file.mission.heads.end(),
                                  [&](const MissionHead& each) { return each.name == head; });
  pings.anchor = file.anchor;
  if (pings.system.empty()) pings.system = file.system;
  pings.start_utc = file.start_utc;
  pings.legs = file.mission.legs;
  if (found == file.mission.heads.end()) return;
  const AssumedInstallation& assumed = found->assumed;
  pings.vehicle_from_head = assumed.vehicle_from_head.value_or(found->vehicle_from_head);
  pings.assumed_profile = file.sonars[static_cast<std::size_t>(found - file.mission.heads.begin())].assumed_profile;
  if (file.mission.random_pings == 0) {
    pings.trajectory = std::move(file.mission.trajectory);
    for (double& time : pings.trajectory->time) time += found->latency - assumed.latency.value_or(found->latency);
  }
  pings.water = file.water, pings.tide = file.mission.tide;
  pings.position_deviation = file.position_deviation;
  pings.instruments = file.instruments;
}

/// The trajectory that the run.toml of pings names, if it is there and leads their heads through all their positions; adds
/// a note if it is there and does not.
std::optional<Trajectory> named_way(const Run& sent, const Pose& vehicle_from_head, const Trajectory& positions,
                                    std::vector<std::string>& notes) {
  constexpr double same_position = 1e-3;  // [m]
  const std::string& path = sent.placement.trajectory;
  if (!is_file(path)) return {};
  const auto refused = [&](const std::string& why) {
    notes.push_back(path + ": is not the trajectory of the pings of " + sent.head.sonar + " (" + why +
                    "); their way is that through their own places");
    return std::optional<Trajectory>();
  };
  try {
    const Trajectory way = load_trajectory(path);
    for (std::size_t i = 0; i < positions.time.size(); ++i)
      if (!((pose_at(way, positions.time[i]) * vehicle_from_head.translation() - positions.pose[i].translation())
                .norm() < same_position))
        return refused(printed("it is elsewhere at %g s", positions.time[i]));
    return way;
  } catch (const Error& error) {
    return refused(error.what());
  }
}

/// The way of a single ping by its velocity, if its run.toml has one.
std::optional<Trajectory> straight_way(const Run& sent, const Trajectory& positions) {
  if (!sent.placement.velocity || positions.time.size() != 1) return {};
  Trajectory way;
  for (const double second : {-1.0, 1.0}) {
    way.time.push_back(positions.time[0] + second);
    way.pose.push_back(positions.pose[0]);
    way.pose.back().pretranslate(second * *sent.placement.velocity);
  }
  return way;
}

RunPings pings_of_survey(const std::string& run, const std::string& head_name) {
  const SurveyRun survey = load_survey_run(run);
  const SurveyRunHead& head = head_of_survey(survey, run, head_name);
  RunPings pings;
  for (const auto& [number, files, mark] : all_blocks(run, survey, head)) {
    if (path_exists(files.cube)) pings.cubes.push_back(files.cube);  // else all its pings failed
    if (path_exists(files.returns)) pings.returns.push_back(files.returns);
  }
  pings.system = StoredRun(run).system();
  const std::string settings = StoredRun(run + "/" + head.name).find("run.toml");
  if (!settings.empty()) pings.environment = load_environment(settings);
  add_mission(run + "/mission.toml", head.name, pings);
  return pings;
}

/// Reads the run directory of a ping, or of a merged head within the folder of its survey.
RunPings pings_of_directory(const std::string& run) {
  const StoredRun stored(run);
  RunPings pings;
  pings.cubes = {stored.cube()};
  if (const std::string returns = stored.find("returns.ply"); !returns.empty()) pings.returns = {returns};
  const std::string settings = stored.find("run.toml");
  if (!settings.empty()) pings.environment = load_environment(settings);
  if (!is_folder(run)) return pings;
  pings.system = stored.system();
  const fs::path folder = real_path(run), survey = folder.parent_path();
  if (!is_survey_run(survey.string())) {
    pings.sent = stored.settings();
    if (!settings.empty())
      pings.vehicle_from_head =
          pings.sent && pings.sent->placement.mount ? pose_of(*pings.sent->placement.mount) : Pose::Identity();
    return pings;
  }
  pings.system = StoredRun(survey.string()).system();
  try {
    add_mission((survey / "mission.toml").string(), folder.filename().string(), pings);
  } catch (const Error& error) {
    // A merged head stands alone.
    pings.notes.push_back(std::string(error.what()) + ": the mission of " + run +
                          " cannot be read, so ship, legs and place on the globe are unknown");
  }
  return pings;
}

}  // namespace

std::size_t leg_at(const std::vector<MissionLeg>& legs, double time) {
  constexpr double rounding = 1e-9;  // of times between legs [s]
  std::size_t number = 0;
  for (std::size_t k = 0; k < legs.size(); ++k)
    if (time >= legs[k].from - rounding) number = k + 1;
  return number;
}

Cube read_run_ping(const std::string& path, std::ptrdiff_t ping) {
  const std::string file = StoredRun(path).cube();
  Cube cube;
  if (ping >= 0) cube = read_cube(file, static_cast<std::size_t>(ping), 1);
  if (cube.pings.empty())
    fail(ErrorKind::argument, "--ping = ", ping, ", must be from 0 and below ", read_track(file).size(),
         ", the number of pings in ", path);
  return cube;
}

RunPings find_run_pings(const std::string& run, const std::string& head) {
  if (is_folder(run) && is_survey_run(run)) return pings_of_survey(run, head);
  if (is_folder(run) && !path_exists(run + "/cube.h5")) {  // a head that is not merged
    const fs::path folder = real_path(run);
    if (const fs::path survey = folder.parent_path(); is_survey_run(survey.string()))
      return pings_of_survey(survey.string(), folder.filename().string());
  }
  return pings_of_directory(run);
}

std::vector<std::string> head_names(const std::string& run) {
  std::vector<std::string> names;
  if (is_folder(run) && is_survey_run(run))
    for (const SurveyRunHead& head : load_survey_run(run).heads) names.push_back(head.name);
  return names;
}

std::string output_of_head(const std::string& output, const std::string& head) {
  fs::path path = output;
  if (!path.has_filename()) path = path.parent_path();  // a folder with a slash at its end
  return (path.parent_path() / (path.stem().string() + "-" + head + path.extension().string())).string();
}

namespace {

/// Height of the water level as it is.
std::optional<double> true_level(const RunPings& run, double time) {
  if (!run.tide.time.empty()) return water_height_at(run.tide, time);
  return run.water.level ? run.water.level : surface_height(run.environment);
}

}  // namespace

std::optional<double> water_level(const RunPings& run, double time) {
  return run.reduction ? water_height_at(*run.reduction, time) : true_level(run, time);
}

double raised_by(const RunPings& run, double time) {
  return run.reduction ? water_height_at(*run.reduction, time) - true_level(run, time).value_or(0) : 0;
}

std::optional<Pose> vehicle_pose(const RunPings& run, const Ping& ping) {
  if (!run.vehicle_from_head) return {};
  const Eigen::AngleAxisd turn(ping.scan ? ping.scan->angle : 0, Eigen::Vector3d::UnitZ());
  return ping.world_from_head * (*run.vehicle_from_head * turn).inverse();
}

std::vector<Eigen::Vector3d> ends_of(const RunPings& run) {
  std::vector<Eigen::Vector3d> ends;
  for (const std::string* path :
       {run.cubes.empty() ? nullptr : &run.cubes.front(), run.cubes.size() < 2 ? nullptr : &run.cubes.back()}) {
    if (!path) continue;
    const std::vector<TrackPoint> track = read_track(*path);
    if (track.empty()) continue;
    for (const TrackPoint& point : {track.front(), track.back()}) ends.push_back(point.world_from_head.translation());
  }
  return ends;
}

std::optional<Trajectory> way_of(const RunPings& run, std::vector<std::string>& notes) {
  if (run.trajectory) return run.trajectory;
  Trajectory way;
  for (const std::string& path : run.cubes)
    for (const TrackPoint& point : read_track(path)) {
      if (!way.time.empty() && !(point.time > way.time.back())) continue;
      way.time.push_back(point.time);
      way.pose.push_back(point.world_from_head);
    }
  if (run.sent) {
    const Pose vehicle_from_head = run.vehicle_from_head.value_or(Pose::Identity());
    if (auto named = named_way(*run.sent, vehicle_from_head, way, notes)) return named;
    if (auto straight = straight_way(*run.sent, way)) return straight;
  }
  if (way.time.size() < 2) return {};
  return way;
}

void each_ping(const RunPings& run, const std::function<void(const Cube&, const Ping&)>& use) {
  for (const std::string& path : run.cubes) read_cube_pings(path, use);
}

BottomOptions bottom_options(const Cube& cube, const Ping& ping, const RunPings& run, int per_beam) {
  BottomOptions options;
  options.sound_speed = ping.sound_speed;
  options.centre_frequency = cube.centre_frequency;
  const Pulse pulse{cube.centre_frequency, cube.bandwidth, 0};
  options.range_resolution = range_resolution(pulse, ping.sound_speed);
  options.noise_floor_db = thermal_floor_db(pulse, ping.fan);
  options.tolerance = cube.tolerance;
  options.absorption_db_per_m = ping.absorption_db_per_m;
  options.per_beam = per_beam;
  const Environment there = at_tide(run.environment, run.reduction.value_or(run.tide), ping.time);
  options.profile =
      run.assumed_profile.empty() ? there.profile : std::optional(load_sound_speed_profile(run.assumed_profile));
  options.head_depth = insonify::head_depth(there, ping.world_from_head.translation().z());
  return options;
}

double seconds_of_utc(const std::string& text) {
  if (text.empty()) return 0;
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0;
  const int read =
      std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lfZ%n", &year, &month, &day, &hour, &minute, &second, &used);
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (read != 6 || used != static_cast<int>(text.size()) || !date.ok() || hour > 23 || minute > 59 || !(second < 61))
    fail(ErrorKind::argument, "--start-utc '", text, "', must be a time of UTC as 2026-05-01T08:30:00Z");
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

}  // namespace insonify::tool
