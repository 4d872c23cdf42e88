// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/pose.hpp"
#include "core/units.hpp"
#include "sonar/beam_pattern.hpp"
#include "sonar/receive_array.hpp"
#include "tool/image/image.hpp"

namespace insonify::tool {
namespace {

/// Rounds to a multiple of `step`, without negative zero.
double rounded(double value, double step) {
  const double nearest = step * std::round(value / step);
  return nearest == 0 ? 0 : nearest;
}

std::string position_text(const Pose& pose) {
  const Eigen::Vector3d at = pose.translation();
  return fmt::format("{:.2f}, {:.2f}, {:.2f} m", rounded(at.x(), 0.01), rounded(at.y(), 0.01), rounded(at.z(), 0.01));
}

/// Angles as --pose takes them.
std::string attitude_text(const Pose& pose) {
  const PoseAngles head = pose_angles(pose);
  return fmt::format("yaw {:.1f}°, pitch {:.1f}°, roll {:.1f}°", rounded(degrees(head.yaw), 0.1),
                     rounded(degrees(head.pitch), 0.1), rounded(degrees(head.roll), 0.1));
}

std::string fan_text(const BeamFan& fan) {
  const auto [low, high] = std::minmax_element(fan.azimuth.begin(), fan.azimuth.end());
  return fmt::format("{} over {:.1f}°, {:.2g}° x {:.3g}° wide", fan.beams(), degrees(*high - *low),
                     degrees(fan.beam_width), degrees(fan.elevation_width));
}

/// Sonar, pose, gate, water and settings of one ping of a cube in words.
std::vector<Fact> facts_of(const Cube& cube, std::size_t number) {
  const Ping& ping = cube.pings[number];
  const double loudest = pressure_level_db(ping.pressure.abs().maxCoeff());
  return {{"Sonar", cube.sonar},
          {"Pulse", fmt::format("{:g} kHz, {:g} kHz wide", cube.centre_frequency / 1000, cube.bandwidth / 1000)},
          {"Source level", fmt::format("{:g} dB re 1 µPa at 1 m", cube.source_level_db)},
          {"Ping", fmt::format("{} of {}, at {:g} s", number + 1, cube.pings.size(), ping.time)},
          {"Position", position_text(ping.world_from_head)},
          {"Attitude", attitude_text(ping.world_from_head)},
          {"Beams", fan_text(ping.fan)},
          {"Range", fmt::format("{:g} to {:g} m", ping.gate.min_range, ping.gate.max_range)},
          {"Bins", fmt::format("{} of {:.3g} mm", ping.gate.bins(), 1000 * ping.gate.bin_size)},
          {"Sound speed", fmt::format("{:.1f} m/s", ping.sound_speed)},
          {"Absorption", fmt::format("{:.3g} dB/km", 1000 * ping.absorption_db_per_m)},
          {"Loudest sample", loudest > silence_db ? fmt::format("{:.1f} dB re 1 µPa", loudest) : "silence"},
          {"Tolerance", fmt::format("{:g}", cube.tolerance)},
          {"Seed", fmt::format("{}", cube.seed)}};
}

/// The pattern of a beam over azimuth in the plane of the array.
BeamPatternCurve curve_of(const SonarHead& head, double wavelength, double steering) {
  if (has_line(head)) return beam_pattern_curve(head.array, wavelength, steering);
  const auto array = receive_array(head);
  const auto steps = static_cast<int>(std::ceil(16 * pi * array->length() / wavelength)) + 1800;
  BeamPatternCurve curve;
  for (int i = 0; i <= steps; ++i) {
    const double azimuth = pi * (static_cast<double>(i) / steps - 0.5);
    curve.azimuth.push_back(azimuth);
    curve.level_db.push_back(
        db_from_power(std::norm(array->response(unit_vector({azimuth, 0}), unit_vector({steering, 0}), wavelength))));
  }
  return curve;
}

/// Image and facts of a ping, and the pattern of the beam if the run says with which array it was received.
Panels panels_of(const PictureRequest& job) {
  const ImageRun& run = job.run;
  Panels panels;
  panels.image = levels_of(job);
  const BeamFan& fan = panels.image.fan;
  panels.beam = choose_beam(job.options, fan).beam;
  panels.facts = facts_of(run.cube, job.ping);
  const double steering = fan.azimuth[panels.beam];
  if (!run.head || std::abs(steering) > pi / 2) return panels;
  const LineArray& array = run.head->array;
  const double wavelength = run.cube.pings[job.ping].sound_speed / run.cube.centre_frequency;
  const BeamPatternCurve curve = curve_of(*run.head, wavelength, steering);
  panels.azimuth = curve.azimuth;
  panels.pattern_db = curve.level_db;
  panels.pattern_title = fmt::format("Pattern of {}, {} elements", beam_text({{}, panels.beam}, fan), array.elements());
  return panels;
}

void draw_panels(const PictureRequest& job) { show_panels(panels_of(job), job.picture, job.path); }

}  // namespace

ViewSpec panels_view() {
  return {.name = "panels",
          .shows = "fan, one beam, its pattern and facts",
          .options = {annotate_option, animate_option},
          .draw = draw_panels,
          .max_db = max_db_of_image,
          .of_bearings = true};
}

}  // namespace insonify::tool
