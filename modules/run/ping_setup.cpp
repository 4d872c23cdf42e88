// SPDX-License-Identifier: BSD-3-Clause
#include "run/ping_setup.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "run/parse_values.hpp"
#include "run/run_settings.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/resolve_ping.hpp"
#include "store/csv_tables.hpp"
#include "store/environment_file.hpp"
#include "store/toml_tree.hpp"
#include "survey/mission.hpp"

namespace insonify {
namespace {

/// Pose of the vehicle, and its motion if it follows a trajectory.
struct Track {
  Pose pose;
  Motion motion;
};

/// Refuses multipath without any boundary.
void require_boundaries(const PingOptions& o, const Environment& environment) {
  if (o.multipath && !environment.surface && !environment.bottom)
    fail(ErrorKind::argument, "--multipath: the environment has neither surface nor bottom; give their heights, e.g. ",
         "--set surface.height_m=0");
}

/// A sentence with the remedy if the range ends beyond that of the sonar's file.
std::string beyond_sonar_note(const SonarSpec& spec, const SonarFile& device) {
  const double most = device.spec.max_range;
  if (device.of_run || spec.max_range <= most) return {};
  return fmt::format(
      "the range ends at {:g} m, but {} hears only to {:g} m: echoes from beyond are computed all the same; --range "
      "{:g}:{:g} stays within the range of the device",
      spec.max_range, device.spec.name, most, spec.min_range, most);
}

/// Refuses a time that is no number.
void require_time(const PingOptions& o) {
  if (!std::isfinite(o.time)) fail(ErrorKind::argument, "--time = ", o.time, " s, must be finite");
}

/// The motion that --velocity and --turn-rate ask for.
Motion asked_motion(const PingOptions& o) {
  Motion motion;
  if (!o.velocity.empty()) motion.velocity = parse_vector("--velocity", o.velocity, "vx,vy,vz in m/s");
  if (!o.turn_rate.empty()) motion.turn_rate = parse_vector("--turn-rate", o.turn_rate, "x,y,z in deg/s") * radians(1);
  return motion;
}

Track track_of(const PingOptions& o) {
  require_time(o);
  if (o.pose.empty() == o.trajectory.empty())
    fail(ErrorKind::argument, "give either --pose or --trajectory, e.g. --pose=0,0,-3,0,10,0");
  if (o.trajectory.empty()) return {parse_pose(o.pose, o.world), asked_motion(o)};
  if (o.world != "z-up") fail(ErrorKind::argument, "--world ", o.world, ": trajectories are z-up; leave --world out");
  if (!o.velocity.empty() || !o.turn_rate.empty())
    fail(ErrorKind::argument, "--velocity and --turn-rate follow from --trajectory; leave them out");
  const Trajectory trajectory = load_trajectory(o.trajectory);
  return {pose_at(trajectory, o.time), motion_at(trajectory, o.time)};
}

/// Refuses velocities for which the echoes of a moving head are not computed.
void require_slow(const PingOptions& o, const Motion& motion, double sound_speed) {
  if (!o.velocity.empty() && !(motion.velocity.norm() < sound_speed / 100))
    fail(ErrorKind::argument, "--velocity = ", motion.velocity.norm(), " m/s, must be below ", sound_speed / 100,
         " m/s, a hundredth of the sound speed");
}

}  // namespace

namespace {

/// Where and when the head of a vehicle on its track pings.
PingEvent event_on(const Track& track, const PingOptions& o) {
  const bool mounted = !o.mount.empty();
  const Pose mount = mounted ? parse_pose(o.mount, "z-up", "--mount") : Pose::Identity();
  PingEvent event;
  event.world_from_head = mounted ? track.pose * mount : track.pose;
  Motion& motion = event.motion;
  motion = track.motion;
  // A head away from the vehicle's centre moves as the vehicle turns.
  if (mounted) motion.velocity += motion.turn_rate.cross(Eigen::Vector3d(track.pose.linear() * mount.translation()));
  event.time = o.time;
  event.number = o.ping >= 0 ? o.ping : std::llround(1000 * o.time);
  return event;
}

}  // namespace

PingEvent asked_event(const PingOptions& o) { return event_on(track_of(o), o); }

PingEvent asked_event(const PingOptions& o, const Pose& vehicle) {
  require_time(o);
  return event_on({vehicle, asked_motion(o)}, o);
}

std::string number_note(const PingEvent& event, const PingOptions& o) {
  constexpr double rounding = 1e-6;  // [ms], of times in seconds
  if (o.ping >= 0 || std::abs(1000 * event.time - static_cast<double>(event.number)) < rounding) return {};
  return fmt::format(
      "the ping has number {}, its time in whole milliseconds: any other ping within this millisecond has the same "
      "noise, waves and water; --ping gives another number",
      event.number);
}

namespace {

/// Notes on the trajectory of a ping, and on a time in one of its gaps.
std::vector<std::string> notes_on_track(const PingOptions& o) {
  std::vector<std::string> notes = trajectory_notes(o.trajectory);
  const Trajectory trajectory = load_trajectory(o.trajectory);
  if (const auto gap = gap_at(trajectory, o.time, gap_of(trajectory)))
    notes.push_back(fmt::format(
        "{} has no entry between {:g} and {:g} s: the pose at {:g} s is that of a straight line between them",
        o.trajectory, gap->from, gap->to, o.time));
  return notes;
}

/// Checks head and options of a ping at an event.
PingSetup set_up(const PingOptions& o, const PingEvent& event, HeadSetup head) {
  PingSetup setup{event, std::move(head), {}};
  setup.simulation = asked_simulation(o.common, o);
  if (!o.trajectory.empty())
    for (const std::string& note : notes_on_track(o)) setup.head.notes.push_back(note);
  if (std::string note = number_note(event, o); !note.empty()) setup.head.notes.push_back(std::move(note));
  const auto force = [&](const char* option, const std::string& stage, bool included) {
    in_words_of(fmt::format("{} {}", option, stage),
                [&] { force_stage(stage, included, event, setup.head.environment, setup.simulation); });
  };
  for (const std::string& stage : o.with) force("--with", stage, true);
  for (const std::string& stage : o.without) force("--without", stage, false);
  require_boundaries(o, setup.head.environment);
  require_depths_known(setup.head.environment, "environment");
  require_valid_settings(o, setup.simulation);
  require_slow(o, event.motion, setup.head.medium.sound_speed);
  require_valid(event, "PingSimulator");
  return setup;
}

}  // namespace

std::string mounting_text(const SonarFile& sonar) {
  if (sonar.mounting.isZero()) return "";
  const Eigen::Vector3d angles = sonar.mounting * degrees(1);
  return fmt::format("0,0,0,{:.10g},{:.10g},{:.10g}", angles.x(), angles.y(), angles.z());
}

PingSetup set_up_ping(const PingOptions& o) {
  const PingEvent event = asked_event(o);
  return set_up(o, event, set_up_head(o.common, o.run, event.world_from_head.translation().z()));
}

PingSetup set_up_any_ping(const PingOptions& o, std::optional<double> water_level) {
  return set_up(o, {}, set_up_head(o.common, o.run, std::nullopt, water_level));
}

std::vector<Eigen::Vector3d> sampled_places(const SceneCloud& scene, const Pose& pose) {
  std::vector<Eigen::Vector3d> places;
  const std::size_t step = std::max<std::size_t>(1, scene.size() / 10000);
  for (std::size_t i = 0; i < scene.size(); i += step)
    places.push_back(pose.linear().transpose() * (scene.origin - pose.translation() + scene.point[i].cast<double>()));
  return places;
}

void require_in_reach(std::vector<Eigen::Vector3d> places, const RangeGate& gate, const std::string& path) {
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end(),
                   [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
  const double range = middle->norm();
  if (range > 10 * gate.max_range)
    fail(ErrorKind::content, path, ": the middle point is ", range,
         " m from the head, more than ten times the greatest range of ", gate.max_range,
         " m; is the cloud in millimetres (--unit mm), or the pose in another frame?");
  if (range < gate.min_range / 10)
    fail(ErrorKind::content, path, ": the middle point is ", range,
         " m from the head, less than a tenth of the least range of ", gate.min_range,
         " m; is the cloud in kilometres (--unit km), or the pose in another frame?");
}

HeadSetup set_up_head(const CommonOptions& common, const RunOptions& run, std::optional<double> head_height,
                      std::optional<double> water_level) {
  const SonarFile file = find_sonar(run.sonar);
  SonarSpec spec = file.spec;
  Environment environment;
  if (!run.environment.empty()) environment = load_environment(run.environment);
  if (!run.profile.empty()) environment.profile = load_sound_speed_profile(run.profile);
  bool sets_range = false;
  for (const std::string& text : common.settings) {
    const Setting setting = parse_setting(text);
    sets_range |= setting.section == "sonar" && setting.key == "max_range_m";
    if (setting.section == "sonar")
      set_sonar_value(spec, setting.key, setting.value);
    else
      set_environment_value(environment, setting.section, setting.key, setting.value);
  }
  if (water_level) environment.water_level = water_level;
  if (!run.range.empty()) std::tie(spec.min_range, spec.max_range) = parse_range(run.range);
  HeadSetup setup = set_up_head(file, spec, std::move(environment), head_height);
  setup.range_is_own = run.range.empty() && !sets_range && !file.of_run;
  return setup;
}

HeadSetup set_up_head(const SonarFile& file, const SonarSpec& spec, Environment environment,
                      std::optional<double> head_height) {
  HeadSetup setup;
  setup.spec = spec;
  if (!file.of_run) setup.farthest = file.spec.max_range;
  setup.environment = std::move(environment);
  setup.mount = pose_from_yaw_pitch_roll({0, 0, 0}, file.mounting.x(), file.mounting.y(), file.mounting.z());
  for (const SonarNumber& n : file.numbers)
    if (n.status == "assumed" || n.status == "unknown") setup.doubtful.push_back(n);
  require_valid(setup.environment, "environment");
  const Environment there =
      head_height ? environment_at(setup.environment, *head_height, "environment") : setup.environment;
  setup.notes =
      validity_notes(there.water, setup.spec.centre_frequency, there.sound_speed_formula, there.absorption_formula);
  if (const std::string note = beyond_sonar_note(setup.spec, file); !note.empty()) setup.notes.push_back(note);
  setup.medium = medium_of(setup.environment, setup.spec.centre_frequency);
  setup.head = make_head(setup.spec, slowest_sound(setup.environment));
  return setup;
}

SceneOptions scene_of_run(const std::string& run) {
  const std::filesystem::path settings = std::filesystem::path(run) / "run.toml";
  return path_exists(settings) ? load_scene_settings(settings.string()) : SceneOptions{};
}

std::optional<View> view_of_run(const std::string& run, const WholeScene& scene, int threads) {
  const std::filesystem::path settings = std::filesystem::path(run) / "run.toml";
  if (!path_exists(settings) || !load_toml(settings.string()).find("sonar")) return std::nullopt;
  RunOptions options;
  options.sonar = options.environment = settings.string();
  const HeadSetup setup = set_up_head({}, options);
  Pose somewhere = Pose::Identity();
  const Environment& e = setup.environment;
  if (const auto surface = surface_height(e))
    somewhere.translation().z() = *surface - (e.water.depth > 0 ? e.water.depth : 1);
  return resolve_ping(scene, setup.head, {somewhere}, e, {.threads = threads}).view;
}

}  // namespace insonify
