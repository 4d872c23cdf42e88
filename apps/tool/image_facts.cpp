#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/head_place.hpp"
#include "core/units.hpp"
#include "tool/image.hpp"

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
  const HeadPlace head = head_place(pose);
  return fmt::format("yaw {:.1f}°, pitch {:.1f}°, roll {:.1f}°", rounded(degrees(head.yaw), 0.1),
                     rounded(degrees(head.pitch), 0.1), rounded(degrees(head.roll), 0.1));
}

std::string fan_text(const BeamFan& fan) {
  const auto [low, high] = std::minmax_element(fan.azimuth.begin(), fan.azimuth.end());
  return fmt::format("{} over {:.1f}°, {:.2g}° x {:.3g}° wide", fan.beams(), degrees(*high - *low),
                     degrees(fan.beam_width), degrees(fan.elevation_width));
}

}  // namespace

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
          {"Sound speed", fmt::format("{:.1f} m/s", cube.sound_speed)},
          {"Absorption", fmt::format("{:.3g} dB/km", 1000 * cube.absorption_db_per_m)},
          {"Loudest sample", loudest > -200 ? fmt::format("{:.1f} dB re 1 µPa", loudest) : "silence"},
          {"Tolerance", fmt::format("{:g}", cube.tolerance)},
          {"Seed", fmt::format("{}", cube.seed)}};
}

}  // namespace insonify::tool
