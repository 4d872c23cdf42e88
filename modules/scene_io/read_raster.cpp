// SPDX-License-Identifier: BSD-3-Clause
// Heights of GeoTIFF, BAG, netCDF, GMT and ESRI ASCII grids through GDAL. Without GDAL all are refused, with a remedy.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/input_file.hpp"
#include "scene_io/read_apart_internal.hpp"

#ifdef INSONIFY_GDAL
#include "scene_io/raster_band_internal.hpp"
#endif

namespace insonify {

#ifndef INSONIFY_GDAL

RawCloud read_raster(const std::string& path, const ReadOptions&) {
  fail(ErrorKind::content, path,
       ": is a raster, which this build cannot read: GDAL was not found; install libgdal-dev and build again, or "
       "convert "
       "it: gdal2xyz.py -csv in.tif out.xyz");
}

#else

namespace {

/// Calls use(x, y, z) for the cells with a height, row by row [units of the file]. Returns the number of cells outside
/// the valid range.
template <typename Use>
std::size_t for_each_height(const RawCloud& raw, const HeightBand& heights, Use&& use) {
  const GDALRasterBandH band = heights.band;
  const auto& at = heights.transform;
  int has_offset = 0, has_scale = 0, has_none = 0;
  const double offset = GDALGetRasterOffset(band, &has_offset), scale = GDALGetRasterScale(band, &has_scale);
  const double none = GDALGetRasterNoDataValue(band, &has_none);
  const bool masked = (GDALGetMaskFlags(band) & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  const int columns = GDALGetRasterXSize(heights.file.get()), rows = GDALGetRasterYSize(heights.file.get());
  std::vector<double> row(static_cast<std::size_t>(columns)), mask(masked ? row.size() : 0);
  const auto read = [&](GDALRasterBandH from, int r, std::vector<double>& numbers) {
    if (GDALRasterIO(from, GF_Read, 0, r, columns, 1, numbers.data(), columns, 1, GDT_Float64, 0, 0) != CE_None)
      fail(ErrorKind::content, raw.path, ": row ", r, " of ", rows, " cannot be read (", CPLGetLastErrorMsg(),
           "); copy or export the file again");
  };
  const std::vector<double>& valid = raw.meaning.valid.value;
  const auto less = [](double a, double b) { return a < b && static_cast<float>(a) < static_cast<float>(b); };
  std::size_t outside = 0;
  for (int r = 0; r < rows; ++r) {
    read(band, r, row);
    if (masked) read(GDALGetMaskBand(band), r, mask);
    for (int c = 0; c < columns; ++c) {
      double z = row[static_cast<std::size_t>(c)];
      if (masked && mask[static_cast<std::size_t>(c)] == 0) continue;
      if (!std::isfinite(z) || (has_none && (z == none || static_cast<float>(z) == static_cast<float>(none)))) continue;
      if (!valid.empty() && (less(z, valid[0]) || less(valid[1], z))) {
        ++outside;
        continue;
      }
      z = (has_scale ? scale : 1) * z + (has_offset ? offset : 0);
      if (std::abs(z) <= farthest_coordinate && !raw.meaning.is_hole(z))
        use(at[0] + (c + 0.5) * at[1] + (r + 0.5) * at[2], at[3] + (c + 0.5) * at[4] + (r + 0.5) * at[5], z);
    }
  }
  return outside;
}

SentRows read_heights(ArraySender& to, RawCloud& raw, const MeaningOverride& requested) {
  const GdalReading reading;
  const HeightBand heights = open_heights(raw, requested);
  const std::size_t cells = static_cast<std::size_t>(GDALGetRasterXSize(heights.file.get())) *
                            static_cast<std::size_t>(GDALGetRasterYSize(heights.file.get()));
  auto* const numbers = reinterpret_cast<double*>(to.take_array<char>(3 * sizeof(double) * cells));
  double* next = numbers;
  if (requested.no_data) raw.meaning.valid = {};
  const std::size_t outside =
      for_each_height(raw, heights, [&](double x, double y, double z) { *next++ = x, *next++ = y, *next++ = z; });
  if (outside > 0)
    raw.meaning.valid.sentence =
        std::to_string(outside) + " cells lie outside the valid range of the file: holes; --nodata none keeps them";
  if (next == numbers)
    fail(ErrorKind::content, raw.path, ": none of its ", cells, " cells has a height: all are no data");
  raw.width = static_cast<std::size_t>(next - numbers) / 3;
  if (const std::size_t holes = cells - raw.width; holes > 0)
    raw.notes.push_back(std::to_string(holes) + " cells of the raster have no height and are holes");
  return rows_of_doubles({"x", "y", "z"}, raw.width);
}

}  // namespace

RawCloud read_raster(const std::string& path, const ReadOptions& options) {
  require_readable(path);
  check_netcdf(path);
  RawCloud raw;
  raw.path = path;
  const auto read = [](ArraySender& to, RawCloud& there, const std::string& band, bool says_no_data) {
    MeaningOverride requested;
    requested.band = band;
    if (says_no_data) requested.no_data.emplace();
    return read_heights(to, there, requested);
  };
  read_rows_apart(raw, file_size_of(path), options, read, options.meaning.band, options.meaning.no_data.has_value());
  raw.heights = true;
  return raw;
}

#endif

namespace {

/// Throws Error(content) for an ESRI ASCII grid that has fewer numbers than its head announces, where GDAL would see
/// zeros, or that ends within a line.
void check_ascii_grid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t columns = 0, rows = 0, numbers = 0;
  for (std::string word; file >> word;) {
    if (std::isalpha(static_cast<unsigned char>(word.front())) == 0 || word == "nan" || word == "NaN") {
      ++numbers;
      continue;
    }
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::string value;
    file >> value;
    if (word == "ncols") columns = std::strtoull(value.c_str(), nullptr, 10);
    if (word == "nrows") rows = std::strtoull(value.c_str(), nullptr, 10);
  }
  if (rows > 0 && numbers / rows < columns)
    fail(ErrorKind::content, path, ": cut off: it announces ", columns, " x ", rows, " numbers and has ", numbers,
         "; copy or export the file again");
  file.clear();
  file.seekg(-1, std::ios::end);
  if (!std::isspace(file.get()))
    fail(ErrorKind::content, path, ": ends within a line, so that its last number may be cut off; copy or export the ",
         "file again, or end its last line");
}

}  // namespace

RawCloud read_asc(const std::string& path, const ReadOptions& options) {
  require_readable(path);
  std::istringstream head(lower_case(read_beginning(path, 64)));
  std::string word;
  head >> word;
  static const std::set<std::string> heads = {"ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
                                              "yllcenter", "cellsize", "dx",        "dy"};
  if (!heads.contains(word)) return read_text_cloud(path, options);
  check_ascii_grid(path);
  return read_raster(path, options);
}

}  // namespace insonify
