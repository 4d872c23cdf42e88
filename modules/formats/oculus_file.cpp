// SPDX-License-Identifier: BSD-3-Clause
#include "formats/oculus_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/binary_input_internal.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "returns/ping.hpp"

namespace insonify {
namespace {

// A message of the SDK begins with its own mark; a log of the maker's viewer and its items begin with others.
constexpr std::uint16_t oculus_mark = 0x4f53, oculus_ping_result = 0x23;
constexpr std::uint32_t oculus_log_mark = 0x11223344, oculus_item_mark = 0xaabbccdd;
constexpr std::uint16_t oculus_sonar_item = 10;
constexpr std::size_t oculus_head_bytes = 16, oculus_item_bytes = 40;
constexpr double farthest_oculus_range = 1000;  // [m], beyond any of these sonars

/// Offsets in all messages of a ping.
enum OculusOffset : std::size_t {
  oculus_message = 6,
  oculus_version = 8,
  oculus_payload = 10,
  oculus_mode = 16,
  oculus_gamma = 19,
  oculus_gain = 29
};

/// Offsets that differ between the versions of the message; 0: absent. Heading, pitch and roll follow each other.
struct ResultLayout {
  std::size_t number, frequency, attitude, speed, time, size, resolution, ranges, beams, image, image_bytes, bearings;
};
constexpr ResultLayout result_1{53, 61, 0, 85, 0, 97, 98, 106, 108, 110, 114, 122};
constexpr ResultLayout result_2{89, 97, 121, 145, 153, 161, 162, 170, 172, 190, 194, 202};

/// Offset and size of a message in the file.
struct MessageSpan {
  std::size_t at = 0, bytes = 0;
};

/// Sets `offset` to the message at `at`. Returns true if it is a ping. Throws Error(content) for damaged messages.
bool take_message(BinaryInput& file, const std::string& path, std::size_t at, MessageSpan& offset) {
  const std::string head = file.part(at, oculus_head_bytes, "the header of a message");
  if (little_at<std::uint16_t>(head, 0) != oculus_mark)
    fail(ErrorKind::content, path, ": the message at byte ", at,
         at == 0 ? " does not begin with the mark of Oculus, 0x4f53, so it is no log of that sonar"
                 : " does not begin with the mark of Oculus, 0x4f53; the file is damaged, copy it again");
  offset = {at, oculus_head_bytes + little_at<std::uint32_t>(head, oculus_payload)};
  if (offset.bytes > file.size() - at)
    fail(ErrorKind::content, path, ": ends within the message at byte ", at, " of ", offset.bytes,
         " bytes; the file is truncated, copy it again");
  return little_at<std::uint16_t>(head, oculus_message) == oculus_ping_result;
}

/// Returns the ping messages that the items of a log hold.
std::vector<MessageSpan> messages_of_items(BinaryInput& file, const std::string& path) {
  std::vector<MessageSpan> offsets;
  std::size_t at = little_at<std::uint32_t>(file.part(0, 8, "its header"), 4);
  if (at < 8 || at > file.size())
    fail(ErrorKind::content, path, ": ends within its header of ", at, " bytes; the file is truncated, copy it again");
  while (at < file.size()) {
    const std::string head = file.part(at, oculus_item_bytes, "the header of an item");
    const std::size_t head_bytes = little_at<std::uint32_t>(head, 4), bytes = little_at<std::uint32_t>(head, 32);
    if (little_at<std::uint32_t>(head, 0) != oculus_item_mark || head_bytes < oculus_item_bytes)
      fail(ErrorKind::content, path, ": the item at byte ", at, " does not begin as one; the file is damaged");
    if (head_bytes > file.size() - at || bytes > file.size() - at - head_bytes)
      fail(ErrorKind::content, path, ": ends within the item at byte ", at, "; the file is truncated, copy it again");
    MessageSpan offset;
    if (little_at<std::uint16_t>(head, 8) == oculus_sonar_item) {
      if (little_at<std::uint16_t>(head, 24) != 0)
        fail(ErrorKind::content, path, ": the item at byte ", at, " is compressed; record without compression");
      if (take_message(file, path, at + head_bytes, offset)) offsets.push_back(offset);
    }
    at += head_bytes + bytes;
  }
  return offsets;
}

std::vector<MessageSpan> ping_messages(BinaryInput& file, const std::string& path) {
  if (little_at<std::uint32_t>(file.part(0, 4, "its header"), 0) == oculus_log_mark)
    return messages_of_items(file, path);
  std::vector<MessageSpan> offsets;
  MessageSpan offset;
  for (std::size_t at = 0; at < file.size(); at += offset.bytes)
    if (take_message(file, path, at, offset)) offsets.push_back(offset);
  return offsets;
}

int bits_of(const std::string& where, std::uint8_t code) {
  if (code == 0) return 8;
  if (code == 1) return 16;
  if (code == 3) return 32;
  fail(ErrorKind::content, where, " has samples of type ", int{code}, ", must be 0 (8 bits), 1 (16) or 3 (32)");
}

/// Returns the directions that the message lists [0.01 degrees, positive to starboard].
BeamFan oculus_fan(const std::string& message, const ResultLayout& layout, std::size_t beams, bool high,
                   const std::string& where) {
  BeamFan fan;
  for (std::size_t b = 0; b < beams; ++b) {
    fan.azimuth.push_back(-radians(0.01 * little_at<std::int16_t>(message, layout.bearings + 2 * b)));
    fan.elevation.push_back(0);
    if (!(std::abs(fan.azimuth[b]) <= pi / 2))
      fail(ErrorKind::content, where, " has a beam at ", degrees(-fan.azimuth[b]),
           " degrees, must be within -90 and 90");
  }
  const auto [low, high_end] = std::minmax_element(fan.azimuth.begin(), fan.azimuth.end());
  if (!(*high_end > *low)) fail(ErrorKind::content, where, " has all its ", beams, " beams in one direction");
  fan.beam_width = (*high_end - *low) / static_cast<double>(beams - 1);
  fan.elevation_width = radians(high ? 12 : 20);  // widths of the M-series by the maker
  return fan;
}

/// Reads the samples range by range; each range begins with its gain if gains are sent.
void read_image(const std::string& message, std::size_t image, bool with_gain, OculusPing& ping) {
  const auto bytes = static_cast<std::size_t>(ping.bits / 8);
  std::size_t at = image;
  for (Eigen::Index n = 0; n < ping.value.cols(); ++n) {
    if (with_gain) ping.gains.push_back(little_at<float>(message, at)), at += 4;
    for (Eigen::Index b = 0; b < ping.value.rows(); ++b, at += bytes)
      ping.value(b, n) = ping.bits == 8    ? static_cast<std::uint8_t>(message[at])
                         : ping.bits == 16 ? little_at<std::uint16_t>(message, at)
                                           : little_at<std::uint32_t>(message, at);
  }
}

OculusPing ping_of(const std::string& message, const std::string& where) {
  const ResultLayout& layout = little_at<std::uint16_t>(message, oculus_version) == 2 ? result_2 : result_1;
  if (message.size() < layout.bearings) fail(ErrorKind::content, where, " ends within its header");
  OculusPing ping;
  ping.number = little_at<std::uint32_t>(message, layout.number);
  ping.frequency = little_at<double>(message, layout.frequency);
  ping.sound_speed = little_at<double>(message, layout.speed);
  ping.gain_percent = little_at<double>(message, oculus_gain);
  ping.high_frequency = message[oculus_mode] == 2;
  const auto gamma = static_cast<std::uint8_t>(message[oculus_gamma]);
  ping.gamma = gamma == 0 ? 1 : (gamma + 1) / 256.0;  // 127 is a half, 255 one
  if (layout.time > 0) ping.time = little_at<double>(message, layout.time);
  if (layout.attitude > 0) {
    ping.heading = radians(little_at<double>(message, layout.attitude));
    ping.pitch = radians(little_at<double>(message, layout.attitude + 8));
    ping.roll = radians(little_at<double>(message, layout.attitude + 16));
  }

  // Check the geometry before the image is read.
  const double bin = little_at<double>(message, layout.resolution);
  const std::size_t ranges = little_at<std::uint16_t>(message, layout.ranges),
                    beams = little_at<std::uint16_t>(message, layout.beams);
  if (ranges == 0 || beams < 2 || !(bin > 0 && bin * static_cast<double>(ranges) < farthest_oculus_range) ||
      !(ping.sound_speed > 1000 && ping.sound_speed < 2000))
    fail(ErrorKind::content, where, " has no geometry: ", beams, " beams, ", ranges, " ranges of ", bin,
         " m, sound speed ", ping.sound_speed, " m/s; must be 2 and 1 at least, > 0, and 1000 to 2000 m/s");
  ping.bits = bits_of(where, static_cast<std::uint8_t>(message[layout.size]));
  // Recorders set the flag of gains that they do not send, so the size of the image decides.
  const std::size_t row = beams * static_cast<std::size_t>(ping.bits / 8),
                    image = little_at<std::uint32_t>(message, layout.image),
                    bytes = little_at<std::uint32_t>(message, layout.image_bytes);
  const bool with_gain = bytes == ranges * (row + 4);
  if ((bytes != ranges * row && !with_gain) || image < layout.bearings + 2 * beams || image > message.size() ||
      bytes > message.size() - image)
    fail(ErrorKind::content, where, " has an image of ", bytes, " bytes from ", image, " on, must have ", ranges * row,
         ", or ", ranges * (row + 4), " with gains, behind its bearings, in ", message.size());
  ping.fan = oculus_fan(message, layout, beams, ping.high_frequency, where);
  ping.gate = {0, bin * static_cast<double>(ranges), bin};
  while (ping.gate.bins() > ranges) ping.gate.max_range -= 1e-6 * bin;
  ping.value.resize(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(ranges));
  read_image(message, image, with_gain, ping);
  return ping;
}

}  // namespace

OculusPing read_oculus_ping(const std::string& path, std::size_t number) {
  BinaryInput file(path);
  const std::vector<MessageSpan> offsets = ping_messages(file, path);
  if (offsets.empty()) fail(ErrorKind::content, path, ": has no ping of an Oculus sonar");
  if (number >= offsets.size())
    fail(ErrorKind::argument, path, ": ping ", number, ", must be below the number of pings, ", offsets.size());
  const MessageSpan& offset = offsets[number];
  OculusPing ping = ping_of(file.part(offset.at, offset.bytes, "a message"),
                            path + ": the ping at byte " + std::to_string(offset.at));
  ping.pings = offsets.size();
  return ping;
}

Grid<float> level_db(const OculusPing& ping) {
  const double scale = std::ldexp(1.0, ping.bits) - 1;
  return ping.value.unaryExpr([&](std::uint32_t value) {
    return static_cast<float>(value == 0 ? silence_db : db_from_amplitude(value / scale) / ping.gamma);
  });
}

}  // namespace insonify
