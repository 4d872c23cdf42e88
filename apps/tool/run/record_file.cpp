// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/record_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "formats/aris_file.hpp"
#include "formats/oculus_file.hpp"
#include "formats/xtf_file.hpp"
#include "returns/looks.hpp"
#include "tool/run/swath_pings.hpp"

namespace insonify::tool {
namespace {

constexpr double most_growth = 16;  // of samples, to bring ranges and channels to one size

/// The pressure whose level is that of an amplitude [dB re 1].
float pressure_of(double amplitude) { return static_cast<float>(std::numbers::sqrt2 * micropascal * amplitude); }

ComplexGridF pressures_of(const Grid<float>& level_db) {
  return level_db.unaryExpr([](float level) { return recorded_pressure(static_cast<double>(level)); });
}

void require_ping(const std::string& path, std::size_t first, std::size_t pings) {
  if (first >= pings) fail(ErrorKind::argument, path, ": ping ", first, ", must be below the number of pings, ", pings);
}

// --- swaths

Record record_of_swath(const std::string& path, std::size_t first, std::size_t count) {
  const SwathPings swath(read_swath(path));
  const std::vector<SwathPing>& pings = swath.record().pings;
  require_ping(path, first, pings.size());
  Record record;
  record.kind = swath.record().format, record.unit = swath.unit(), record.has_scale = false;
  record.cube.sonar = swath.record().sonar;
  record.cube.sound_speed = pings.front().sound_speed, record.cube.centre_frequency = pings.front().frequency;
  record.cube.anchor = swath.anchor();
  for (std::size_t p = first; p < pings.size() && p - first < count; ++p) record.cube.pings.push_back(swath.ping(p));
  return record;
}

// --- side-scans

/// The bins of all pings: the finest among them, from the nearest to the farthest range.
RangeGate gate_of(const std::string& path, const XtfRecord& record) {
  double begin = std::numeric_limits<double>::infinity(), end = 0, bin = begin, samples = 0;
  for (const XtfPing& ping : record.pings)
    for (const XtfTrace& trace : ping.traces) {
      const auto count = static_cast<double>(trace.samples.size());
      begin = std::min(begin, trace.begin), end = std::max(end, trace.end);
      bin = std::min(bin, (trace.end - trace.begin) / count);
      samples += count;
    }
  const double bins = std::round((end - begin) / bin);
  const auto rows = static_cast<double>(record.pings.size() * record.header.channels.size());
  if (!(bins * rows <= most_growth * samples))
    fail(ErrorKind::content, path, ": its ranges or channels differ too much to be one image: ", begin, " to ", end,
         " m in bins of ", bin, " m of ", record.header.channels.size(),
         " channels; split the recording where the range changes");
  return shown_gate(begin, static_cast<std::size_t>(bins), bin);
}

/// Positions of the sonar in a world whose origin is its first known position: x east, y north, z up from the water level.
class SideScanTrack {
 public:
  SideScanTrack(const XtfRecord& record) : in_degrees_(record.header.in_degrees) {
    for (const XtfPing& ping : record.pings)
      if (position_of(ping)) {
        origin_ = *position_of(ping);
        break;
      }
  }
  std::optional<Anchor> anchor() const {
    if (!in_degrees_ || origin_.isZero()) return {};
    return Anchor{origin_.y(), origin_.x(), 90};
  }
  Pose pose_of(const XtfPing& ping) const {
    const Eigen::Vector2d position = position_of(ping).value_or(origin_);
    Eigen::Vector2d at = position - origin_;
    if (const auto here = anchor())
      at = world_from_geo(*here, {radians(position.y()), radians(position.x()), 0}).head<2>();
    return pose_from_yaw_pitch_roll({at.x(), at.y(), -ping.depth}, pi / 2 - ping.heading, -ping.pitch, ping.roll);
  }

 private:
  std::optional<Eigen::Vector2d> position_of(const XtfPing& ping) const {
    const Eigen::Vector2d& position = ping.sensor.isZero() ? ping.ship : ping.sensor;
    if (position.isZero() || (in_degrees_ && !(std::abs(position.y()) <= 90 && std::abs(position.x()) <= 360)))
      return {};
    return position;
  }

  bool in_degrees_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
};

BeamFan fan_of_channels(const std::vector<XtfChannel>& channels) {
  BeamFan fan;
  for (const XtfChannel& channel : channels) {
    fan.azimuth.push_back(channel.side == XtfSide::port ? pi / 2 : channel.side == XtfSide::starboard ? -pi / 2 : 0);
    fan.elevation.push_back(channel.side == XtfSide::subbottom ? -pi / 2 : 0);
  }
  const XtfChannel& first = channels.front();
  fan.beam_width = first.beam_width > 0 ? first.beam_width : radians(1);
  fan.elevation_width = first.elevation_width > 0 ? first.elevation_width : radians(50);
  return fan;
}

/// The samples of all channels, in the bins of the record.
ComplexGridF pressures_of(const XtfPing& ping, const std::vector<XtfChannel>& channels, const RangeGate& gate) {
  const auto bins = static_cast<Eigen::Index>(gate.bins());
  ComplexGridF pressure = ComplexGridF::Zero(static_cast<Eigen::Index>(channels.size()), bins);
  for (const XtfTrace& trace : ping.traces) {
    const double bin = (trace.end - trace.begin) / static_cast<double>(trace.samples.size());
    const double scale = full_scale(channels[trace.channel].samples);
    for (Eigen::Index n = 0; n < bins; ++n) {
      const double sample = (gate.centre(static_cast<std::size_t>(n)) - trace.begin) / bin;
      if (sample >= 0 && sample < static_cast<double>(trace.samples.size()))
        pressure(static_cast<Eigen::Index>(trace.channel), n) =
            pressure_of(std::abs(static_cast<double>(trace.samples[static_cast<std::size_t>(sample)])) / scale);
    }
  }
  return pressure;
}

Record record_of_xtf(const std::string& path, std::size_t first, std::size_t count) {
  if (is_swath(path)) return record_of_swath(path, first, count);
  const XtfRecord xtf = read_xtf(path);
  require_ping(path, first, xtf.pings.size());
  const std::vector<XtfChannel>& channels = xtf.header.channels;
  const SideScanTrack track(xtf);
  Record record;
  record.kind = "XTF" + (xtf.header.program.empty() ? "" : " by " + xtf.header.program);
  const bool floats =
      channels.front().samples == XtfSamples::ieee_float || channels.front().samples == XtfSamples::ibm_float;
  record.unit = floats ? "dB re 1" : "dB re full scale";
  record.has_scale = !floats;
  record.scale = {-db_from_amplitude(full_scale(channels.front().samples)), 0};
  record.side_scan = true;
  for (const XtfChannel& channel : channels) record.channels.push_back(channel.name);
  Cube& cube = record.cube;
  cube.sonar = xtf.header.sonar.empty() ? "side-scan" : xtf.header.sonar;
  cube.centre_frequency =
      channels.front().frequency > 0 ? channels.front().frequency : xtf.pings.front().traces.front().frequency;
  cube.sound_speed = xtf.pings.front().sound_speed;
  cube.anchor = track.anchor();
  const RangeGate gate = gate_of(path, xtf);
  const BeamFan fan = fan_of_channels(channels);
  for (std::size_t p = first; p < xtf.pings.size() && p - first < count; ++p) {
    const XtfPing& from = xtf.pings[p];
    Ping ping;
    ping.number = from.number, ping.time = from.time, ping.sound_speed = from.sound_speed;
    ping.fan = fan, ping.gate = gate;
    ping.world_from_head = track.pose_of(from);
    ping.pressure = pressures_of(from, channels, gate);
    cube.pings.push_back(std::move(ping));
    record.altitude.push_back(from.altitude);
  }
  return record;
}

// --- imaging sonars

Record record_of_aris(const std::string& path, std::size_t first, std::size_t count) {
  Record record;
  for (std::size_t frame = first, frames = first + 1; frame < frames; ++frame) {
    const ArisFrame a = read_aris_frame(path, frame);
    frames = first + std::min(count, a.frames - first);
    Ping ping;
    ping.number = static_cast<std::int64_t>(frame), ping.time = a.time, ping.sound_speed = a.sound_speed;
    ping.fan = a.fan, ping.gate = a.gate;
    ping.pressure = pressures_of(level_db(a));
    record.kind = a.model, record.cube.sonar = a.model, record.cube.sound_speed = a.sound_speed;
    record.cube.pings.push_back(std::move(ping));
  }
  record.unit = "dB re unknown", record.scale = aris_scale;
  return record;
}

Record record_of_oculus(const std::string& path, std::size_t first, std::size_t count) {
  Record record;
  for (std::size_t number = first, pings = first + 1; number < pings; ++number) {
    const OculusPing o = read_oculus_ping(path, number);
    pings = first + std::min(count, o.pings - first);
    Ping ping;
    ping.number = o.number, ping.time = o.time, ping.sound_speed = o.sound_speed;
    ping.fan = o.fan;
    ping.gate = shown_gate(0, o.gate.bins(), o.gate.bin_size);
    ping.pressure = pressures_of(level_db(o));
    if (!record.cube.pings.empty() && !(record.cube.pings[0].fan == ping.fan && record.cube.pings[0].gate == ping.gate))
      fail(ErrorKind::content, path, ": ping ", number, " has other beams or ranges than ping ", first,
           "; split the log where the settings change");
    record.kind = fmt::format("Oculus of {} bits", o.bits), record.cube.sonar = "Oculus";
    record.cube.sound_speed = o.sound_speed, record.cube.centre_frequency = o.frequency;
    record.scale = {-db_from_amplitude(std::ldexp(1.0, o.bits) - 1) / o.gamma, 0};
    record.cube.pings.push_back(std::move(ping));
  }
  record.unit = "dB re full scale";
  return record;
}

std::string ending_of(const std::string& path) { return lower_case(std::filesystem::path(path).extension().string()); }

struct RecordReader {
  const char* ending;
  Record (*read)(const std::string& path, std::size_t first, std::size_t count);
};
constexpr RecordReader record_readers[] = {{".gsf", record_of_swath},     {".kmall", record_of_swath},
                                           {".xtf", record_of_xtf},       {".aris", record_of_aris},
                                           {".oculus", record_of_oculus}, {".raw", record_of_oculus}};

}  // namespace

std::string record_extensions() {
  std::string all;
  for (const RecordReader& reader : record_readers) all += (all.empty() ? "" : ", ") + std::string(reader.ending);
  return all;
}

bool is_record(const std::string& path) {
  return std::any_of(std::begin(record_readers), std::end(record_readers),
                     [ending = ending_of(path)](const RecordReader& reader) { return ending == reader.ending; });
}

Record read_record(const std::string& path, std::size_t first, std::size_t count) {
  for (const RecordReader& reader : record_readers)
    if (ending_of(path) == reader.ending) return reader.read(path, first, count);
  fail(ErrorKind::argument, path, ": is no recording; those end with ", record_extensions());
}

std::complex<float> recorded_pressure(double level_db) {
  return level_db <= silence_db ? 0.0F : pressure_of(amplitude_from_db(level_db));
}

RangeGate shown_gate(double begin, std::size_t bins, double bin_size) {
  RangeGate gate{std::max(begin, 1e-6 * bin_size), 0, bin_size};
  gate.max_range = gate.min_range + (static_cast<double>(bins) - 1e-3) * bin_size;
  return gate;
}

Ping channel_alone(const Ping& ping, std::size_t beam) {
  Ping alone = ping;
  alone.fan.azimuth = {ping.fan.azimuth[beam]}, alone.fan.elevation = {ping.fan.elevation[beam]};
  alone.pressure = ComplexGridF(ping.pressure.row(static_cast<Eigen::Index>(beam)));
  return alone;
}

Grid<float> levels_of_beam(const Cube& cube, std::size_t beam) {
  Grid<float> levels(std::ssize(cube.pings), static_cast<Eigen::Index>(cube.pings.front().gate.bins()));
  for (Eigen::Index p = 0; p < levels.rows(); ++p)
    levels.row(p) = shown_level_db(cube.pings[static_cast<std::size_t>(p)]).row(static_cast<Eigen::Index>(beam));
  return levels;
}

}  // namespace insonify::tool
