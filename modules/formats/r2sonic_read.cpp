// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "formats/r2sonic_record.hpp"
#include "formats/xtf_layout_internal.hpp"
#include "formats/xtf_packets_internal.hpp"

namespace insonify {
namespace {

constexpr std::uint8_t r2sonic_packet_type = 65, attitude_packet = 3;
/// Offsets in a packet of attitude, 64 bytes. The date is that of the clock, to milliseconds.
enum XtfAttitudeOffset : std::size_t {
  xtf_attitude_pitch_at = 30,
  xtf_attitude_roll_at = 34,
  xtf_attitude_heave_at = 38,
  xtf_attitude_heading_at = 50,
  xtf_attitude_year_at = 54,
  xtf_attitude_milliseconds_at = 61,
  xtf_attitude_bytes = 64
};

/// Returns a sounding along a straight ray (E211): c t / 2 under the angle less the roll, turned by the pitch.
SwathSounding straight_sounding(const R2SonicPacket& packet, std::size_t point, const SwathPing& ping) {
  const double range = 0.5 * ping.sound_speed * packet.travel_time[point];
  const double down = range * std::cos(packet.angle[point] - ping.roll);  // (E211)
  SwathSounding sounding;
  sounding.beam = point;
  sounding.travel_time = packet.travel_time[point];
  sounding.across = range * std::sin(packet.angle[point] - ping.roll);
  sounding.along = down * std::sin(ping.pitch);
  sounding.depth = ping.head_depth + down * std::cos(ping.pitch);
  if (!packet.intensity.empty() && packet.intensity[point] > 0)
    sounding.level_db = db_from_amplitude(packet.intensity[point]);
  if (!packet.flags.empty()) sounding.rejected = (packet.flags[point] & r2sonic_passed) != r2sonic_passed;
  sounding.angle = swath_angle(sounding, ping.head_depth);
  return sounding;
}

SwathPing r2sonic_ping(std::string_view bytes, const R2SonicPacket& packet) {
  SwathPing ping;
  ping.number = packet.number, ping.time = packet.time;
  ping.sound_speed = packet.sound_speed > 0 ? packet.sound_speed : xtf_sound_speed_of(bytes);
  ping.frequency = packet.frequency;
  ping.position = {radians(little_at<double>(bytes, xtf_ship_y_at)), radians(little_at<double>(bytes, xtf_ship_x_at)),
                   0};
  ping.heading = radians(xtf_real_at(bytes, xtf_heading_at)), ping.pitch = radians(xtf_real_at(bytes, xtf_pitch_at));
  ping.roll = radians(xtf_real_at(bytes, xtf_roll_at)), ping.heave = xtf_real_at(bytes, xtf_heave_at);
  ping.head_depth = xtf_real_at(bytes, xtf_depth_at) - ping.heave;
  ping.beams = packet.travel_time.size();
  for (std::size_t point = 0; point < ping.beams; ++point)
    if (packet.travel_time[point] > 0) ping.soundings.push_back(straight_sounding(packet, point, ping));
  return ping;
}

RecordedAttitude xtf_attitude(std::string_view packet, const std::string& where) {
  RecordedAttitude attitude;
  std::string dated(xtf_ping_bytes, '\0');  // its date where that of a ping is
  dated.replace(xtf_year_at, 7, packet.substr(xtf_attitude_year_at, 7));
  attitude.time = xtf_time_of(dated, where) + 1e-3 * little_at<std::uint16_t>(packet, xtf_attitude_milliseconds_at);
  attitude.heading = radians(xtf_real_at(packet, xtf_attitude_heading_at));
  attitude.pitch = radians(xtf_real_at(packet, xtf_attitude_pitch_at));
  attitude.roll = radians(xtf_real_at(packet, xtf_attitude_roll_at));
  attitude.heave = xtf_real_at(packet, xtf_attitude_heave_at);
  return attitude;
}

}  // namespace

SwathRecord read_r2sonic_xtf(const std::string& path) {
  BinaryInput file(path);
  const XtfOutline outline = read_xtf_outline(file, path);
  const std::string program = field_at(file.part(0, outline.bytes, "its header"), xtf_program_at, 8);
  SwathRecord record;
  record.format = "R2Sonic XTF" + (program.empty() ? "" : " by " + program);
  each_xtf_packet(file, path, outline.bytes, [&](std::string_view packet, const std::string& where) {
    const std::uint8_t type = xtf_byte_at(packet, xtf_packet_type_at);
    ++record.records["type " + std::to_string(type)];
    if (type == attitude_packet && packet.size() >= xtf_attitude_bytes)
      record.attitudes.push_back(xtf_attitude(packet, where));
    if (type != r2sonic_packet_type) return;
    if (packet.size() < xtf_ping_bytes) fail(ErrorKind::content, where, " ends within its header");
    const R2SonicPacket stored = read_r2sonic_packet(std::string(packet.substr(xtf_ping_bytes)), where);
    record.pings.push_back(r2sonic_ping(packet, stored));
    record.sonar = "R2Sonic " + stored.model;
    if (!stored.intensity.empty()) record.unit = "dB re 1 uPa";
  });
  if (record.pings.empty())
    fail(ErrorKind::content, path, ": has no bathymetry packet of an R2Sonic (type 65); other sonars' are not read");
  return record;
}

bool is_bathymetry_xtf(const std::string& path) {
  BinaryInput file(path);
  if (file.size() < xtf_header_bytes) return false;
  const std::string head = file.part(0, xtf_header_bytes, "its header");
  return xtf_byte_at(head, xtf_format_at) == xtf_file_format &&
         little_at<std::uint16_t>(head, xtf_sonar_channels_at) == 0 &&
         little_at<std::uint16_t>(head, xtf_bathymetry_channels_at) > 0;
}

}  // namespace insonify
