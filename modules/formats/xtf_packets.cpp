// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "formats/xtf_layout_internal.hpp"
#include "formats/xtf_packets_internal.hpp"

namespace insonify {
namespace {

constexpr double slowest_sound = 1000;  // [m/s]; lower speeds are half the true one

/// Returns the number of channels of any kind that the header describes.
std::size_t described_channels(std::string_view head) {
  return std::size_t{little_at<std::uint16_t>(head, xtf_sonar_channels_at)} +
         little_at<std::uint16_t>(head, xtf_bathymetry_channels_at) + xtf_byte_at(head, xtf_snippet_channels_at) +
         xtf_byte_at(head, xtf_forward_channels_at) + little_at<std::uint16_t>(head, xtf_echo_channels_at) +
         xtf_byte_at(head, xtf_interferometry_channels_at);
}

}  // namespace

XtfOutline read_xtf_outline(BinaryInput& file, const std::string& path) {
  const std::string format = file.part(0, 1, "its header");
  if (xtf_byte_at(format, xtf_format_at) != xtf_file_format)
    fail(ErrorKind::content, path, ": does not begin with 123, so it is no XTF recording");
  const std::string head = file.part(0, xtf_header_bytes, "its header");
  const std::size_t needed = xtf_channels_at + described_channels(head) * xtf_channel_bytes;
  XtfOutline outline;
  outline.sonars = little_at<std::uint16_t>(head, xtf_sonar_channels_at);
  outline.bathymetries = little_at<std::uint16_t>(head, xtf_bathymetry_channels_at);
  outline.bytes = std::max(xtf_header_bytes, (needed + xtf_header_bytes - 1) / xtf_header_bytes * xtf_header_bytes);
  return outline;
}

void each_xtf_packet(BinaryInput& file, const std::string& path, std::size_t begin,
                     const std::function<void(std::string_view packet, const std::string& where)>& take) {
  std::size_t at = begin;
  for (std::size_t number = 0; at < file.size(); ++number) {
    const std::string where = path + ": packet " + std::to_string(number) + " at byte " + std::to_string(at);
    const std::string head = file.part(at, xtf_packet_head, "packet " + std::to_string(number));
    if (little_at<std::uint16_t>(head, xtf_magic_at) != xtf_magic)
      fail(ErrorKind::content, where, " does not begin with 0xFACE; the file is damaged, copy it again");
    const std::size_t bytes = little_at<std::uint32_t>(head, xtf_packet_bytes_at);
    if (bytes < xtf_packet_head)
      fail(ErrorKind::content, where, " has ", bytes, " bytes, must have at least ", xtf_packet_head);
    const std::string packet = file.part(at, bytes, "packet " + std::to_string(number));
    at += bytes;
    take(packet, where);
  }
}

double xtf_time_of(std::string_view packet, const std::string& where) {
  using namespace std::chrono;
  const auto year_number = little_at<std::uint16_t>(packet, xtf_year_at);
  const std::uint8_t month_number = xtf_byte_at(packet, xtf_month_at), day_number = xtf_byte_at(packet, xtf_day_at);
  if (year_number == 0 && month_number == 0) return 0;
  const year_month_day date{year(year_number), month(month_number), day(day_number)};
  const int clock[] = {xtf_byte_at(packet, xtf_hour_at), xtf_byte_at(packet, xtf_minute_at),
                       xtf_byte_at(packet, xtf_second_at), xtf_byte_at(packet, xtf_hundredth_at)};
  if (!date.ok() || clock[0] > 23 || clock[1] > 59 || clock[2] > 60 || clock[3] > 99)
    fail(ErrorKind::content, where, " has the date ", year_number, "-", int{month_number}, "-", int{day_number}, " ",
         clock[0], ":", clock[1], ":", clock[2], ".", clock[3], ", which is none");
  return 86400.0 * static_cast<double>(sys_days(date).time_since_epoch().count()) + 3600.0 * clock[0] +
         60.0 * clock[1] + clock[2] + 0.01 * clock[3];
}

double xtf_real_at(std::string_view bytes, std::size_t at) {
  const auto value = little_at<float>(bytes, at);
  return std::isfinite(value) ? static_cast<double>(value) : 0.0;
}

double xtf_sound_speed_of(std::string_view packet) {
  double speed = xtf_real_at(packet, xtf_sound_speed_at);
  if (!(speed > 0)) speed = xtf_real_at(packet, xtf_computed_speed_at);
  if (!(speed > 0)) return 0;
  return speed < slowest_sound ? 2 * speed : speed;
}

}  // namespace insonify
