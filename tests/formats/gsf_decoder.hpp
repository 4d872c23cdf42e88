// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A decoder of the Generic Sensor Format 3.11, from its specification: every record that it has a name for, and of a
// ping every array and the sensors 114, 149 and 152. Anything else, and a byte too many or too few, is an error.
#include <map>
#include <optional>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

struct GsfSwath {
  double time, longitude_deg, latitude_deg;
  int beams, centre_beam, ping_flags;
  double tide, depth_corrector;
  double heading_deg, pitch_deg, roll_deg, heave, course_deg, speed_knots;
  double height, separation, gps_tide;
  std::map<int, std::vector<double>> arrays;  ///< scaled, by subrecord id
  std::vector<int> flags;
  int sensor;
  std::map<std::string, double> of_sensor;
  std::string sensor_model;                        ///< model of sensor 152
  std::vector<std::pair<double, double>> profile;  ///< profile that holds for it
};

struct GsfHistory {
  double time;
  std::string machine, operator_name, command, comment;
};

struct GsfPositionError {
  double time;
  int record;
  double horizontal, vertical;
  std::string type;
};

struct GsfAttitudeEntry {
  double time, pitch_deg, roll_deg, heave, heading_deg;
};

struct GsfSummaryContent {
  double begin, end, south_deg, west_deg, north_deg, east_deg, least_depth, greatest_depth;
};

struct GsfContent {
  std::string version;
  std::vector<int> records;  ///< ids in the order of the file
  std::vector<std::string> parameters;
  std::map<std::string, std::string> parameter;  ///< value of each key
  double profile_time, profile_longitude_deg, profile_latitude_deg;
  std::vector<std::pair<double, double>> profile;  ///< last profile
  std::vector<std::string> comments;
  std::vector<GsfHistory> histories;
  std::vector<GsfPositionError> position_errors;
  std::vector<std::vector<GsfAttitudeEntry>> attitudes;  ///< one list per record
  std::optional<GsfSummaryContent> summary;
  std::vector<GsfSwath> swaths;
};

inline double gsf_time(Cursor& c) {
  const auto seconds = static_cast<double>(c.unsigned_big(4));
  const auto nanoseconds = static_cast<double>(c.unsigned_big(4));
  if (nanoseconds >= 1e9) throw std::runtime_error("a second of more than 10^9 ns");
  return seconds + 1e-9 * nanoseconds;
}

inline double gsf_signed(Cursor& c, int bytes, double steps) {
  return static_cast<double>(c.signed_big(bytes)) / steps;
}
inline double gsf_unsigned(Cursor& c, int bytes, double steps) {
  return static_cast<double>(c.unsigned_big(bytes)) / steps;
}

/// Reads a text after its length, which counts the 0 at its end.
inline std::string gsf_text(Cursor& c, int length_bytes) {
  const std::string text = c.text(static_cast<std::size_t>(c.unsigned_big(length_bytes)));
  if (text.empty() || text.back() != '\0' || text.find('\0') + 1 != text.size())
    throw std::runtime_error("text does not end with its only 0");
  return text.substr(0, text.size() - 1);
}

struct GsfScale {
  double multiplier, offset;
  int field;
};

// Reads an array; table 4-3 and the types of gsfLoadScaleFactor give usual bytes and sign by subrecord id.
inline void read_gsf_array(Cursor& c, int id, std::size_t size, const GsfScale& scale, GsfSwath& s) {
  const std::map<int, std::pair<int, bool>> usual = {
      {1, {2, false}},  {2, {2, true}},   {3, {2, true}},   {4, {2, false}},  {5, {2, true}},   {6, {1, true}},
      {7, {1, false}},  {8, {1, false}},  {9, {1, false}},  {10, {1, true}},  {14, {2, false}}, {17, {1, true}},
      {18, {2, false}}, {19, {2, false}}, {20, {2, false}}, {22, {1, false}}, {23, {1, false}}};
  const auto [bytes, is_signed] = usual.at(id);
  const int width = scale.field == 0 ? bytes : scale.field >> 4;
  if (size != static_cast<std::size_t>(width * s.beams)) throw std::runtime_error("array of another length");
  for (int b = 0; b < s.beams; ++b) {
    const double raw =
        is_signed ? static_cast<double>(c.signed_big(width)) : static_cast<double>(c.unsigned_big(width));
    s.arrays[id].push_back(raw / scale.multiplier - scale.offset);
  }
}

/// A field of a sensor: unsigned of so many bytes and steps to a unit, or with steps = 0 bytes that must be 0.
struct GsfSensorField {
  const char* name;
  int bytes;
  double steps;
};

inline const std::vector<GsfSensorField>& gsf_sensor_layout(int sensor) {
  static const std::vector<GsfSensorField> seabat_ii = {
      {"ping_number", 2, 1}, {"surface_velocity", 2, 10}, {"mode", 2, 0},         {"range", 2, 1},
      {"power, gain", 4, 0}, {"fore_aft_deg", 1, 10},     {"athwart_deg", 1, 10}, {"spare", 4, 0}};
  static const std::vector<GsfSensorField> em4 = {{"model_number", 2, 1},
                                                  {"ping_counter", 2, 1},
                                                  {"serial_number", 2, 0},
                                                  {"surface_velocity", 2, 10},
                                                  {"transducer_depth", 4, 20000},
                                                  {"valid_detections", 2, 1},
                                                  {"sampling_frequency", 4, 1},
                                                  {"sampling_fraction", 4, 4e9},
                                                  {"doppler_scale", 4, 0},
                                                  {"vehicle_depth", 4, 1000},
                                                  {"spare_1", 16, 0},
                                                  {"transmit_sectors", 2, 1},
                                                  {"tilt, focus, length, delay", 12, 0},
                                                  {"sector_frequency", 4, 1000},
                                                  {"sector_absorption", 2, 100},
                                                  {"waveform, sector", 2, 0},
                                                  {"sector_bandwidth", 4, 1000},
                                                  {"spare", 16, 0},
                                                  {"spare_2", 16, 0},
                                                  {"run_time_model", 2, 1},
                                                  {"run_time_seconds", 4, 1},
                                                  {"run_time_nanoseconds", 4, 1e9},
                                                  {"run_time_ping_counter", 2, 1},
                                                  {"run_time_serial", 2, 0},
                                                  {"status, mode, filter", 6, 0},
                                                  {"min and max depth", 4, 0},
                                                  {"run_time_absorption", 2, 100},
                                                  {"pulse_length", 2, 0},
                                                  {"transmit_beam_width_deg", 2, 10},
                                                  {"power_reduction", 1, 0},
                                                  {"receive_beam_width_deg", 1, 10},
                                                  {"bandwidth, gain, angle, source", 4, 0},
                                                  {"port_swath_width", 2, 0},
                                                  {"spacing, port, stabilisation", 3, 0},
                                                  {"starboard", 3, 0},
                                                  {"tilt, filter_2", 3, 0},
                                                  {"run_time_spare", 16, 0},
                                                  {"load, status, coverage, yaw", 7, 0},
                                                  {"status_spare", 16, 0}};
  static const std::vector<GsfSensorField> r2sonic = {{"serial_number", 12, 0},
                                                      {"seconds", 4, 1},
                                                      {"nanoseconds", 4, 1e9},
                                                      {"ping_number", 4, 1},
                                                      {"ping_period", 4, 1e6},
                                                      {"sound_speed", 4, 100},
                                                      {"frequency", 4, 1000},
                                                      {"tx_power", 4, 100},
                                                      {"tx_pulse_width", 4, 0},
                                                      {"fore_aft_deg", 4, 1e6},
                                                      {"athwart_deg", 4, 1e6},
                                                      {"tx_steering", 8, 0},
                                                      {"tx_misc_info", 4, 0},
                                                      {"rx_bandwidth", 4, 1e4},
                                                      {"rx_sample_rate", 4, 1000},
                                                      {"rx_range", 4, 1e5},
                                                      {"rx_gain, rx_spreading", 8, 0},
                                                      {"rx_absorption", 4, 1000},
                                                      {"rx_mount_tilt, rx_misc_info", 8, 0},
                                                      {"reserved", 2, 0},
                                                      {"num_beams", 2, 1},
                                                      {"more_info", 48, 0},
                                                      {"depth_gate", 12, 0},
                                                      {"spare", 32, 0}};
  return sensor == 114 ? seabat_ii : sensor == 149 ? em4 : r2sonic;
}

inline void read_gsf_sensor(Cursor& c, int sensor, std::size_t size, GsfSwath& s) {
  const std::size_t begin = c.at();
  s.sensor = sensor;
  if (sensor == 152) s.sensor_model = c.text(12);
  for (const GsfSensorField& field : gsf_sensor_layout(sensor)) {
    if (field.steps > 0) {
      s.of_sensor[field.name] = gsf_unsigned(c, field.bytes, field.steps);
    } else if (c.text(static_cast<std::size_t>(field.bytes)).find_first_not_of('\0') != std::string::npos) {
      throw std::runtime_error(std::string(field.name) + " is not 0");
    }
  }
  if (c.at() - begin != size) throw std::runtime_error("sensor subrecord of another length");
}

inline GsfSwath read_gsf_swath(const std::string& data, std::map<int, GsfScale>& scales) {
  Cursor c(data);
  GsfSwath s{};
  s.time = gsf_time(c);
  s.longitude_deg = gsf_signed(c, 4, 1e7), s.latitude_deg = gsf_signed(c, 4, 1e7);
  s.beams = static_cast<int>(c.unsigned_big(2)), s.centre_beam = static_cast<int>(c.unsigned_big(2));
  s.ping_flags = static_cast<int>(c.unsigned_big(2));
  c.text(2);
  s.tide = gsf_signed(c, 2, 100), s.depth_corrector = gsf_signed(c, 4, 100);
  s.heading_deg = gsf_unsigned(c, 2, 100);
  s.pitch_deg = gsf_signed(c, 2, 100), s.roll_deg = gsf_signed(c, 2, 100), s.heave = gsf_signed(c, 2, 100);
  s.course_deg = gsf_unsigned(c, 2, 100), s.speed_knots = gsf_unsigned(c, 2, 100);
  s.height = gsf_signed(c, 4, 1000), s.separation = gsf_signed(c, 4, 1000), s.gps_tide = gsf_signed(c, 4, 1000);
  c.text(2);
  while (data.size() - c.at() >= 4) {
    const int id = static_cast<int>(c.unsigned_big(1));
    const auto size = static_cast<std::size_t>(c.unsigned_big(3));
    if (id == 100) {
      for (std::uint64_t n = c.unsigned_big(4); n > 0; --n) {
        const int array = static_cast<int>(c.unsigned_big(1)), field = static_cast<int>(c.unsigned_big(1));
        c.text(2);
        const auto multiplier = static_cast<double>(c.signed_big(4)), offset = static_cast<double>(c.signed_big(4));
        scales[array] = {multiplier, offset, field};
      }
    } else if (id == 16) {
      for (std::size_t b = 0; b < size; ++b) s.flags.push_back(static_cast<int>(c.unsigned_big(1)));
    } else if (id == 114 || id == 149 || id == 152) {
      read_gsf_sensor(c, id, size, s);
    } else {
      read_gsf_array(c, id, size, scales.at(id), s);
    }
  }
  if (s.flags.size() != static_cast<std::size_t>(s.beams)) throw std::runtime_error("other number of flags");
  return s;
}

inline void read_gsf_profile(Cursor& in, GsfContent& content) {
  content.profile_time = gsf_time(in);
  content.profile.clear();
  if (gsf_time(in) != content.profile_time) throw std::runtime_error("profile applied at another time");
  content.profile_longitude_deg = gsf_signed(in, 4, 1e7), content.profile_latitude_deg = gsf_signed(in, 4, 1e7);
  for (std::uint64_t n = in.unsigned_big(4); n > 0; --n) {
    const double depth = gsf_unsigned(in, 4, 100);
    content.profile.emplace_back(depth, gsf_unsigned(in, 4, 100));
  }
}

inline void read_gsf_parameters(Cursor& in, GsfContent& content) {
  gsf_time(in);
  for (std::uint64_t n = in.unsigned_big(2); n > 0; --n) {
    const std::string text = gsf_text(in, 2);
    content.parameters.push_back(text);
    content.parameter[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
  }
}

inline void read_gsf_attitudes(Cursor& in, GsfContent& content) {
  const double base = gsf_time(in);
  std::vector<GsfAttitudeEntry> entries;
  for (std::uint64_t n = in.unsigned_big(2); n > 0; --n) {
    GsfAttitudeEntry e{};
    e.time = base + gsf_unsigned(in, 2, 1000);
    e.pitch_deg = gsf_signed(in, 2, 100), e.roll_deg = gsf_signed(in, 2, 100), e.heave = gsf_signed(in, 2, 100);
    e.heading_deg = gsf_unsigned(in, 2, 100);
    entries.push_back(e);
  }
  content.attitudes.push_back(entries);
}

inline GsfSummaryContent read_gsf_summary(Cursor& in) {
  GsfSummaryContent s{};
  s.begin = gsf_time(in), s.end = gsf_time(in);
  s.south_deg = gsf_signed(in, 4, 1e7), s.west_deg = gsf_signed(in, 4, 1e7);
  s.north_deg = gsf_signed(in, 4, 1e7), s.east_deg = gsf_signed(in, 4, 1e7);
  s.least_depth = gsf_signed(in, 4, 100), s.greatest_depth = gsf_signed(in, 4, 100);
  return s;
}

inline GsfPositionError read_gsf_position_error(Cursor& in) {
  GsfPositionError e{};
  e.time = gsf_time(in);
  e.record = static_cast<int>(in.unsigned_big(4));
  e.horizontal = gsf_signed(in, 4, 1000), e.vertical = gsf_signed(in, 4, 1000);
  in.text(4);
  e.type = in.text(static_cast<std::size_t>(in.unsigned_big(2)));
  return e;
}

inline GsfContent read_gsf(const std::string& bytes) {
  GsfContent content{};
  std::map<int, GsfScale> scales;
  for (Cursor c(bytes); !c.done();) {
    const auto size = static_cast<std::size_t>(c.unsigned_big(4));
    const auto id = static_cast<int>(c.unsigned_big(4));
    if (size % 4 != 0) throw std::runtime_error("record is no multiple of four bytes");
    const std::string data = c.text(size);
    Cursor in(data);
    if (content.records.empty() != (id == 1)) throw std::runtime_error("one header, at the begin");
    content.records.push_back(id);
    if (id == 1) content.version = in.text(12);
    if (id == 2) {
      content.swaths.push_back(read_gsf_swath(data, scales));
      content.swaths.back().profile = content.profile;
    }
    if (id == 3) read_gsf_profile(in, content);
    if (id == 4) read_gsf_parameters(in, content);
    if (id == 6) gsf_time(in), content.comments.push_back(gsf_text(in, 4));
    if (id == 7)
      content.histories.push_back(
          GsfHistory{gsf_time(in), gsf_text(in, 2), gsf_text(in, 2), gsf_text(in, 2), gsf_text(in, 2)});
    if (id == 9) content.summary = read_gsf_summary(in);
    if (id == 11) content.position_errors.push_back(read_gsf_position_error(in));
    if (id == 12) read_gsf_attitudes(in, content);
    if (id == 5 || id == 8 || id == 10 || id > 12) throw std::runtime_error("record " + std::to_string(id));
    if (id != 2 && data.size() - in.at() >= 4) throw std::runtime_error("record longer than its fields");
  }
  return content;
}

}  // namespace insonify::decode
