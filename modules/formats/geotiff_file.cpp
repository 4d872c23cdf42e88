// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geotiff_file.hpp"

#include <cmath>
#include <fstream>
#include <utility>

#include "core/require.hpp"
#include "files/pending_file.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr const char* geotiff_call = "write_geotiff";
constexpr const char* local_grid_name = "local grid of metres";
enum TiffType : std::uint16_t { tiff_ascii = 2, tiff_short = 3, tiff_long = 4, tiff_double = 12 };

/// A directory entry with its values as bytes. More than four bytes stand behind the directory.
struct TiffEntry {
  std::uint16_t tag;
  TiffType type;
  std::uint32_t count;
  std::string values;
};

template <typename Number>
TiffEntry tiff_entry(std::uint16_t tag, TiffType type, const std::vector<Number>& numbers) {
  TiffEntry entry{tag, type, static_cast<std::uint32_t>(numbers.size()), {}};
  for (const Number number : numbers) put_little(entry.values, number);
  return entry;
}
TiffEntry tiff_text(std::uint16_t tag, std::string text) {
  text.push_back('\0');
  return {tag, tiff_ascii, static_cast<std::uint32_t>(text.size()), text};
}

/// Returns names and units of the bands in GDAL's form.
std::string band_metadata(const std::vector<GeoBand>& bands) {
  std::string text = "<GDALMetadata>\n";
  const auto add = [&](const char* name, const char* role, std::size_t band, const std::string& value) {
    if (!value.empty())
      text += std::string("  <Item name=\"") + name + "\" sample=\"" + std::to_string(band) + "\" role=\"" + role +
              "\">" + value + "</Item>\n";
  };
  for (std::size_t i = 0; i < bands.size(); ++i) {
    add("DESCRIPTION", "description", i, bands[i].name);
    add("UNITTYPE", "unittype", i, bands[i].unit);
  }
  return text + "</GDALMetadata>\n";
}

/// Returns the keys of a projected system, or of a plane of its own in metres (a user-defined model with a name).
std::vector<TiffEntry> geo_keys_of(int epsg) {
  using Shorts = std::vector<std::uint16_t>;
  if (epsg > 0)
    return {tiff_entry(34735, tiff_short,
                       Shorts{1, 1, 1, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, static_cast<std::uint16_t>(epsg)})};
  const std::string name = std::string(local_grid_name) + "|";
  return {tiff_entry(34735, tiff_short, Shorts{1, 1,    1,     4,     1024,
                                               0, 1,    32767, 1025,  0,
                                               1, 1,    1026,  34737, static_cast<std::uint16_t>(name.size()),
                                               0, 3076, 0,     1,     9001}),
          tiff_text(34737, name)};
}

/// Returns the entries in the order of their tags; the first band begins at `data`.
std::vector<TiffEntry> tiff_entries(const std::vector<GeoBand>& bands, const GeoGrid& grid, std::uint32_t data) {
  const auto rows = static_cast<std::uint32_t>(bands[0].values.rows());
  const auto columns = static_cast<std::uint32_t>(bands[0].values.cols());
  const auto count = bands.size();
  const std::uint32_t band_bytes = 4 * rows * columns;
  std::vector<std::uint32_t> offsets, sizes(count, band_bytes);
  for (std::size_t i = 0; i < count; ++i) offsets.push_back(data + static_cast<std::uint32_t>(i) * band_bytes);
  using Shorts = std::vector<std::uint16_t>;
  using Longs = std::vector<std::uint32_t>;
  std::vector<TiffEntry> entries = {tiff_entry(256, tiff_long, Longs{columns}), tiff_entry(257, tiff_long, Longs{rows}),
                                    tiff_entry(258, tiff_short, Shorts(count, 32)),
                                    tiff_entry(259, tiff_short, Shorts{1}),   // uncompressed
                                    tiff_entry(262, tiff_short, Shorts{1})};  // black is zero
  if (!grid.remark.empty()) entries.push_back(tiff_text(270, grid.remark));
  entries.push_back(tiff_entry(273, tiff_long, offsets));
  entries.push_back(tiff_entry(277, tiff_short, Shorts{static_cast<std::uint16_t>(count)}));
  entries.push_back(tiff_entry(278, tiff_long, Longs{rows}));
  entries.push_back(tiff_entry(279, tiff_long, sizes));
  entries.push_back(tiff_entry(284, tiff_short, Shorts{2}));  // one band after the other
  if (count > 1) entries.push_back(tiff_entry(338, tiff_short, Shorts(count - 1, 0)));
  entries.push_back(tiff_entry(339, tiff_short, Shorts(count, 3)));  // floats
  const double cell = grid.cell / grid.unit, north = grid.south + grid.cell * rows;
  entries.push_back(tiff_entry(33550, tiff_double, std::vector<double>{cell, cell, 0}));
  entries.push_back(
      tiff_entry(33922, tiff_double, std::vector<double>{0, 0, 0, grid.west / grid.unit, north / grid.unit, 0}));
  for (TiffEntry& keys : geo_keys_of(grid.epsg)) entries.push_back(std::move(keys));
  entries.push_back(tiff_text(42112, band_metadata(bands)));
  entries.push_back(tiff_text(42113, "nan"));
  return entries;
}

std::string tiff_directory(const std::vector<TiffEntry>& entries) {
  const auto behind = static_cast<std::uint32_t>(8 + 2 + 12 * entries.size() + 4);
  std::string bytes("II*\0", 4), values;
  put_little(bytes, std::uint32_t{8});
  put_little(bytes, static_cast<std::uint16_t>(entries.size()));
  for (const TiffEntry& entry : entries) {
    put_little(bytes, entry.tag);
    put_little(bytes, static_cast<std::uint16_t>(entry.type));
    put_little(bytes, entry.count);
    if (entry.values.size() <= 4) {
      put_field(bytes, entry.values, 4);
      continue;
    }
    put_little(bytes, static_cast<std::uint32_t>(behind + values.size()));
    values += entry.values;
    values.append(values.size() % 2, '\0');
  }
  put_little(bytes, std::uint32_t{0});
  bytes += values;
  return bytes.append((8 - bytes.size() % 8) % 8, '\0');
}

}  // namespace

void write_geotiff(const std::string& path, const std::vector<GeoBand>& bands, const GeoGrid& grid) {
  require(!bands.empty(), geotiff_call, "bands", 0, "", "at least one");
  const auto rows = bands[0].values.rows(), columns = bands[0].values.cols();
  for (const GeoBand& band : bands)
    require(band.values.size() > 0 && band.values.rows() == rows && band.values.cols() == columns, geotiff_call, "rows",
            static_cast<double>(band.values.rows()), "", "at least 1, and the same in all bands");
  require(grid.cell > 0 && std::isfinite(grid.cell), geotiff_call, "cell", grid.cell, "m", "> 0 and finite");
  require(grid.unit > 0 && std::isfinite(grid.unit), geotiff_call, "unit", grid.unit, "m", "> 0 and finite");
  require(grid.epsg == 0 || (grid.epsg >= 1024 && grid.epsg <= 32767), geotiff_call, "epsg", grid.epsg, "",
          "0, or within 1024 and 32767");
  const double size =
      4.0 * static_cast<double>(bands.size()) * static_cast<double>(rows) * static_cast<double>(columns);
  require(size < 4.29e9, geotiff_call, "size", size / 0x1p30, "GiB", "below 4; make the cells larger");

  const std::string at_zero = tiff_directory(tiff_entries(bands, grid, 0));
  PendingFile pending(path);
  std::ofstream out(pending.temporary(), std::ios::binary);
  out << tiff_directory(tiff_entries(bands, grid, static_cast<std::uint32_t>(at_zero.size())));
  for (const GeoBand& band : bands)
    for (Eigen::Index row = rows; row-- > 0;)  // rows from north to south
      out.write(reinterpret_cast<const char*>(band.values.row(row).data()), static_cast<std::streamsize>(4 * columns));
  pending.commit(out);
}

}  // namespace insonify
