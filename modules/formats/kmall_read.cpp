// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/binary_input_internal.hpp"
#include "formats/kmall_record.hpp"
#include "formats/record_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t kmall_head_bytes = 20, kmall_length_bytes = 4;
constexpr std::size_t kmall_most_datagram_bytes = std::size_t{1} << 26;
constexpr std::uint8_t kmall_rejected_detection = 2;

/// Offsets in the part of #MRZ that is of the ping.
enum KmallPingOffset : std::size_t {
  kmall_frequency_at = 16,
  kmall_sectors_at = 92,
  kmall_sector_bytes_at = 94,
  kmall_heading_at = 96,
  kmall_sound_speed_at = 100,
  kmall_head_depth_at = 104,
  kmall_water_level_at = 108,
  kmall_latitude_at = 124,
  kmall_longitude_at = 132,
  kmall_height_at = 140,
  kmall_ping_part_bytes = 144
};
/// Offsets in the part of #MRZ that is of the receiver.
enum KmallReceiverOffset : std::size_t {
  kmall_soundings_at = 2,
  kmall_sounding_bytes_at = 6,
  kmall_extra_soundings_at = 26,
  kmall_classes_at = 28,
  kmall_class_bytes_at = 30,
  kmall_receiver_part_bytes = 32
};
/// Offsets in a sounding of #MRZ.
enum KmallSoundingOffset : std::size_t {
  kmall_detection_type_at = 3,
  kmall_detection_method_at = 4,
  kmall_vertical_deviation_at = 20,
  kmall_horizontal_deviation_at = 24,
  kmall_reflectivity_at = 48,
  kmall_travel_time_at = 80,
  kmall_z_at = 96,
  kmall_y_at = 100,
  kmall_x_at = 104,
  kmall_sounding_bytes = 120
};
/// Offsets in a sample of #SKM.
enum KmallAttitudeOffset : std::size_t {
  kmall_sample_seconds_at = 8,
  kmall_sample_nanoseconds_at = 12,
  kmall_sample_roll_at = 40,
  kmall_sample_pitch_at = 44,
  kmall_sample_heading_at = 48,
  kmall_sample_heave_at = 52,
  kmall_attitude_sample_bytes = 56
};

double kmall_float(std::string_view bytes, std::size_t at) { return static_cast<double>(little_at<float>(bytes, at)); }
std::size_t kmall_count(std::string_view bytes, std::size_t at) { return little_at<std::uint16_t>(bytes, at); }

/// Returns the next part of a datagram, whose first two bytes state its length, which must be `least` at least.
std::string_view stated_part(RecordBytes& datagram, std::size_t least, const char* name) {
  const std::size_t length = datagram.little<std::uint16_t>();
  if (length < least)
    fail(ErrorKind::content, datagram.where(), ": its ", name, " has ", length, " bytes, must have at least ", least);
  datagram.go_to(datagram.size() - datagram.left() - 2);
  return datagram.take(length);
}

SwathSounding kmall_sounding(std::string_view bytes, std::size_t beam, double water_level, double head_depth) {
  SwathSounding sounding;
  sounding.beam = beam;
  sounding.depth = kmall_float(bytes, kmall_z_at) - water_level;
  sounding.across = kmall_float(bytes, kmall_y_at), sounding.along = kmall_float(bytes, kmall_x_at);
  sounding.travel_time = kmall_float(bytes, kmall_travel_time_at),
  sounding.level_db = kmall_float(bytes, kmall_reflectivity_at);
  sounding.vertical_deviation = kmall_float(bytes, kmall_vertical_deviation_at);
  sounding.horizontal_deviation = kmall_float(bytes, kmall_horizontal_deviation_at);
  sounding.rejected = static_cast<std::uint8_t>(bytes[kmall_detection_type_at]) == kmall_rejected_detection;
  sounding.angle = swath_angle(sounding, head_depth);
  return sounding;
}

void require_finite(const SwathSounding& s, const std::string& where) {
  for (const double value : {s.depth, s.across, s.along, s.travel_time, s.level_db, s.vertical_deviation})
    if (!std::isfinite(value))
      fail(ErrorKind::content, where, ": sounding ", s.beam, " holds a number that is not finite");
}

/// Reads the soundings, which follow the part of the receiver and the classes of extra detections.
void take_kmall_soundings(RecordBytes& datagram, double water_level, SwathPing& ping) {
  const std::string_view receiver = stated_part(datagram, kmall_receiver_part_bytes, "part of the receiver");
  const std::size_t bytes = kmall_count(receiver, kmall_sounding_bytes_at);
  if (bytes < kmall_sounding_bytes)
    fail(ErrorKind::content, datagram.where(), ": its soundings have ", bytes, " bytes, must have at least ",
         std::size_t{kmall_sounding_bytes});
  datagram.take(kmall_count(receiver, kmall_classes_at) * kmall_count(receiver, kmall_class_bytes_at));
  ping.beams = kmall_count(receiver, kmall_soundings_at) + kmall_count(receiver, kmall_extra_soundings_at);
  for (std::size_t beam = 0; beam < ping.beams; ++beam) {
    const std::string_view stored = datagram.take(bytes);
    if (stored[kmall_detection_method_at] == 0) continue;  // no valid detection
    ping.soundings.push_back(kmall_sounding(stored, beam, water_level, ping.head_depth));
    require_finite(ping.soundings.back(), datagram.where());
  }
}

SwathPing kmall_ping(RecordBytes& datagram, double time) {
  const std::size_t parts = datagram.little<std::uint16_t>();
  datagram.little<std::uint16_t>();
  if (parts > 1) fail(ErrorKind::content, datagram.where(), " is one of ", parts, " parts, must be whole");
  const std::string_view common = stated_part(datagram, 4, "common part");
  const std::string_view info = stated_part(datagram, kmall_ping_part_bytes, "part of the ping");
  datagram.take(kmall_count(info, kmall_sectors_at) * kmall_count(info, kmall_sector_bytes_at));
  SwathPing ping;
  ping.number = little_at<std::uint16_t>(common, 2), ping.time = time;
  ping.heading = radians(kmall_float(info, kmall_heading_at));
  ping.sound_speed = kmall_float(info, kmall_sound_speed_at),
  ping.frequency = std::max(0.0, kmall_float(info, kmall_frequency_at));
  ping.position = {radians(little_at<double>(info, kmall_latitude_at)),
                   radians(little_at<double>(info, kmall_longitude_at)), kmall_float(info, kmall_height_at)};
  ping.head_depth = kmall_float(info, kmall_head_depth_at);
  take_kmall_soundings(datagram, kmall_float(info, kmall_water_level_at), ping);
  return ping;
}

RecordedProfile kmall_profile(RecordBytes& datagram) {
  const std::string_view common = stated_part(datagram, 28, "common part");
  RecordedProfile profile;
  profile.time = little_at<std::uint32_t>(common, 8);
  for (std::size_t i = 0; i < kmall_count(common, 2); ++i) {
    const std::string_view entry = datagram.take(20);
    profile.depth.push_back(kmall_float(entry, 0)), profile.sound_speed.push_back(kmall_float(entry, 4));
  }
  return profile;
}

void take_kmall_attitudes(RecordBytes& datagram, std::vector<RecordedAttitude>& attitudes) {
  const std::string_view info = stated_part(datagram, 12, "part of the sensor");
  const std::size_t samples = kmall_count(info, 6), bytes = kmall_count(info, 8);
  if (bytes < kmall_attitude_sample_bytes)
    fail(ErrorKind::content, datagram.where(), ": its samples have ", bytes, " bytes, must have at least ",
         std::size_t{kmall_attitude_sample_bytes});
  for (std::size_t i = 0; i < samples; ++i) {
    const std::string_view sample = datagram.take(bytes);
    RecordedAttitude attitude;
    attitude.time = little_at<std::uint32_t>(sample, kmall_sample_seconds_at) +
                    1e-9 * little_at<std::uint32_t>(sample, kmall_sample_nanoseconds_at);
    attitude.heading = radians(kmall_float(sample, kmall_sample_heading_at));
    attitude.pitch = radians(kmall_float(sample, kmall_sample_pitch_at)),
    attitude.roll = radians(kmall_float(sample, kmall_sample_roll_at));
    attitude.heave = -kmall_float(sample, kmall_sample_heave_at);  // theirs is positive down
    attitudes.push_back(attitude);
  }
}

void take_datagram(const std::string& kind, double time, RecordBytes& datagram, SwathRecord& record) {
  if (kind == "#SVP") record.profiles.push_back(kmall_profile(datagram));
  if (kind == "#SKM") take_kmall_attitudes(datagram, record.attitudes);
  if (kind != "#MRZ") return;
  record.pings.push_back(kmall_ping(datagram, time));
  if (record.attitudes.empty()) return;
  record.pings.back().pitch = record.attitudes.back().pitch, record.pings.back().roll = record.attitudes.back().roll;
}

}  // namespace

SwathRecord read_kmall(const std::string& path) {
  BinaryInput file(path);
  SwathRecord record;
  record.format = "KMALL", record.unit = "dB (backscattering strength)";
  for (std::size_t at = 0; at < file.size();) {
    const std::string where = path + ": datagram at byte " + std::to_string(at);
    const std::string head = file.part(at, kmall_head_bytes, "the head of a datagram");
    const std::size_t bytes = little_at<std::uint32_t>(head, 0);
    const std::string kind = head.substr(4, 4);
    const bool named =
        kind[0] == '#' && std::all_of(kind.begin() + 1, kind.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
    if (!named || bytes < kmall_head_bytes + kmall_length_bytes || bytes > kmall_most_datagram_bytes)
      fail(ErrorKind::content, where, " does not begin as one of a .kmall file; the file is damaged, copy it again");
    const std::string data = file.part(at, bytes, "a datagram");
    if (little_at<std::uint32_t>(data, bytes - kmall_length_bytes) != bytes)
      fail(ErrorKind::content, where, " states two lengths; the file is damaged, copy it again");
    RecordBytes datagram(std::string_view(data).substr(kmall_head_bytes, bytes - kmall_head_bytes - kmall_length_bytes),
                         where);
    const double time = little_at<std::uint32_t>(head, 12) + 1e-9 * little_at<std::uint32_t>(head, 16);
    take_datagram(kind, time, datagram, record);
    if (kind == "#MRZ") record.sonar = "EM " + std::to_string(little_at<std::uint16_t>(head, 10));
    ++record.records[kind];
    at += bytes;
  }
  if (record.pings.empty()) fail(ErrorKind::content, path, ": has no swath (#MRZ)");
  return record;
}

}  // namespace insonify
