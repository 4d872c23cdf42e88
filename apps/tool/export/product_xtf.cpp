// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/xtf_file.hpp"
#include "returns/first_return.hpp"
#include "returns/looks.hpp"
#include "tool/export/product_run.hpp"

namespace insonify::tool {
namespace {

constexpr double bed_spreading = 30;   // [dB per decade of range] of a bottom
constexpr double same_ping = 1e-3;     // [s]: pings of two heads that are one of the file
constexpr double least_length = 1e-6;  // of a velocity [m/s]

/// The pings of one head in order, each read when it is asked for.
class HeadPings {
 public:
  explicit HeadPings(const RunPings& run) : run_(run) {
    for (std::size_t c = 0; c < run.cubes.size(); ++c) {
      const std::vector<TrackPoint> track = read_track(run.cubes[c]);
      for (std::size_t p = 0; p < track.size(); ++p) positions_.push_back({c, p, track[p].time});
    }
  }
  std::size_t size() const { return positions_.size(); }
  double time(std::size_t i) const { return positions_[i].time; }
  const RunPings& run() const { return run_; }
  Cube cube(std::size_t i) const { return read_cube(run_.cubes[positions_[i].cube], positions_[i].ping, 1); }

 private:
  struct Position {
    std::size_t cube, ping;
    double time;
  };
  const RunPings& run_;
  std::vector<Position> positions_;
};

/// Pings of the heads that are one of the file: their indices by head, -1 for a head that did not ping then.
std::vector<std::vector<std::ptrdiff_t>> shared_pings(const std::vector<HeadPings>& heads) {
  std::vector<std::vector<std::ptrdiff_t>> shared;
  std::vector<std::size_t> next(heads.size(), 0);
  while (true) {
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t h = 0; h < heads.size(); ++h)
      if (next[h] < heads[h].size()) first = std::min(first, heads[h].time(next[h]));
    if (std::isinf(first)) return shared;
    std::vector<std::ptrdiff_t> together(heads.size(), -1);
    for (std::size_t h = 0; h < heads.size(); ++h)
      if (next[h] < heads[h].size() && heads[h].time(next[h]) - first < same_ping)
        together[h] = static_cast<std::ptrdiff_t>(next[h]++);
    shared.push_back(std::move(together));
  }
}

/// Amplitudes [Pa] of a ping of one beam: with the gain of a bottom [Pa at 1 m], or as they are received.
std::vector<float> amplitudes_of(const Ping& ping, bool linear) {
  const Tvg tvg{bed_spreading, ping.absorption_db_per_m};
  std::vector<float> amplitudes;
  for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
    const auto bin = static_cast<Eigen::Index>(n);
    const double amplitude = ping.intensity.size() > 0 ? std::sqrt(static_cast<double>(ping.intensity(0, bin)))
                                                       : static_cast<double>(std::abs(ping.pressure(0, bin)));
    const double gain = linear ? 1 : amplitude_from_db(gain_db(tvg, ping.gate.centre(n)));
    amplitudes.push_back(static_cast<float>(gain * amplitude));
  }
  return amplitudes;
}

void require_one_beam(const Cube& cube, const std::string& path) {
  if (const std::size_t beams = cube.pings.front().fan.beams(); beams != 1)
    fail(ErrorKind::content, path, ": ", cube.sonar, " has ", beams,
         " beams; --to xtf is of side-scans and scanning heads, which have one: export it --to mcap or png");
}

/// The largest amplitude of all pings, which full scale stands for.
double largest_amplitude(const std::vector<HeadPings>& heads) {
  double largest = 0;
  for (const HeadPings& head : heads)
    each_ping(head.run(), [&](const Cube&, const Ping& ping) {
      for (const float amplitude : amplitudes_of(ping, false))
        largest = std::max(largest, static_cast<double>(amplitude));
    });
  return largest > 0 ? largest : 1;
}

Eigen::Vector3d beam_axis(const Ping& ping) {
  return ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[0], ping.fan.elevation[0]});
}

XtfChannel channel_of(const HeadPings& head, const std::string& name, bool linear) {
  const Cube cube = head.cube(0);
  const Ping& ping = cube.pings.front();
  const Eigen::Vector3d axis = beam_axis(ping);
  XtfChannel channel;
  const bool to_port = axis.dot(ship_axes(head.run(), ping).starboard) < 0;
  channel.side = to_port && !ping.scan ? XtfSide::port : XtfSide::starboard;
  channel.samples = linear ? XtfSamples::ieee_float : XtfSamples::integer_16;
  channel.name = name.empty() ? (channel.side == XtfSide::port ? "port" : "starboard") : name;
  channel.frequency = cube.centre_frequency;
  channel.beam_width = ping.fan.beam_width, channel.elevation_width = ping.fan.elevation_width;
  channel.depression = std::asin(std::clamp(-axis.z(), -1.0, 1.0));
  return channel;
}

/// Samples from the head on: bins before the gate hold silence, since many readers take the first sample for range 0.
XtfTrace trace_of(const Cube& cube, std::size_t channel, bool linear, double full) {
  const Ping& ping = cube.pings.front();
  const RangeGate& gate = ping.gate;
  const double before = std::floor(gate.min_range / gate.bin_size);
  XtfTrace trace;
  trace.channel = channel;
  trace.begin = gate.min_range - before * gate.bin_size;
  trace.end = gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size;
  trace.frequency = cube.centre_frequency;
  trace.with_gain = !linear;
  trace.samples.assign(static_cast<std::size_t>(before), 0.0F);
  for (const float amplitude : amplitudes_of(ping, linear))
    trace.samples.push_back(linear ? amplitude : static_cast<float>(65535 * static_cast<double>(amplitude) / full));
  return trace;
}

/// Height above the bottom: by the bottom of the environment, else by the first return of the ping.
double altitude_of(const RunPings& run, const Ping& ping) {
  if (run.environment.bottom)
    return std::max(0.0, ping.world_from_head.translation().z() - run.environment.bottom->height);
  return first_return(shown_level_db(ping), ping.gate).value_or(0);
}

/// Where ship and sonar are and how they are turned, by a ping of one of the heads.
void add_position(const PlacedRun& run, const RunPings& head, const std::optional<Trajectory>& way, const Ping& ping,
                  XtfPing& out) {
  const Eigen::Vector3d sonar = ping.world_from_head.translation();
  const Eigen::Vector3d ship = vehicle_pose(head, ping).value_or(ping.world_from_head).translation();
  const auto degrees_of = [&](const Eigen::Vector3d& position) {
    const GeoPosition geo = geo_from_world(run.reference(), position);
    return Eigen::Vector2d(degrees(geo.longitude), degrees(geo.latitude));
  };
  const ShipAxes axes = ship_axes(head, ping);
  out.ship = degrees_of(ship), out.sensor = degrees_of(sonar);
  out.ship_heading = heading_of(run.reference(), ship, axes.ahead);
  out.heading = heading_of(run.reference(), sonar, axes.ahead);
  out.pitch = axes.pitch, out.roll = axes.roll;
  if (ping.scan) {  // where the head looks, against its ship
    const Eigen::Vector3d axis = beam_axis(ping), level(axis.x(), axis.y(), 0);
    if (level.norm() > least_length)
      out.yaw = std::remainder(heading_of(run.reference(), sonar, level.normalized()) - out.heading, 2 * pi);
  }
  out.speed = level_velocity(way, ping.time).norm();
  out.depth = water_level(head, ping.time).value_or(0) - sonar.z();
}

XtfHeader header_of(const PlacedRun& run, const std::vector<HeadPings>& heads, double full) {
  const bool linear = run.options.linear;
  const Cube first = heads.front().cube(0);
  XtfHeader header;
  header.program = "insonify", header.version = "223";  // as the specification asks of writers
  header.sonar = first.sonar;
  header.note = linear ? "simulated; samples are amplitudes [Pa]" : "simulated; gain 30 log r + 2 a r";
  header.notes = {fmt::format("simulated by insonify {}, sonar {}: amplitude [Pa] = value{}", first.insonify_version,
                              first.sonar,
                              linear ? std::string(", as received")
                                     : fmt::format(" * {:.9e}, with a gain of 30 log r + 2 a r, a = {:.6g} dB/m",
                                                   full / 65535, first.pings.front().absorption_db_per_m))};
  for (std::size_t h = 0; h < heads.size(); ++h)
    header.channels.push_back(channel_of(heads[h], first.head.empty() ? "" : heads[h].cube(0).head, linear));
  return header;
}

/// The heads of the run, port before starboard.
std::vector<HeadPings> heads_of(const PlacedRun& run) {
  std::vector<HeadPings> heads;
  heads.emplace_back(run.pings);
  for (const RunPings& other : run.others) heads.emplace_back(other);
  for (const HeadPings& head : heads) {
    if (head.size() == 0) fail(ErrorKind::content, run.options.run, ": has no pings");
    require_one_beam(head.cube(0), run.options.run);
  }
  return heads;
}

/// The head of the file, before it the port one.
std::vector<std::size_t> order_of(const std::vector<HeadPings>& heads) {
  std::vector<std::size_t> order;
  for (const bool port : {true, false})
    for (std::size_t h = 0; h < heads.size(); ++h)
      if ((channel_of(heads[h], "", false).side == XtfSide::port) == port) order.push_back(h);
  return order;
}

}  // namespace

SoundingCount xtf_product(const PlacedRun& run) {
  const std::vector<HeadPings> unordered = heads_of(run);
  std::vector<HeadPings> heads;
  for (const std::size_t h : order_of(unordered)) heads.push_back(unordered[h]);
  const double full = run.options.linear ? 1 : largest_amplitude(heads);
  SoundingCount count;
  const std::optional<Trajectory> way = way_of(run.pings, count.notes);
  XtfFile file(run.options.output, header_of(run, heads, full));
  double before = 0;
  for (const std::vector<std::ptrdiff_t>& together : shared_pings(heads)) {
    XtfPing ping;
    ping.number = static_cast<std::uint32_t>(count.pings);
    for (std::size_t h = 0; h < heads.size(); ++h) {
      if (together[h] < 0) continue;
      const Cube cube = heads[h].cube(static_cast<std::size_t>(together[h]));
      const Ping& pulse_ping = cube.pings.front();
      if (ping.traces.empty()) {
        ping.time = run.start + pulse_ping.time;
        ping.sound_speed = pulse_ping.sound_speed;
        add_position(run, heads[h].run(), way, pulse_ping, ping);
      }
      const double altitude = altitude_of(heads[h].run(), pulse_ping);
      if (altitude > 0) ping.altitude = ping.altitude > 0 ? std::min(ping.altitude, altitude) : altitude;
      ping.traces.push_back(trace_of(cube, h, run.options.linear, full));
    }
    if (count.pings++ > 0) ping.period = ping.time - before;
    before = ping.time;
    file.add(ping);
  }
  file.finish();
  return count;
}

}  // namespace insonify::tool
