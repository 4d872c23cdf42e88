// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "survey/assumed_sound_internal.hpp"

namespace insonify {
namespace {

/// Returns the direction whose cosines along the array are `ratio` times as large; not a number beyond its end.
Eigen::Vector3d refracted(const Eigen::Vector3d& direction, double ratio, bool planar) {
  Eigen::Vector3d turned(direction.x(), ratio * direction.y(), (planar ? ratio : 1) * direction.z());
  if (planar) {
    turned.x() = std::copysign(std::sqrt(1 - turned.tail<2>().squaredNorm()), direction.x());
    return turned;
  }
  // The cone about a line array opens or closes; the turn about the array stays.
  const double across = std::hypot(direction.x(), direction.z());
  const double left = std::sqrt(1 - turned.y() * turned.y());
  return {direction.x() * (left / across), turned.y(), direction.z() * (left / across)};
}

}  // namespace

SonarHead steered_head(const SonarHead& head, double sound_speed, double assumed) {
  const double ratio = sound_speed / assumed;  // (E215)
  SonarHead steered = head;
  for (std::size_t b = 0; b < head.fan.beams(); ++b) {
    const double azimuth = head.fan.azimuth[b], elevation = head.fan.elevation[b];
    const double sine = ratio * std::sin(elevation), up = head.column ? std::asin(sine) : elevation;
    const double along = ratio * std::sin(azimuth) * std::cos(elevation) / std::cos(up);
    if (!(std::abs(along) <= 1))
      fail(ErrorKind::argument, "assumed sound speed = ", assumed, " m/s: beam ", b, " at ", degrees(azimuth),
           " degrees, must lie within the reach of the array in water of ", sound_speed, " m/s");
    const bool astern = std::abs(azimuth) > pi / 2;
    steered.fan.azimuth[b] = astern ? std::copysign(pi, azimuth) - std::asin(along) : std::asin(along);
    steered.fan.elevation[b] = up;
  }
  RangeGate& gate = steered.gate;
  gate = {ratio * gate.min_range, ratio * gate.max_range, ratio * gate.bin_size};
  return steered;
}

void report_as_set(const SonarHead& head, double sound_speed, double assumed, SimulatedPing& simulated) {
  Ping& ping = simulated.ping;
  ping.fan = head.fan, ping.gate = head.gate, ping.sound_speed = assumed;
  const double ratio = assumed / sound_speed;  // (E215)
  Soundings& found = simulated.soundings;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3d away = ping.world_from_head.inverse() * found.position[i];
    const Eigen::Vector3d direction = refracted(away.normalized(), ratio, head.column.has_value());
    if (direction.allFinite()) found.position[i] = ping.world_from_head * (ratio * away.norm() * direction);
    found.range[i] *= static_cast<float>(ratio);
    found.azimuth[i] = static_cast<float>(head.fan.azimuth[found.beam[i]]);
    found.elevation[i] = static_cast<float>(head.fan.elevation[found.beam[i]]);
  }
}

}  // namespace insonify
