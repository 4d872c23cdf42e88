#pragma once
// A decoder of LAS 1.4, point format 6 with the extra bytes level_db, deviation, ping and beam, from ASPRS LAS 1.4 R15.
#include <array>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

struct LasRow {
  std::array<double, 3> place;
  double time;  ///< UTC, seconds since 1970; of files of 2017 or later, with 18 leap seconds
  unsigned intensity, classification;
  float level_db, deviation;
  unsigned ping, beam;
};

inline std::vector<LasRow> read_las(const std::string& bytes) {
  Cursor head(bytes);
  if (head.text(4) != "LASF") throw std::runtime_error("no LAS");
  const auto at = [&](std::size_t offset) { return Cursor(bytes, offset); };
  if (at(24).unsigned_little(2) != 0x0401 || at(104).unsigned_little(1) != 6 || at(105).unsigned_little(2) != 44)
    throw std::runtime_error("another version or point format");
  const std::uint64_t data = at(96).unsigned_little(4), count = at(247).unsigned_little(8);
  if (bytes.size() != data + 44 * count) throw std::runtime_error("points of another number");
  std::array<double, 3> scale, offset;
  Cursor scales = at(131), offsets = at(155);
  for (double& s : scale) s = scales.float64();
  for (double& o : offset) o = offsets.float64();
  std::vector<LasRow> rows;
  for (std::uint64_t i = 0; i < count; ++i) {
    Cursor c = at(data + 44 * i);
    LasRow row{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      row.place[axis] = offset[axis] + scale[axis] * static_cast<double>(c.signed_little(4));
    row.intensity = static_cast<unsigned>(c.unsigned_little(2));
    c.text(2);
    row.classification = static_cast<unsigned>(c.unsigned_little(1));
    c.text(5);
    row.time = c.float64() + 1e9 + 315964800 - 18;
    row.level_db = c.float32(), row.deviation = c.float32();
    row.ping = static_cast<unsigned>(c.unsigned_little(4)), row.beam = static_cast<unsigned>(c.unsigned_little(2));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace insonify::decode
