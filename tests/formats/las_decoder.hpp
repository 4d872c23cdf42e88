// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A decoder of LAS 1.4, point format 6, and LAS 1.2, point format 1, with the extra bytes level_db, deviation, ping and
// beam, from ASPRS LAS 1.4 R15 and LAS 1.2.
#include <array>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

struct LasRow {
  std::array<double, 3> position;
  double time;  ///< UTC, seconds since 1970; for files of 2017 or later, with 18 leap seconds
  unsigned intensity, classification, return_number, returns, source;
  bool withheld;
  double scan_angle_deg;
  float level_db, deviation;
  unsigned ping, beam;
};

inline std::vector<LasRow> read_las(const std::string& bytes) {
  Cursor head(bytes);
  if (head.text(4) != "LASF") throw std::runtime_error("no LAS");
  const auto at = [&](std::size_t offset) { return Cursor(bytes, offset); };
  const bool modern = at(24).unsigned_little(2) == 0x0401;
  const std::size_t stride = modern ? 44 : 42;
  if ((!modern && at(24).unsigned_little(2) != 0x0201) || at(104).unsigned_little(1) != (modern ? 6 : 1) ||
      at(105).unsigned_little(2) != stride)
    throw std::runtime_error("another version or point format");
  const std::uint64_t data = at(96).unsigned_little(4),
                      count = modern ? at(247).unsigned_little(8) : at(107).unsigned_little(4);
  if (bytes.size() != data + stride * count) throw std::runtime_error("points of another number");
  std::array<double, 3> scale, offset;
  Cursor scales = at(131), offsets = at(155);
  for (double& s : scale) s = scales.float64();
  for (double& o : offset) o = offsets.float64();
  std::vector<LasRow> rows;
  for (std::uint64_t i = 0; i < count; ++i) {
    Cursor c = at(data + stride * i);
    LasRow row{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      row.position[axis] = offset[axis] + scale[axis] * static_cast<double>(c.signed_little(4));
    row.intensity = static_cast<unsigned>(c.unsigned_little(2));
    const auto numbers = static_cast<unsigned>(c.unsigned_little(1));
    row.return_number = numbers & (modern ? 15U : 7U), row.returns = modern ? numbers >> 4 : numbers >> 3 & 7U;
    const auto flags = modern ? static_cast<unsigned>(c.unsigned_little(1)) : 0U;
    const auto kind = static_cast<unsigned>(c.unsigned_little(1));
    row.classification = modern ? kind : kind & 31U;
    row.withheld = (modern ? flags & 4U : kind & 128U) != 0;
    if (modern) c.text(1);
    row.scan_angle_deg = static_cast<double>(c.signed_little(modern ? 2 : 1)) * (modern ? 0.006 : 1);
    if (!modern) c.text(1);
    row.source = static_cast<unsigned>(c.unsigned_little(2));
    row.time = c.float64() + 1e9 + 315964800 - 18;
    row.level_db = c.float32(), row.deviation = c.float32();
    row.ping = static_cast<unsigned>(c.unsigned_little(4)), row.beam = static_cast<unsigned>(c.unsigned_little(2));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace insonify::decode
