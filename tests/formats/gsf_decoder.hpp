#pragma once
// A decoder of the Generic Sensor Format 3.11, from its specification.
#include <map>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

struct GsfSwath {
  double time, longitude_deg, latitude_deg;
  int beams;
  double heading_deg, pitch_deg, roll_deg, heave, course_deg, speed_knots;
  std::map<int, std::vector<double>> arrays;  ///< by subrecord id, scaled
  std::vector<int> flags;
  int ping_number, sonar_range;
  double surface_speed, fore_aft_deg, athwart_deg;
};

struct GsfContent {
  std::string version;
  std::vector<std::string> parameters;
  std::vector<std::pair<double, double>> profile;
  std::vector<GsfSwath> swaths;
};

inline double gsf_time(Cursor& c) {
  const auto seconds = static_cast<double>(c.unsigned_big(4));
  return seconds + 1e-9 * static_cast<double>(c.unsigned_big(4));
}

struct GsfScale {
  double multiplier, offset;
  int field;
};

inline void read_gsf_array(Cursor& c, int id, std::size_t size, const GsfScale& scale, GsfSwath& s) {
  const std::map<int, std::pair<int, bool>> usual = {
      {1, {2, false}}, {2, {2, true}},  {3, {2, true}},  {4, {2, false}},  {5, {2, true}},
      {7, {1, false}}, {9, {1, false}}, {18, {2, true}}, {19, {2, false}}, {20, {2, false}}};
  const auto [bytes, is_signed] = usual.at(id);
  const int width = scale.field == 0 ? bytes : scale.field >> 4;
  if (size != static_cast<std::size_t>(width * s.beams)) throw std::runtime_error("array of another length");
  for (int b = 0; b < s.beams; ++b) {
    const double raw =
        is_signed ? static_cast<double>(c.signed_big(width)) : static_cast<double>(c.unsigned_big(width));
    s.arrays[id].push_back(raw / scale.multiplier - scale.offset);
  }
}

inline GsfSwath read_gsf_swath(const std::string& data, std::map<int, GsfScale>& scales) {
  Cursor c(data);
  GsfSwath s{};
  s.time = gsf_time(c);
  s.longitude_deg = 1e-7 * static_cast<double>(c.signed_big(4));
  s.latitude_deg = 1e-7 * static_cast<double>(c.signed_big(4));
  s.beams = static_cast<int>(c.unsigned_big(2));
  c.text(2 + 2 + 2 + 2 + 4);  // centre beam, flags, reserved, tide, depth corrector
  s.heading_deg = 0.01 * static_cast<double>(c.unsigned_big(2));
  s.pitch_deg = 0.01 * static_cast<double>(c.signed_big(2));
  s.roll_deg = 0.01 * static_cast<double>(c.signed_big(2));
  s.heave = 0.01 * static_cast<double>(c.signed_big(2));
  s.course_deg = 0.01 * static_cast<double>(c.unsigned_big(2));
  s.speed_knots = 0.01 * static_cast<double>(c.unsigned_big(2));
  c.text(14);
  while (data.size() - c.at() >= 4) {
    const int id = static_cast<int>(c.unsigned_big(1));
    const auto size = static_cast<std::size_t>(c.unsigned_big(3));
    if (id == 0) break;  // padding
    if (id == 100) {
      for (std::uint64_t n = c.unsigned_big(4); n > 0; --n) {
        const int array = static_cast<int>(c.unsigned_big(1)), field = static_cast<int>(c.unsigned_big(1));
        c.text(2);
        const auto multiplier = static_cast<double>(c.signed_big(4)), offset = static_cast<double>(c.signed_big(4));
        scales[array] = {multiplier, offset, field};
      }
    } else if (id == 16) {
      for (std::size_t b = 0; b < size; ++b) s.flags.push_back(static_cast<int>(c.unsigned_big(1)));
    } else if (id == 114) {
      s.ping_number = static_cast<int>(c.unsigned_big(2));
      s.surface_speed = 0.1 * static_cast<double>(c.unsigned_big(2));
      c.text(2);
      s.sonar_range = static_cast<int>(c.unsigned_big(2));
      c.text(4);
      s.fore_aft_deg = 0.1 * static_cast<double>(c.unsigned_big(1));
      s.athwart_deg = 0.1 * static_cast<double>(c.unsigned_big(1));
      c.text(4);
    } else {
      read_gsf_array(c, id, size, scales.at(id), s);
    }
  }
  return s;
}

inline GsfContent read_gsf(const std::string& bytes) {
  GsfContent content;
  std::map<int, GsfScale> scales;
  for (Cursor c(bytes); !c.done();) {
    const auto size = static_cast<std::size_t>(c.unsigned_big(4));
    const auto id = c.unsigned_big(4);
    if (size % 4 != 0) throw std::runtime_error("record is no multiple of four bytes");
    const std::string data = c.text(size);
    Cursor in(data);
    if (content.version.empty() && id != 1) throw std::runtime_error("does not begin with a header");
    if (id == 1) content.version = in.text(12);
    if (id == 2) content.swaths.push_back(read_gsf_swath(data, scales));
    if (id == 3) {
      in.text(16 + 8);
      for (std::uint64_t n = in.unsigned_big(4); n > 0; --n) {
        const double depth = 0.01 * static_cast<double>(in.unsigned_big(4));
        content.profile.emplace_back(depth, 0.01 * static_cast<double>(in.unsigned_big(4)));
      }
    }
    if (id == 4) {
      in.text(8);
      for (std::uint64_t n = in.unsigned_big(2); n > 0; --n)
        content.parameters.push_back(in.text(static_cast<std::size_t>(in.unsigned_big(2))));
    }
  }
  return content;
}

}  // namespace insonify::decode
