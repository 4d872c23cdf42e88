// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/swath_pings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "tool/run/record_file.hpp"

namespace insonify::tool {
namespace {

constexpr std::size_t most_beams = 512, bins = 512;  // size of the image of a ping

/// Returns the fan across the track that holds all angles, of as many beams as the widest ping has entries.
BeamFan fan_of_swath(const SwathRecord& record) {
  double widest = radians(1);
  std::size_t beams = 2;
  for (const SwathPing& ping : record.pings) {
    beams = std::max(beams, std::min(most_beams, ping.beams));
    for (const SwathSounding& sounding : ping.soundings) widest = std::max(widest, std::abs(sounding.angle));
  }
  const double field = std::min(2 * widest * (1 + 1 / static_cast<double>(beams)), 2 * pi);
  return make_fan(beams, field, field / static_cast<double>(beams), radians(1));
}

}  // namespace

double swath_range(const SwathPing& ping, const SwathSounding& sounding) {
  return std::hypot(sounding.across, sounding.depth - ping.head_depth);
}

SwathPings::SwathPings(SwathRecord record, const std::optional<Anchor>& anchor)
    : record_(std::move(record)), fan_(fan_of_swath(record_)) {
  double farthest = 0;
  for (const SwathPing& ping : record_.pings)
    for (const SwathSounding& sounding : ping.soundings) farthest = std::max(farthest, swath_range(ping, sounding));
  if (!(farthest > 0))
    fail(ErrorKind::content, record_.format, ": none of ", record_.pings.size(), " pings has a sounding");
  gate_ = shown_gate(0, bins, 1.02 * farthest / static_cast<double>(bins));
  const GeoPosition& first = record_.pings.front().position;
  anchor_ = anchor.value_or(Anchor{degrees(first.latitude), degrees(first.longitude), 90});
  require_valid(anchor_, record_.format.c_str());
}

Eigen::Vector3d SwathPings::head_position(const SwathPing& ping) const {
  const Eigen::Vector3d at = world_from_geo(anchor_, {ping.position.latitude, ping.position.longitude, 0});
  return {at.x(), at.y(), -ping.head_depth};
}

Eigen::Vector3d SwathPings::position(const SwathPing& ping, const SwathSounding& sounding) const {
  const Eigen::Vector3d head = head_position(ping);
  const double sine = std::sin(ping.heading), cosine = std::cos(ping.heading);
  return {head.x() + sounding.along * sine + sounding.across * cosine,
          head.y() + sounding.along * cosine - sounding.across * sine, -sounding.depth};
}

TrackPoint SwathPings::track_point(std::size_t i) const {
  const SwathPing& ping = record_.pings[i];
  const double sine = std::sin(ping.heading), cosine = std::cos(ping.heading);
  TrackPoint point;
  point.number = ping.number, point.time = ping.time, point.sound_speed = ping.sound_speed;
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(0, 0, -1);          // down
  axes.col(1) = Eigen::Vector3d(-cosine, sine, 0);  // to port
  axes.col(2) = Eigen::Vector3d(sine, cosine, 0);   // ahead
  point.world_from_head.linear() = axes, point.world_from_head.translation() = head_position(ping);
  return point;
}

std::pair<std::size_t, std::size_t> SwathPings::pixel(const SwathPing& ping, const SwathSounding& sounding) const {
  const double step = fan_.azimuth.size() > 1 ? fan_.azimuth[1] - fan_.azimuth[0] : 1;
  const double beam = std::round((-sounding.angle - fan_.azimuth[0]) / step),
               bin = std::floor((swath_range(ping, sounding) - gate_.min_range) / gate_.bin_size);
  return {static_cast<std::size_t>(std::clamp(beam, 0.0, static_cast<double>(fan_.beams() - 1))),
          static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(gate_.bins() - 1)))};
}

Ping SwathPings::ping(std::size_t i) const {
  const SwathPing& from = record_.pings[i];
  const TrackPoint point = track_point(i);
  Ping ping;
  ping.number = point.number, ping.time = point.time, ping.sound_speed = point.sound_speed;
  ping.world_from_head = point.world_from_head;
  ping.fan = fan_, ping.gate = gate_;
  ping.pressure = ComplexGridF::Zero(static_cast<Eigen::Index>(fan_.beams()), static_cast<Eigen::Index>(gate_.bins()));
  for (const SwathSounding& sounding : from.soundings) {
    if (sounding.rejected) continue;
    const auto [beam, bin] = pixel(from, sounding);
    const double level = std::isfinite(sounding.level_db) ? sounding.level_db : 0;
    ping.pressure(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(bin)) = recorded_pressure(level);
  }
  return ping;
}

Soundings SwathPings::soundings() const {
  Soundings all;
  for (std::size_t i = 0; i < record_.pings.size(); ++i)
    for (const SwathSounding& sounding : record_.pings[i].soundings) {
      if (sounding.rejected) continue;
      const auto [beam, bin] = pixel(record_.pings[i], sounding);
      all.position.push_back(position(record_.pings[i], sounding));
      all.level_db.push_back(std::isfinite(sounding.level_db) ? static_cast<float>(sounding.level_db) : 0.0F);
      all.range.push_back(static_cast<float>(swath_range(record_.pings[i], sounding)));
      all.azimuth.push_back(static_cast<float>(-sounding.angle)), all.elevation.push_back(0);
      all.ping.push_back(static_cast<std::uint32_t>(i));
      all.beam.push_back(static_cast<std::uint32_t>(beam)), all.bin.push_back(static_cast<std::uint32_t>(bin));
    }
  all.true_elevation.assign(all.size(), std::numeric_limits<float>::quiet_NaN());
  all.true_surfel.assign(all.size(), Soundings::none), all.true_material.assign(all.size(), Soundings::none);
  return all;
}

std::string SwathPings::unit() const { return record_.unit.empty() ? "dB (no levels: 0)" : record_.unit; }

}  // namespace insonify::tool
