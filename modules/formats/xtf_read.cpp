// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/binary_input_internal.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "formats/xtf_file.hpp"
#include "formats/xtf_layout_internal.hpp"
#include "formats/xtf_packets_internal.hpp"

namespace insonify {
namespace {

constexpr double farthest_range = 1e5;        // [m], beyond any side-scan
constexpr double highest_in_kilohertz = 1e4;  // higher numbers are in Hz

double hertz(double frequency) { return frequency > highest_in_kilohertz ? frequency : 1000 * frequency; }

/// Converts an IBM float: a sign, seven bits of exponent to base 16, and a fraction of 24 bits.
float ibm_float(std::uint32_t raw) {
  const double fraction = std::ldexp(static_cast<double>(raw & 0xffffffu), -24);
  const double value = std::ldexp(fraction, 4 * (static_cast<int>(raw >> 24 & 0x7fu) - 64));
  return static_cast<float>(raw >> 31 ? -value : value);
}

/// Returns the storage of samples: as the format field says, in older files by their size.
XtfSamples samples_of(const std::string& path, std::string_view channel, std::size_t number) {
  const std::uint8_t format = xtf_byte_at(channel, xtf_sample_format_at);
  const auto size = little_at<std::uint16_t>(channel, xtf_sample_bytes_at);
  for (const XtfSamples known : {XtfSamples::ibm_float, XtfSamples::integer_32, XtfSamples::integer_16,
                                 XtfSamples::ieee_float, XtfSamples::integer_8})
    if (format == static_cast<std::uint8_t>(known) && size == sample_bytes(known)) return known;
  if (format == 0)
    for (const XtfSamples known : {XtfSamples::integer_8, XtfSamples::integer_16, XtfSamples::integer_32})
      if (size == sample_bytes(known)) return known;
  fail(ErrorKind::content, path, ": samples of channel ", number, " are of format ", int{format}, " and ", size,
       " bytes, must be of format 0, 1, 2, 3, 5 or 8 and 1, 2 or 4 bytes that go with it");
}

XtfChannel channel_of(const std::string& path, std::string_view bytes, std::size_t number) {
  XtfChannel channel;
  const std::uint8_t side = xtf_byte_at(bytes, xtf_side_at);
  if (side > static_cast<std::uint8_t>(XtfSide::starboard))
    fail(ErrorKind::content, path, ": channel ", number, " is of type ", int{side},
         ", must be 0 (sub-bottom), 1 (port) or 2 (starboard)");
  channel.side = static_cast<XtfSide>(side);
  channel.samples = samples_of(path, bytes, number);
  channel.name = field_at(bytes, xtf_channel_name_at, 16);
  channel.frequency = hertz(std::max(0.0, xtf_real_at(bytes, xtf_channel_frequency_at)));
  channel.beam_width = radians(xtf_real_at(bytes, xtf_beam_angle_at));
  channel.elevation_width = radians(xtf_real_at(bytes, xtf_beam_width_at));
  channel.depression = radians(xtf_real_at(bytes, xtf_tilt_at));
  return channel;
}

/// Reads the header and returns its size.
std::size_t read_header(BinaryInput& file, const std::string& path, XtfHeader& header) {
  const XtfOutline outline = read_xtf_outline(file, path);
  if (outline.sonars == 0)
    fail(ErrorKind::content, path, ": has no channel of a side-scan",
         outline.bathymetries > 0 ? "; it is a swath, which info and compare read" : "");
  const std::string head = file.part(0, outline.bytes, "its header");
  header.program = field_at(head, xtf_program_at, 8);
  header.version = field_at(head, xtf_version_at, 8);
  header.sonar = field_at(head, xtf_sonar_at, 16);
  header.note = field_at(head, xtf_note_at, 64);
  header.in_degrees = little_at<std::uint16_t>(head, xtf_nav_units_at) == xtf_degrees;
  for (std::size_t c = 0; c < outline.sonars; ++c)
    header.channels.push_back(
        channel_of(path, std::string_view(head).substr(xtf_channels_at + c * xtf_channel_bytes, xtf_channel_bytes), c));
  return outline.bytes;
}

float sample_at(std::string_view bytes, std::size_t at, XtfSamples samples) {
  switch (samples) {
    case XtfSamples::integer_8:
      return xtf_byte_at(bytes, at);
    case XtfSamples::integer_16:
      return little_at<std::uint16_t>(bytes, at);
    case XtfSamples::integer_32:
      return static_cast<float>(little_at<std::uint32_t>(bytes, at));
    case XtfSamples::ieee_float:
      return little_at<float>(bytes, at);
    case XtfSamples::ibm_float:
      return ibm_float(little_at<std::uint32_t>(bytes, at));
  }
  return 0;
}

/// Returns the samples of a channel, weighted, the nearest first.
std::vector<float> samples_of(std::string_view bytes, const XtfChannel& channel, int weight, const std::string& where) {
  const std::size_t size = sample_bytes(channel.samples);
  std::vector<float> values(bytes.size() / size);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::ldexp(sample_at(bytes, i * size, channel.samples), -weight);
    if (!std::isfinite(value)) fail(ErrorKind::content, where, ": sample ", i, " is not a finite number");
    values[i] = value;
  }
  if (channel.side == XtfSide::port) std::reverse(values.begin(), values.end());
  return values;
}

/// Reads the channel of a ping that begins at `at`, and moves `at` behind its samples.
XtfTrace trace_of(std::string_view packet, std::size_t& at, std::size_t position, const XtfHeader& header,
                  double sound_speed, const std::string& where) {
  if (packet.size() - at < xtf_trace_bytes)
    fail(ErrorKind::content, where, " ends within the header of channel ", position);
  const std::string_view head = packet.substr(at, xtf_trace_bytes);
  XtfTrace trace;
  trace.channel = little_at<std::uint16_t>(head, xtf_trace_channel_at);
  if (trace.channel >= header.channels.size()) trace.channel = position;
  if (trace.channel >= header.channels.size())
    fail(ErrorKind::content, where, " has a channel ", position, ", the file has ", header.channels.size());
  const XtfChannel& channel = header.channels[trace.channel];
  const std::uint64_t count = little_at<std::uint32_t>(head, xtf_samples_at);
  const std::uint64_t bytes = count * sample_bytes(channel.samples);
  at += xtf_trace_bytes;
  if (count == 0 || bytes > packet.size() - at)
    fail(ErrorKind::content, where, " has ", count, " samples of channel ", position,
         ", must have at least 1 and at most ", (packet.size() - at) / sample_bytes(channel.samples),
         ", as many as its packet holds");
  trace.samples = samples_of(packet.substr(at, bytes), channel, little_at<std::int16_t>(head, xtf_weight_at), where);
  at += bytes;
  trace.end = xtf_real_at(head, xtf_slant_range_at);
  trace.begin = std::max(0.0, 0.5 * xtf_real_at(head, xtf_delay_at) * sound_speed);
  if (!(trace.end > trace.begin && trace.end < farthest_range))
    fail(ErrorKind::content, where, " reaches from ", trace.begin, " to ", trace.end,
         " m, must reach farther, and less than ", farthest_range, " m");
  trace.with_gain = (little_at<std::uint16_t>(head, xtf_flags_at) & xtf_tvg_flag) != 0;
  trace.frequency =
      channel.frequency > 0 ? channel.frequency : hertz(little_at<std::uint16_t>(head, xtf_trace_frequency_at));
  return trace;
}

XtfPing ping_of(std::string_view packet, const XtfHeader& header, const std::string& where) {
  if (packet.size() < xtf_ping_bytes) fail(ErrorKind::content, where, " ends within its header");
  XtfPing ping;
  ping.number = little_at<std::uint32_t>(packet, xtf_ping_number_at);
  ping.time = xtf_time_of(packet, where);
  ping.sound_speed = xtf_sound_speed_of(packet);
  const auto position_at = [&](std::size_t x_at, std::size_t y_at) {
    const Eigen::Vector2d position(little_at<double>(packet, x_at), little_at<double>(packet, y_at));
    return position.allFinite() ? position : Eigen::Vector2d(Eigen::Vector2d::Zero());
  };
  ping.ship = position_at(xtf_ship_x_at, xtf_ship_y_at), ping.sensor = position_at(xtf_sensor_x_at, xtf_sensor_y_at);
  ping.ship_heading = radians(xtf_real_at(packet, xtf_ship_gyro_at)),
  ping.heading = radians(xtf_real_at(packet, xtf_heading_at));
  ping.pitch = radians(xtf_real_at(packet, xtf_pitch_at)), ping.roll = radians(xtf_real_at(packet, xtf_roll_at));
  ping.yaw = radians(xtf_real_at(packet, xtf_yaw_at));
  ping.speed = xtf_knot * xtf_real_at(packet, xtf_sensor_speed_at);
  ping.depth = xtf_real_at(packet, xtf_depth_at), ping.altitude = xtf_real_at(packet, xtf_altitude_at);
  std::size_t at = xtf_ping_bytes;
  for (std::size_t c = 0; c < little_at<std::uint16_t>(packet, xtf_traces_at); ++c) {
    if (c == 0 && packet.size() >= at + xtf_trace_bytes) ping.period = xtf_real_at(packet, at + xtf_period_at);
    ping.traces.push_back(trace_of(packet, at, c, header, ping.sound_speed, where));
  }
  return ping;
}

}  // namespace

XtfRecord read_xtf(const std::string& path) {
  BinaryInput file(path);
  XtfRecord record;
  const std::size_t begin = read_header(file, path, record.header);
  each_xtf_packet(file, path, begin, [&](std::string_view packet, const std::string& where) {
    const std::uint8_t type = xtf_byte_at(packet, xtf_packet_type_at);
    if (type == xtf_sonar_packet && little_at<std::uint16_t>(packet, xtf_traces_at) > 0)
      record.pings.push_back(ping_of(packet, record.header, where));
    else if (type == xtf_notes_packet && packet.size() >= xtf_note_bytes)
      record.header.notes.push_back(field_at(packet, xtf_note_text_at, xtf_note_bytes - xtf_note_text_at));
    else
      ++record.other_packets;
  });
  if (record.pings.empty()) fail(ErrorKind::content, path, ": has no ping of a side-scan");
  return record;
}

}  // namespace insonify
