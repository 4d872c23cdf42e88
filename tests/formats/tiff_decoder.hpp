// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A decoder of uncompressed GeoTIFF, from TIFF 6.0 and OGC 19-008.
#include <map>
#include <vector>

#include "formats/file_cursor.hpp"

namespace insonify::decode {

/// Returns the numbers of every tag.
inline std::map<int, std::vector<double>> tiff_tags(const std::string& bytes) {
  Cursor head(bytes);
  if (head.text(4) != std::string("II*\0", 4)) throw std::runtime_error("no TIFF");
  Cursor c(bytes, head.unsigned_little(4));
  std::map<int, std::vector<double>> tags;
  int last = 0;
  for (std::uint64_t n = c.unsigned_little(2); n > 0; --n) {
    const int tag = static_cast<int>(c.unsigned_little(2)), type = static_cast<int>(c.unsigned_little(2));
    if (tag <= last) throw std::runtime_error("tags out of order");
    last = tag;
    const std::uint64_t count = c.unsigned_little(4);
    const int size = type == 2 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 8;
    Cursor at(bytes, c.at());
    if (count * static_cast<std::uint64_t>(size) > 4) at = Cursor(bytes, Cursor(bytes, c.at()).unsigned_little(4));
    c.text(4);
    for (std::uint64_t i = 0; i < count; ++i)
      tags[tag].push_back(type == 12 ? at.float64() : static_cast<double>(at.unsigned_little(size)));
  }
  return tags;
}

/// Bands of 32-bit floats, row by row from the north, and the position of their north-west corner.
struct GeotiffContent {
  std::size_t columns, rows;
  double west, north, cell;
  int epsg;  ///< 0: a plane of its own
  std::vector<std::vector<float>> bands;
};

inline GeotiffContent read_geotiff(const std::string& bytes) {
  auto tags = tiff_tags(bytes);
  GeotiffContent content{static_cast<std::size_t>(tags.at(256).at(0)),
                         static_cast<std::size_t>(tags.at(257).at(0)),
                         tags.at(33922).at(3),
                         tags.at(33922).at(4),
                         tags.at(33550).at(0),
                         tags.at(34735).at(7) == 1 ? static_cast<int>(tags.at(34735).at(15)) : 0,
                         {}};
  for (std::size_t band = 0; band < tags.at(273).size(); ++band) {
    if (tags.at(279).at(band) != static_cast<double>(4 * content.columns * content.rows))
      throw std::runtime_error("band of another size");
    Cursor at(bytes, static_cast<std::size_t>(tags.at(273)[band]));
    content.bands.emplace_back();
    for (std::size_t i = 0; i < content.columns * content.rows; ++i) content.bands.back().push_back(at.float32());
  }
  return content;
}

}  // namespace insonify::decode
