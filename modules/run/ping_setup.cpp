// SPDX-License-Identifier: BSD-3-Clause
#include "run/ping_setup.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "run/mission_heads.hpp"
#include "run/parse_values.hpp"
#include "run/run_settings.hpp"
#include "simulate/plan_ping.hpp"
#include "store/csv_tables.hpp"
#include "store/environment_file.hpp"
#include "store/key_table.hpp"
#include "survey/mission.hpp"

namespace insonify {
namespace {

/// Pose of the vehicle, and its motion if it follows a trajectory.
struct Track {
  Pose pose;
  Motion motion;
};

/// A sentence with the remedy if the range ends beyond that of the sonar's file.
std::string beyond_sonar_note(const SonarSpec& spec, const SonarFile& device) {
  const double most = device.spec.max_range;
  if (device.of_run || spec.max_range <= most) return {};
  return fmt::format(
      "the range ends at {:g} m, but {} hears only to {:g} m: echoes from beyond are computed all the same; --range "
      "{:g}:{:g} stays within the range of the device",
      spec.max_range, device.spec.name, most, spec.min_range, most);
}

Track track_of(const Placement& p) {
  if (!std::isfinite(p.time)) fail(ErrorKind::argument, "--time = ", p.time, " s, must be finite");
  if (p.pose.has_value() != p.trajectory.empty())
    fail(ErrorKind::argument, "give either --pose or --trajectory, e.g. --pose=0,0,-3,0,10,0");
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  if (p.pose) return {pose_of(*p.pose, p.world), {p.velocity.value_or(none), p.turn_rate.value_or(none) * radians(1)}};
  if (p.world != WorldAxes::z_up)
    fail(ErrorKind::argument, "--world ", name_of(world_words, p.world), ": trajectories are z-up; leave --world out");
  if (p.velocity || p.turn_rate)
    fail(ErrorKind::argument, "--velocity and --turn-rate follow from --trajectory; leave them out");
  const Trajectory trajectory = load_trajectory(p.trajectory);
  return {pose_at(trajectory, p.time), motion_at(trajectory, p.time)};
}

/// Refuses velocities for which the echoes of a moving head are not computed.
void require_slow(const Placement& p, const Motion& motion, double sound_speed) {
  if (p.velocity && !(motion.velocity.norm() < sound_speed / 100))
    fail(ErrorKind::argument, "--velocity = ", motion.velocity.norm(), " m/s, must be below ", sound_speed / 100,
         " m/s, a hundredth of the sound speed");
}

/// Notes on the trajectory of a ping, and on a time in one of its gaps.
std::vector<std::string> notes_on_track(const Placement& p) {
  std::vector<std::string> notes = trajectory_notes(p.trajectory);
  const Trajectory trajectory = load_trajectory(p.trajectory);
  if (const auto gap = gap_at(trajectory, p.time, gap_of(trajectory)))
    notes.push_back(fmt::format(
        "{} has no entry between {:g} and {:g} s: the pose at {:g} s is that of a straight line between them",
        p.trajectory, gap->from, gap->to, p.time));
  return notes;
}

/// Drops the contributors of pings: surveys keep the labels that follow from them.
struct DroppedContributors : ContributorSink {
  void take(const Contributors&, std::size_t) override {}
};

}  // namespace

PingEvent requested_event(const Placement& p) {
  const Track track = track_of(p);
  const Pose mount = p.mount ? pose_of(*p.mount) : Pose::Identity();
  PingEvent event;
  event.world_from_head = p.mount ? track.pose * mount : track.pose;
  Motion& motion = event.motion;
  motion = track.motion;
  // A head away from the vehicle's centre moves as the vehicle turns.
  if (p.mount) motion.velocity += motion.turn_rate.cross(Eigen::Vector3d(track.pose.linear() * mount.translation()));
  event.time = p.time;
  event.number = p.number >= 0 ? p.number : std::llround(1000 * p.time);
  return event;
}

std::string number_note(const PingEvent& event, const Placement& p) {
  constexpr double rounding = 1e-6;  // [ms], of times in seconds
  if (p.number >= 0 || std::abs(1000 * event.time - static_cast<double>(event.number)) < rounding) return {};
  return fmt::format(
      "the ping has number {}, its time in whole milliseconds: any other ping within this millisecond has the same "
      "noise, waves and water; --ping gives another number",
      event.number);
}

PingSetup set_up(PingSetup head, const Run& run, const PingEvent& event, NamedBy by) {
  PingSetup setup = std::move(head);
  setup.run = run, setup.event = event, setup.simulation = requested_simulation(run);
  if (!run.placement.trajectory.empty())
    for (const std::string& note : notes_on_track(run.placement)) setup.notes.push_back(note);
  if (std::string note = number_note(event, run.placement); !note.empty()) setup.notes.push_back(std::move(note));
  const char* dashes = by == NamedBy::option ? "--" : "";
  const auto force = [&](const char* name, const std::string& stage, bool included) {
    in_words_of(fmt::format("{}{} {}", dashes, name, stage),
                [&] { force_stage(stage, included, event, setup.environment, setup.simulation); });
  };
  for (const std::string& stage : run.with) force("with", stage, true);
  for (const std::string& stage : run.without) force("without", stage, false);
  if (run.simulation.effects.multipath == Choice::always && !setup.environment.surface && !setup.environment.bottom)
    fail(ErrorKind::argument, dashes, "multipath: the environment has neither surface nor bottom; give their heights, ",
         "e.g. --set surface.height_m=0");
  require_depths_known(setup.environment, "environment");
  require_valid_settings(run, setup.simulation, by);
  require_slow(run.placement, event.motion, setup.medium.sound_speed);
  require_valid(event, "PingSimulator");
  return setup;
}

std::optional<GivenPose> given_mounting(const SonarFile& sonar) {
  if (sonar.mounting.isZero()) return std::nullopt;
  const Eigen::Vector3d angles = sonar.mounting.unaryExpr(&shortest_degrees);
  return GivenPose{0, 0, 0, angles.x(), angles.y(), angles.z()};
}

PingSetup set_up_ping(const Run& run) {
  const PingEvent event = requested_event(run.placement);
  return set_up(set_up_head(run.head, event.world_from_head.translation().z()), run, event);
}

std::vector<Eigen::Vector3d> sampled_positions(const SceneCloud& scene, const Pose& pose) {
  std::vector<Eigen::Vector3d> positions;
  const std::size_t step = std::max<std::size_t>(1, scene.size() / 10000);
  for (std::size_t i = 0; i < scene.size(); i += step)
    positions.push_back(pose.linear().transpose() *
                        (scene.origin - pose.translation() + scene.point[i].cast<double>()));
  return positions;
}

void require_in_reach(std::vector<Eigen::Vector3d> positions, const RangeGate& gate, const std::string& path) {
  const auto middle = positions.begin() + static_cast<std::ptrdiff_t>(positions.size() / 2);
  std::nth_element(positions.begin(), middle, positions.end(),
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

PingSetup set_up_head(const HeadOptions& o, std::optional<double> head_height, std::optional<double> water_level,
                      bool tide) {
  const SonarFile file = find_sonar(o.sonar);
  SonarSpec spec = file.spec;
  Environment environment;
  if (!o.environment.empty()) environment = load_environment(o.environment);
  if (!o.profile.empty()) environment.profile = load_sound_speed_profile(o.profile);
  bool sets_range = false;
  for (const std::string& text : o.settings) {
    const Setting setting = parse_setting(text);
    sets_range |= setting.section == "sonar" && setting.key == "max_range_m";
    if (setting.section == "sonar")
      set_sonar_value(spec, setting.key, setting.value);
    else
      set_environment_value(environment, setting.section, setting.key, setting.value);
  }
  if (tide && environment.surface) {
    double& height = environment.surface->height;
    if (height != 0)
      fail(ErrorKind::argument, "surface.height_m = ", height, " m beside [tide], must be 0: the sea surface has the ",
           "height of the tide above z = 0");
    height = *water_level;
  }
  if (water_level) environment.water_level = water_level;
  if (o.range) spec.min_range = (*o.range)[0], spec.max_range = (*o.range)[1];
  PingSetup setup = set_up_head(file, spec, std::move(environment), head_height);
  setup.range_is_own = !o.range && !sets_range && !file.of_run;
  return setup;
}

PingSetup set_up_head(const SonarFile& file, const SonarSpec& spec, Environment environment,
                      std::optional<double> head_height) {
  PingSetup setup;
  setup.spec = spec;
  if (!file.of_run) setup.farthest = file.spec.max_range;
  setup.environment = std::move(environment);
  setup.mount = pose_from_yaw_pitch_roll({0, 0, 0}, file.mounting.x(), file.mounting.y(), file.mounting.z());
  for (const SourcedNumber& n : file.numbers)
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

PingSetup set_up_survey_head(const MissionFile& file, std::size_t h, int threads) {
  const MissionSonar& sonar = file.sonars[h];
  Run run = load_mission_settings(file.path);
  run.simulation.seed = file.seed, run.simulation.threads = threads;
  run.scene.path = file.scene;
  run.head = {sonar.sonar, {}, file.environment, file.profile, sonar.settings};
  if (!sonar.range.empty()) run.head.range = parse_range(sonar.range);
  run.placement.pose.emplace();  // for run.toml, which demands one
  const TideSeries& tide = file.mission.tide;
  const std::optional<double> level =
      tide.time.empty() ? file.water.level : water_height_at(tide, file.mission.trajectory.time.front());
  PingSetup head = set_up(set_up_head(run.head, std::nullopt, level, !tide.time.empty()), run);
  static DroppedContributors labels_alone;
  head.simulation.outputs.contributor_sink = &labels_alone;
  return head;
}

std::vector<PingSimulator> mission_heads(const MissionFile& file) {
  std::vector<PingSimulator> heads;
  for (std::size_t h = 0; h < file.mission.heads.size(); ++h) heads.push_back(set_up_survey_head(file, h).simulator());
  return heads;
}

}  // namespace insonify
