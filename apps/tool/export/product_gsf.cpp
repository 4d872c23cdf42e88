// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "core/units.hpp"
#include "formats/gsf_file.hpp"
#include "returns/echo_place.hpp"
#include "tool/export/product_run.hpp"
#include "tool/export/sounding_uncertainty.hpp"

namespace insonify::tool {
namespace {

constexpr double deepest_profile = 12000;  // [m], below any sea floor
constexpr double deviations_at_95 = 1.959963985;
constexpr double profile_step = 0.01;  // step of the sound speeds in a profile [m/s]

/// How a head is mounted, against one whose swath is straight down: its x axis down, its z axis ahead.
GsfMounting mounting_of(const Pose& ship_from_head) {
  const Eigen::Matrix3d head = ship_from_head.linear();
  Eigen::Matrix3d swath;
  swath << head.col(2), head.col(1), -head.col(0);
  const ShipAxes axes = axes_of_ship(swath);
  const Eigen::Vector3d at = ship_from_head.translation();
  return {{at.x(), -at.y(), -at.z()}, std::atan2(-axes.ahead.y(), axes.ahead.x()), axes.pitch, axes.roll};
}

/// Where a beam points, as one at nadir of a level ship.
GsfBeam pointing_beam(const ShipAxes& ship, const Eigen::Vector3d& way) {
  GsfBeam beam;
  beam.angle = std::acos(std::clamp(-way.z() / way.norm(), -1.0, 1.0));
  beam.azimuth = std::atan2(way.dot(ship.ahead), way.dot(ship.starboard));
  return beam;
}

/// A sounding where it lies on the globe, in level axes of the ship below its head. Angles and travel time are those of
/// a head that stays where it transmitted.
GsfBeam placed_beam(const PlacedRun& run, const Ping& ping, const ShipAxes& ship, const Anchor& here,
                    const RunUncertainty& uncertainty, const BottomSoundings& found, std::size_t i) {
  const std::size_t b = found.beam[i];
  const Eigen::Vector3d way = way_of_beam(ping, b, found.range[i], ping.sound_speed);
  GsfBeam beam = pointing_beam(ship, way);
  const Eigen::Vector3d away = world_from_geo(here, geo_from_world(run.reference(), found.position[i]));
  const auto deviation = static_cast<double>(found.deviation[i]);
  beam.detected = true;
  beam.depth = -found.position[i].z();
  beam.along = away.x(), beam.across = -away.y();
  beam.travel_time = 2 * way.norm() / ping.sound_speed;
  beam.level_db = static_cast<double>(found.level_db[i]);
  beam.quality = static_cast<double>(found.quality[i]);
  beam.vertical_deviation = deviation * std::cos(beam.angle);
  beam.horizontal_deviation = deviation * std::sin(beam.angle);
  if (uncertainty.known()) {
    const SoundingUncertainty of_all = uncertainty.at(ping, found, i);
    beam.vertical_deviation = of_all.vertical, beam.horizontal_deviation = of_all.thu / deviations_at_95;
  }
  beam.rejected = found.reject[i] != 0;
  beam.by_phase = found.method[i] == BottomMethod::phase;
  return beam;
}

/// The beams of a ping from port to starboard, those of several soundings one after the other.
std::vector<GsfBeam> beams_of(const PlacedRun& run, const Ping& ping, const BottomSoundings& found,
                              const ShipAxes& ship, const Anchor& here, const RunUncertainty& uncertainty) {
  std::vector<GsfBeam> beams;
  for (const SwathEntry& entry : entries_from_port(ping, ship, found))
    beams.push_back(entry.sounding ? placed_beam(run, ping, ship, here, uncertainty, found, *entry.sounding)
                                   : pointing_beam(ship, axis_of_beam(ping, entry.beam)));
  return beams;
}

/// Fills in the fields of a GSF ping that describe the sonar itself.
void add_sonar(const Cube& cube, const Ping& ping, GsfPing& out) {
  out.number = static_cast<std::uint32_t>(ping.number);
  out.surface_sound_speed = ping.sound_speed;
  out.range = ping.gate.max_range;
  out.sample_rate = ping.sound_speed / (2 * ping.gate.bin_size);
  out.centre_frequency = cube.centre_frequency, out.bandwidth = cube.bandwidth;
  out.source_level_db = cube.source_level_db, out.absorption_db_per_m = ping.absorption_db_per_m;
  out.beam_width_along = ping.fan.elevation_width, out.beam_width_across = ping.fan.beam_width;
}

/// Course and speed over ground at a ping; without a way the ship is at rest.
void add_motion(const PlacedRun& run, const std::optional<Trajectory>& way, const Ping& ping, GsfPing& out) {
  out.course = out.heading;
  const Eigen::Vector3d level = level_velocity(way, ping.time);
  out.speed = level.norm();
  if (out.speed > 1e-6) out.course = heading_of(run.reference(), ping.world_from_head.translation(), level / out.speed);
}

GsfPing gsf_ping(const PlacedRun& run, const std::optional<Trajectory>& way, const RunUncertainty& uncertainty,
                 const Cube& cube, const Ping& ping, const BottomSoundings& found) {
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const ShipAxes ship = ship_axes(run.pings, ping);
  const double water = water_level(run.pings, ping.time).value_or(0);
  GsfPing out;
  out.time = run.start + ping.time;
  out.position = geo_from_world(run.reference(), head);
  out.heading = heading_of(run.reference(), head, ship.ahead);
  out.pitch = ship.pitch, out.roll = ship.roll;
  out.head_depth = water - head.z();
  out.ship_depth = water - vehicle_pose(run.pings, ping).value_or(ping.world_from_head).translation().z();
  out.tide = -water;
  out.separation = out.position.height - head.z();
  add_sonar(cube, ping, out);
  add_motion(run, way, ping, out);
  const Anchor here{degrees(out.position.latitude), degrees(out.position.longitude), degrees(out.heading)};
  out.beams = beams_of(run, ping, found, ship, here, uncertainty);
  return out;
}

/// The profile by which the rays of a ping are traced, from the surface to below any sea floor: beyond its ends it is
/// constant, without one in the environment it has the speed at the head.
SoundSpeedProfile whole_profile(const PlacedRun& run, const Ping& ping) {
  SoundSpeedProfile profile = run.pings.environment.profile.value_or(SoundSpeedProfile{{0}, {ping.sound_speed}});
  if (run.processing_profile) profile = *run.processing_profile;
  if (profile.depth.front() > 0) {
    profile.depth.insert(profile.depth.begin(), 0);
    profile.sound_speed.insert(profile.sound_speed.begin(), profile.sound_speed.front());
  }
  if (profile.depth.back() < deepest_profile) {
    profile.depth.push_back(deepest_profile);
    profile.sound_speed.push_back(profile.sound_speed.back());
  }
  return profile;
}

/// The command of the export as far as it shapes the soundings, without paths.
std::string command_of(const ProductOptions& o) {
  std::string command = "insonify export --to gsf";
  for (const auto& [option, value] :
       {std::pair("--anchor", o.world.anchor), std::pair("--utm", o.world.utm), std::pair("--system", o.world.system),
        std::pair("--start-utc", o.start_utc), std::pair("--head", o.head),
        std::pair("--tide", o.tide.empty() || o.tide == "none" ? o.tide : file_name_of(o.tide))})
    if (!value.empty()) command += fmt::format(" {} {}", option, value);
  if (o.per_beam > 1) command += fmt::format(" --per-beam {}", o.per_beam);
  if (o.keep_rejected) command += " --keep-rejected";
  if (std::isfinite(o.min_level)) command += fmt::format(" --min-level {}", o.min_level);
  if (std::isfinite(o.max_deviation)) command += fmt::format(" --max-deviation {}", o.max_deviation);
  if (!o.processing_profile.empty()) command += " --processing-profile " + profile_name(o);
  return command;
}

/// Returns the facts that the file states before its first ping.
GsfSurvey survey_of(const PlacedRun& run, const Cube& cube, const SoundSpeedProfile& profile, const GsfPing& first) {
  GsfSurvey survey;
  survey.sensor = gsf_sensor_of(cube.sonar);
  survey.profile = profile;
  survey.position = first.position;
  survey.time = first.time;
  survey.processing.draft = first.head_depth;
  survey.processing.submersible = first.ship_depth > 0;
  survey.processing.tide_compensated =
      run.options.tide != "none" && water_level(run.pings, first.time - run.start).has_value();
  survey.processing.tidal_datum = run.pings.water.datum;
  if (run.pings.vehicle_from_head) survey.processing.mounting = mounting_of(*run.pings.vehicle_from_head);
  survey.comment = fmt::format("sonar {}, simulated by insonify {}", cube.sonar, cube.insonify_version);
  if (!run.options.processing_profile.empty()) survey.comment += "; processing profile " + profile_name(run.options);
  survey.history_command = command_of(run.options);
  survey.history_comment = fmt::format("soundings of the bottom found in each ping by insonify {}", INSONIFY_VERSION);
  survey.position_deviation = run.pings.position_deviation;
  return survey;
}

}  // namespace

SoundingCount gsf_product(const PlacedRun& run) {
  std::vector<std::string> notes;
  const std::optional<Trajectory> way = way_of(run.pings, notes);
  const RunUncertainty uncertainty(run);
  std::unique_ptr<GsfFile> file;
  double before = 0, speed = 0;  // time of the last ping, and at the surface in its profile
  SoundingCount count = each_swath(run, [&](const Cube& cube, const Ping& ping, const BottomSoundings& found) {
    GsfPing swath = gsf_ping(run, way, uncertainty, cube, ping, found);
    if (file) swath.period = std::max(0.0, swath.time - before);
    before = swath.time;
    if (!file && swath.head_depth < 0 && !water_level(run.pings, ping.time))
      notes.push_back(fmt::format(
          "the run states no water level: depths count from z = 0, {:.4g} m below the head, and drafts are negative; "
          "give [water] level_m or [tide] in the mission, or surface.height_m in the environment",
          -swath.head_depth));
    const SoundSpeedProfile profile = whole_profile(run, ping);
    const bool other = std::abs(profile.sound_speed.front() - speed) > 0.5 * profile_step;
    if (!file)
      file = std::make_unique<GsfFile>(run.options.output, survey_of(run, cube, profile, swath));
    else if (other)
      file->add_profile(profile, swath.position, swath.time);
    if (other) speed = profile.sound_speed.front();
    file->add(swath);
  });
  file->finish();
  count.notes = std::move(notes);
  return count;
}

}  // namespace insonify::tool
