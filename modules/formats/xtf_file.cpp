// SPDX-License-Identifier: BSD-3-Clause
#include "formats/xtf_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "formats/xtf_layout_internal.hpp"

namespace insonify {
namespace {

constexpr double hundredths_of_a_day = 8640000;

/// Writes numbers into the fields of a ping. Throws Error(content) for a number that its field cannot hold.
struct PingFields {
  std::string& bytes;
  std::uint32_t ping;

  void put(std::size_t at, double value, const char* what, double scale = 1) const {
    const auto number = static_cast<float>(value * scale);
    if (!std::isfinite(number))
      fail(ErrorKind::content, "XTF: ", what, " of ping ", ping, " is ", value, ", must be finite");
    put_little_at(bytes, at, number);
  }
  void put_position(std::size_t x_at, std::size_t y_at, const Eigen::Vector2d& position, const char* what) const {
    if (!(std::abs(position.x()) <= 360 && std::abs(position.y()) <= 90))
      fail(ErrorKind::content, "XTF: ", what, " of ping ", ping, " is at latitude ", position.y(), ", longitude ",
           position.x(), " degrees, must be within 90 and 360");
    put_little_at(bytes, x_at, std::remainder(position.x(), 360.0));
    put_little_at(bytes, y_at, position.y());
  }
};

std::uint16_t kilohertz(double frequency) {
  return static_cast<std::uint16_t>(std::clamp(std::round(frequency / 1000), 0.0, 65535.0));
}

/// Writes date and time of day, to the nearest hundredth of a second.
void put_time(std::string& bytes, double time, std::uint32_t ping) {
  using namespace std::chrono;
  if (!(time >= 0 && time < 4294967296.0))
    fail(ErrorKind::content, "XTF: time of ping ", ping, " is ", time,
         " s since 1970, must be within 1970 and 2106; give --start-utc");
  const double hundredths = std::round(100 * time), day_number = std::floor(hundredths / hundredths_of_a_day);
  const auto of_day = static_cast<std::uint32_t>(hundredths - day_number * hundredths_of_a_day);
  const sys_days day(days(static_cast<int>(day_number)));
  const year_month_day date(day);
  put_little_at(bytes, xtf_year_at, static_cast<std::uint16_t>(static_cast<int>(date.year())));
  bytes[xtf_month_at] = static_cast<char>(static_cast<unsigned>(date.month()));
  bytes[xtf_day_at] = static_cast<char>(static_cast<unsigned>(date.day()));
  put_little_at(bytes, xtf_day_of_year_at,
                static_cast<std::uint16_t>((day - sys_days(date.year() / January / 1)).count() + 1));
  const std::uint32_t clock[] = {of_day / 360000, of_day / 6000 % 60, of_day / 100 % 60, of_day % 100};
  for (const std::size_t at : {std::size_t{xtf_hour_at}, std::size_t{xtf_fix_hour_at}, std::size_t{xtf_clock_hour_at}})
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(clock[k]);
  put_little_at(bytes, xtf_attitude_tag_at, 10 * of_day);
  put_little_at(bytes, xtf_fix_milliseconds_at, 10 * of_day);
}

std::string channel_bytes(const XtfChannel& channel, std::size_t number) {
  std::string bytes(xtf_channel_bytes, '\0');
  bytes[xtf_side_at] = static_cast<char>(channel.side);
  bytes[xtf_sub_channel_at] = static_cast<char>(number);
  put_little_at(bytes, xtf_correction_at, std::uint16_t{1});  // corrected to slant range
  put_little_at(bytes, xtf_unipolar_at, std::uint16_t{1});
  put_little_at(bytes, xtf_sample_bytes_at, static_cast<std::uint16_t>(sample_bytes(channel.samples)));
  put_little_at(bytes, xtf_old_samples_at, std::uint32_t{1024});  // value that the specification advises
  bytes.replace(xtf_channel_name_at, std::min<std::size_t>(channel.name.size(), 16), channel.name, 0, 16);
  put_little_at(bytes, xtf_volts_at, 5.0F);
  put_little_at(bytes, xtf_channel_frequency_at, static_cast<float>(channel.frequency / 1000));
  put_little_at(bytes, xtf_beam_angle_at, static_cast<float>(degrees(channel.beam_width)));
  put_little_at(bytes, xtf_tilt_at, static_cast<float>(degrees(channel.depression)));
  put_little_at(bytes, xtf_beam_width_at, static_cast<float>(degrees(channel.elevation_width)));
  bytes[xtf_sample_format_at] = static_cast<char>(channel.samples);
  return bytes;
}

std::string header_bytes(const XtfHeader& header, const std::string& path) {
  std::string bytes(xtf_header_bytes, '\0');
  const auto put_text = [&](std::size_t at, std::size_t length, const std::string& text) {
    bytes.replace(at, std::min(text.size(), length), text, 0, length);
  };
  bytes[xtf_format_at] = static_cast<char>(xtf_file_format);
  bytes[xtf_system_at] = 1;
  put_text(xtf_program_at, 8, header.program);
  put_text(xtf_version_at, 8, header.version);
  put_text(xtf_sonar_at, 16, header.sonar);
  put_text(xtf_note_at, 64, header.note);
  put_text(xtf_file_name_at, 64, std::filesystem::path(path).filename().string());
  put_little_at(bytes, xtf_nav_units_at, xtf_degrees);
  put_little_at(bytes, xtf_sonar_channels_at, static_cast<std::uint16_t>(header.channels.size()));
  for (std::size_t c = 0; c < header.channels.size(); ++c)
    bytes.replace(xtf_channels_at + c * xtf_channel_bytes, xtf_channel_bytes, channel_bytes(header.channels[c], c));
  return bytes;
}

std::string note_bytes(const std::string& text) {
  std::string bytes(xtf_note_bytes, '\0');
  put_little_at(bytes, xtf_magic_at, xtf_magic);
  bytes[xtf_packet_type_at] = static_cast<char>(xtf_notes_packet);
  put_little_at(bytes, xtf_packet_bytes_at, static_cast<std::uint32_t>(xtf_note_bytes));
  put_little_at(bytes, xtf_year_at, std::uint16_t{1970});  // an annotation must have a date: 1 January
  bytes[xtf_month_at] = bytes[xtf_day_at] = 1;
  const std::size_t room = xtf_note_bytes - xtf_note_text_at;
  bytes.replace(xtf_note_text_at, std::min(text.size(), room), text, 0, room);
  return bytes;
}

/// Returns the samples as stored: those of port with the farthest first.
std::string samples_of(const XtfTrace& trace, const XtfChannel& channel, std::uint32_t ping) {
  std::string bytes;
  const auto put = [&](float sample) {
    if (!std::isfinite(sample) || (channel.samples == XtfSamples::integer_16 && !(sample > -0.5F && sample < 65535.5F)))
      fail(ErrorKind::content, "XTF: a sample of ping ", ping, " is ", sample,
           channel.samples == XtfSamples::integer_16 ? ", must be within 0 and 65535" : ", must be finite");
    if (channel.samples == XtfSamples::integer_16)
      put_little(bytes, static_cast<std::uint16_t>(std::lround(sample)));
    else
      put_little(bytes, sample);
  };
  if (channel.side == XtfSide::port)
    std::for_each(trace.samples.rbegin(), trace.samples.rend(), put);
  else
    std::for_each(trace.samples.begin(), trace.samples.end(), put);
  return bytes;
}

std::string trace_bytes(const XtfTrace& trace, const XtfChannel& channel, const XtfPing& ping) {
  std::string bytes(xtf_trace_bytes, '\0');
  const PingFields fields{bytes, ping.number};
  if (!(trace.begin >= 0 && trace.begin < trace.end))
    fail(ErrorKind::content, "XTF: ping ", ping.number, " reaches from ", trace.begin, " to ", trace.end,
         " m, must be within 0 and more");
  if (!(ping.sound_speed > 0))
    fail(ErrorKind::content, "XTF: sound speed of ping ", ping.number, " is ", ping.sound_speed, " m/s, must be > 0");
  put_little_at(bytes, xtf_trace_channel_at, static_cast<std::uint16_t>(trace.channel));
  fields.put(xtf_slant_range_at, trace.end, "slant range");
  fields.put(xtf_ground_range_at, std::sqrt(std::max(0.0, trace.end * trace.end - ping.altitude * ping.altitude)),
             "ground range");
  fields.put(xtf_delay_at, 2 * trace.begin / ping.sound_speed, "delay");
  fields.put(xtf_duration_at, 2 * (trace.end - trace.begin) / ping.sound_speed, "duration");
  fields.put(xtf_period_at, ping.period > 0 ? ping.period : 2 * trace.end / ping.sound_speed, "period");
  put_little_at(bytes, xtf_flags_at, trace.with_gain ? xtf_tvg_flag : std::uint16_t{0});
  put_little_at(bytes, xtf_trace_frequency_at, kilohertz(trace.frequency));
  put_little_at(bytes, xtf_samples_at, static_cast<std::uint32_t>(trace.samples.size()));
  return bytes + samples_of(trace, channel, ping.number);
}

void put_ping(const XtfPing& ping, std::string& bytes) {
  const PingFields fields{bytes, ping.number};
  put_time(bytes, ping.time, ping.number);
  put_little_at(bytes, xtf_ping_number_at, ping.number);
  fields.put(xtf_sound_speed_at, ping.sound_speed / 2, "sound speed");  // halved, as in recorders' files (one way)
  fields.put(xtf_computed_speed_at, ping.sound_speed, "sound speed");
  fields.put(xtf_ship_speed_at, ping.speed / xtf_knot, "speed");
  fields.put(xtf_sensor_speed_at, ping.speed / xtf_knot, "speed");
  fields.put(xtf_ship_gyro_at, degrees(ping.ship_heading), "heading");
  fields.put_position(xtf_ship_x_at, xtf_ship_y_at, ping.ship, "ship");
  fields.put_position(xtf_sensor_x_at, xtf_sensor_y_at, ping.sensor, "sonar");
  fields.put(xtf_depth_at, ping.depth, "depth");
  fields.put(xtf_altitude_at, ping.altitude, "altitude");
  fields.put(xtf_pitch_at, degrees(ping.pitch), "pitch");
  fields.put(xtf_roll_at, degrees(ping.roll), "roll");
  fields.put(xtf_heading_at, degrees(ping.heading), "heading");
  fields.put(xtf_yaw_at, degrees(ping.yaw), "yaw");
}

}  // namespace

std::size_t sample_bytes(XtfSamples samples) {
  return samples == XtfSamples::integer_8 ? 1 : samples == XtfSamples::integer_16 ? 2 : 4;
}

double full_scale(XtfSamples samples) {
  return samples == XtfSamples::integer_8    ? 255
         : samples == XtfSamples::integer_16 ? 65535
         : samples == XtfSamples::integer_32 ? 4294967295.0
                                             : 1;
}

XtfFile::XtfFile(const std::string& path, const XtfHeader& header)
    : pending_(std::make_shared<PendingFile>(path)),
      out_(pending_->temporary(), std::ios::binary),
      channels_(header.channels) {
  if (channels_.empty() || channels_.size() > xtf_channels_in_header)
    fail(ErrorKind::argument, "XtfFile: header has ", channels_.size(), " channels, must be within 1 and ",
         xtf_channels_in_header);
  if (!header.in_degrees) fail(ErrorKind::argument, "XtfFile: places must be in degrees");
  for (const XtfChannel& channel : channels_)
    if (channel.samples != XtfSamples::integer_16 && channel.samples != XtfSamples::ieee_float)
      fail(ErrorKind::argument, "XtfFile: samples of channel ", channel.name, " must be of 16 bits or IEEE floats");
  out_ << header_bytes(header, path);
  for (const std::string& note : header.notes) out_ << note_bytes(note);
}

void XtfFile::add(const XtfPing& ping) {
  if (ping.traces.empty()) fail(ErrorKind::content, "XTF: ping ", ping.number, " has no channel");
  std::string bytes(xtf_ping_bytes, '\0');
  put_ping(ping, bytes);
  for (const XtfTrace& trace : ping.traces) {
    if (trace.channel >= channels_.size() || trace.samples.empty())
      fail(ErrorKind::content, "XTF: ping ", ping.number, " has ", trace.samples.size(), " samples of channel ",
           trace.channel, ", must have some of a channel below ", channels_.size());
    bytes += trace_bytes(trace, channels_[trace.channel], ping);
  }
  bytes.append((xtf_packet_step - bytes.size() % xtf_packet_step) % xtf_packet_step, '\0');
  put_little_at(bytes, xtf_magic_at, xtf_magic);
  bytes[xtf_packet_type_at] = static_cast<char>(xtf_sonar_packet);
  put_little_at(bytes, xtf_traces_at, static_cast<std::uint16_t>(ping.traces.size()));
  put_little_at(bytes, xtf_packet_bytes_at, static_cast<std::uint32_t>(bytes.size()));
  out_ << bytes;
}

void XtfFile::finish() { pending_->commit(out_); }

}  // namespace insonify
