// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads XTF as the specification X41 has it, tables C, D, F, H and I, field by field in their order.
#include <array>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

struct XtfChannelInfo {
  int type = 0, sub_channel = 0, correction = 0, unipolar = 0, bytes = 0, format = 0;
  std::uint64_t old_samples = 0;
  std::string name;
  double volts = 0, frequency = 0, beam_angle = 0, tilt = 0, beam_width = 0;
};

struct XtfChannelOfPing {
  int channel = 0, flags = 0, frequency = 0, weight = 0;
  double slant_range = 0, ground_range = 0, delay = 0, duration = 0, period = 0;
  std::vector<double> samples;  ///< samples as stored
};

struct XtfSonarPacket {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, hundredth = 0, day_of_year = 0;
  std::uint64_t number = 0, bytes = 0, attitude_tag = 0, fix_milliseconds = 0;
  std::array<int, 4> fix{}, clock{};
  double sound_speed = 0, computed_speed = 0, ship_speed = 0, ship_gyro = 0, sensor_speed = 0;
  double ship_y = 0, ship_x = 0, sensor_y = 0, sensor_x = 0;
  double depth = 0, altitude = 0, pitch = 0, roll = 0, heading = 0, yaw = 0;
  std::vector<XtfChannelOfPing> channels;
};

struct XtfContent {
  std::string program, version, sonar, note, file_name;
  int nav_units = 0;
  std::vector<XtfChannelInfo> channels;
  std::vector<std::string> notes;
  std::vector<XtfSonarPacket> pings;
};

inline int small(Cursor& at, int bytes) { return static_cast<int>(at.unsigned_little(bytes)); }
inline std::string text_field(Cursor& at, std::size_t bytes) {
  const std::string field = at.text(bytes);
  return field.substr(0, field.find('\0'));
}
inline void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}
inline void skip_zeros(Cursor& at, std::size_t bytes) {
  require(at.text(bytes).find_first_not_of('\0') == std::string::npos, "a reserved byte is not 0");
}

inline XtfChannelInfo read_xtf_channel(Cursor& at) {
  XtfChannelInfo c;
  c.type = small(at, 1), c.sub_channel = small(at, 1), c.correction = small(at, 2), c.unipolar = small(at, 2);
  c.bytes = small(at, 2), c.old_samples = at.unsigned_little(4);
  c.name = text_field(at, 16);
  c.volts = at.float32(), c.frequency = at.float32(), c.beam_angle = at.float32(), c.tilt = at.float32();
  c.beam_width = at.float32();
  skip_zeros(at, 6 * 4 + 2);  // offsets, beams of an array
  c.format = small(at, 1);
  skip_zeros(at, 53);
  return c;
}

inline void read_xtf_header(Cursor& at, XtfContent& content) {
  require(small(at, 1) == 123 && small(at, 1) == 1, "no header of XTF");
  content.program = text_field(at, 8), content.version = text_field(at, 8), content.sonar = text_field(at, 16);
  at.text(2);  // type of sonar
  content.note = text_field(at, 64), content.file_name = text_field(at, 64);
  content.nav_units = small(at, 2);
  const int channels = small(at, 2);
  skip_zeros(at, 2 + 1 + 1 + 2 + 1 + 1 + 2);  // other kinds of channels
  skip_zeros(at, 4 + 12 + 10 + 4 + 12 * 4);   // reference point, projection, latency, offsets
  for (int c = 0; c < 6; ++c) {
    if (c >= channels) {
      skip_zeros(at, 128);
      continue;
    }
    content.channels.push_back(read_xtf_channel(at));
  }
  require(at.at() == 1024, "the header is not of 1024 bytes");
}

inline XtfChannelOfPing read_xtf_trace(Cursor& at, const XtfContent& content) {
  XtfChannelOfPing t;
  t.channel = small(at, 2);
  at.text(2);
  t.slant_range = at.float32(), t.ground_range = at.float32(), t.delay = at.float32(), t.duration = at.float32();
  t.period = at.float32();
  t.flags = small(at, 2), t.frequency = small(at, 2);
  skip_zeros(at, 3 * 2 + 4 + 2 + 1 + 1);  // gains, bandwidth, contacts
  const auto samples = at.unsigned_little(4);
  skip_zeros(at, 2 + 4 + 1 + 1 + 4);
  t.weight = static_cast<int>(at.signed_little(2));
  skip_zeros(at, 4);
  const XtfChannelInfo& info = content.channels.at(static_cast<std::size_t>(t.channel));
  for (std::uint64_t i = 0; i < samples; ++i)
    t.samples.push_back(info.format == 5 ? static_cast<double>(at.float32())
                                         : static_cast<double>(at.unsigned_little(info.bytes)));
  return t;
}

inline XtfSonarPacket read_xtf_ping(Cursor& at, int channels, const XtfContent& content) {
  XtfSonarPacket p;
  p.year = small(at, 2), p.month = small(at, 1), p.day = small(at, 1), p.hour = small(at, 1), p.minute = small(at, 1);
  p.second = small(at, 1), p.hundredth = small(at, 1), p.day_of_year = small(at, 2);
  skip_zeros(at, 4);  // event
  p.number = at.unsigned_little(4);
  p.sound_speed = at.float32();
  skip_zeros(at, 4 + 4 + 7 * 4);  // tide, reserved, conductivity to pressure
  p.computed_speed = at.float32();
  skip_zeros(at, 3 * 4 + 6 * 4 + 4 + 4);  // magnetometer, auxiliary, log, turbidity
  p.ship_speed = at.float32(), p.ship_gyro = at.float32(), p.ship_y = at.float64(), p.ship_x = at.float64();
  skip_zeros(at, 4);  // altitude and depth of the ship
  for (int& part : p.fix) part = small(at, 1);
  p.sensor_speed = at.float32();
  skip_zeros(at, 4);
  p.sensor_y = at.float64(), p.sensor_x = at.float64();
  skip_zeros(at, 4 * 2 + 2 * 4);  // status, cable
  p.depth = at.float32(), p.altitude = at.float32();
  skip_zeros(at, 4);
  p.pitch = at.float32(), p.roll = at.float32(), p.heading = at.float32();
  skip_zeros(at, 4);  // heave
  p.yaw = at.float32();
  p.attitude_tag = at.unsigned_little(4);
  skip_zeros(at, 4);
  p.fix_milliseconds = at.unsigned_little(4);
  for (int& part : p.clock) part = small(at, 1);
  skip_zeros(at, 16);
  for (int c = 0; c < channels; ++c) p.channels.push_back(read_xtf_trace(at, content));
  return p;
}

/// Throws std::runtime_error for a file that breaks the format.
inline XtfContent read_xtf_file(const std::string& bytes) {
  XtfContent content;
  Cursor at(bytes);
  read_xtf_header(at, content);
  while (!at.done()) {
    const std::size_t begin = at.at();
    require(at.unsigned_little(2) == 0xFACE, "a packet does not begin with its mark");
    const int type = small(at, 1);
    at.text(1);
    const int channels = small(at, 2);
    skip_zeros(at, 4);
    const std::uint64_t size = at.unsigned_little(4);
    require(size % 64 == 0, "a packet is not a multiple of 64 bytes");
    if (type == 1) {
      at.text(2 + 5 + 35);  // date
      content.notes.push_back(text_field(at, 200));
    } else {
      require(type == 0, "a packet is neither a ping nor an annotation");
      content.pings.push_back(read_xtf_ping(at, channels, content));
      content.pings.back().bytes = size;
    }
    require(at.at() <= begin + size && begin + size - at.at() < 64, "a packet has another size than it says");
    skip_zeros(at, begin + size - at.at());
  }
  return content;
}

}  // namespace insonify::decode
