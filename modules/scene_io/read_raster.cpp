// SPDX-License-Identifier: BSD-3-Clause
// Heights of GeoTIFF, BAG, netCDF, GMT and ESRI ASCII grids through GDAL. Without GDAL all are refused, with a remedy.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "core/error.hpp"
#include "core/geodesy.hpp"
#include "core/units.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/read_apart_internal.hpp"

#ifdef INSONIFY_GDAL
#include "scene_io/gdal_library_internal.hpp"
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

constexpr double most_raster_cells = 0x1p28;
constexpr std::size_t bytes_of_cell = 3 * sizeof(double);  // x, y, z
const char* const raster_drivers[] = {"GTiff", "BAG", "netCDF", "GMT", "AAIGrid", "GSBG", "GS7BG", nullptr};

/// Knows GDAL's formats, and keeps it from printing; its last message is part of ours.
struct QuietGdal {
  QuietGdal() {
    GDALAllRegister();
    GDALSetCacheMax64(256 << 20);  // else a twentieth of the machine's memory, which is beyond the limits of a child
    CPLPushErrorHandler(CPLQuietErrorHandler);
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
};

struct CloseGdal {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using GdalFile = std::unique_ptr<void, CloseGdal>;

GdalFile open_raster(const std::string& path) {
  CPLErrorReset();
  GdalFile file(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, raster_drivers, nullptr, nullptr));
  const std::string reason = CPLGetLastErrorMsg();
  if (!file)
    fail(ErrorKind::content, path, ": is no raster that GDAL reads, or it is cut off",
         reason.empty() ? std::string() : " (" + reason + ")", "; it looks like ", what_it_looks_like(path));
  if (GDALGetRasterCount(file.get()) < 1)
    fail(ErrorKind::content, path,
         ": holds several rasters or none; choose one: gdal_translate NETCDF:in.nc:elevation out.tif");
  const double cells = static_cast<double>(GDALGetRasterXSize(file.get())) * GDALGetRasterYSize(file.get());
  if (cells > most_raster_cells)
    fail(ErrorKind::content, path, ": has ", cells,
         " cells, must be at most 2^28; cut it out: gdal_translate -projwin WEST NORTH EAST SOUTH in.tif out.tif");
  expect_from_file(path, file_size_of(path),
                   {cells, "cells", bytes_of_cell,
                    "cut it out, or save it as it is: gdal_translate -co COMPRESS=NONE in.tif out.tif"});
  return file;
}

/// Metres per unit of the raster's plane. Refuses degrees.
double metres_of(const std::string& path, GDALDatasetH file, const double (&transform)[6]) {
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(file);
  if (!reference) return 1;
  if (OSRIsGeographic(reference)) {
    const double x = transform[0] + 0.5 * GDALGetRasterXSize(file) * transform[1];
    const double y = transform[3] + 0.5 * GDALGetRasterYSize(file) * transform[5];
    const int code = epsg_code(utm_zone_of({radians(y), radians(x), 0}));
    fail(ErrorKind::content, path, ": is in degrees, but a scene needs metres in all directions; project it first: ",
         "gdalwarp -t_srs EPSG:", code, " -r bilinear in.tif out.tif");
  }
  return OSRGetLinearUnits(reference, nullptr);
}

/// Metres per unit of the heights.
double metres_of_heights(GDALRasterBandH band) {
  const std::string unit = GDALGetRasterUnitType(band);
  if (unit == "ft" || unit == "feet" || unit == "foot") return 0.3048;
  if (unit == "US survey foot" || unit == "us-ft") return 1200.0 / 3937;
  return 1;
}

/// Calls use(x, y, z) for the cells with a height, row by row [m].
template <typename Use>
void for_each_height(const std::string& path, GDALDatasetH file, Use&& use) {
  double at[6] = {0, 1, 0, 0, 0, 1};
  if (GDALGetGeoTransform(file, at) != CE_None)
    fail(ErrorKind::content, path,
         ": does not say how large its cells are; give it corners: gdal_translate -a_ullr WEST ",
         "NORTH EAST SOUTH in.tif out.tif");
  const double plane = metres_of(path, file, at);
  const GDALRasterBandH band = GDALGetRasterBand(file, 1);
  const double unit = metres_of_heights(band);
  int has_offset = 0, has_scale = 0, has_none = 0;
  const double offset = GDALGetRasterOffset(band, &has_offset), scale = GDALGetRasterScale(band, &has_scale);
  const double none = GDALGetRasterNoDataValue(band, &has_none);
  const int columns = GDALGetRasterXSize(file), rows = GDALGetRasterYSize(file);
  std::vector<double> row(static_cast<std::size_t>(columns));
  for (int r = 0; r < rows; ++r) {
    if (GDALRasterIO(band, GF_Read, 0, r, columns, 1, row.data(), columns, 1, GDT_Float64, 0, 0) != CE_None)
      fail(ErrorKind::content, path, ": row ", r, " of ", rows, " cannot be read (", CPLGetLastErrorMsg(),
           "); copy or export the file again");
    for (int c = 0; c < columns; ++c) {
      double z = row[static_cast<std::size_t>(c)];
      if (!std::isfinite(z) || (has_none && (z == none || static_cast<float>(z) == static_cast<float>(none)))) continue;
      z = (has_scale ? scale : 1) * z + (has_offset ? offset : 0);
      use(plane * (at[0] + (c + 0.5) * at[1] + (r + 0.5) * at[2]),
          plane * (at[3] + (c + 0.5) * at[4] + (r + 0.5) * at[5]), unit * z);
    }
  }
}

SentRows read_heights(ArraySender& to, RawCloud& raw) {
  const QuietGdal quiet;
  const GdalFile file = open_raster(raw.path);
  raw.format = std::string("raster of heights, ") + GDALGetDriverShortName(GDALGetDatasetDriver(file.get()));
  raw.fields = {{"height", GDALGetDataTypeName(GDALGetRasterDataType(GDALGetRasterBand(file.get(), 1)))}};
  const std::size_t cells = static_cast<std::size_t>(GDALGetRasterXSize(file.get())) *
                            static_cast<std::size_t>(GDALGetRasterYSize(file.get()));
  auto* const numbers = reinterpret_cast<double*>(to.take_array<char>(bytes_of_cell * cells));
  double* next = numbers;
  for_each_height(raw.path, file.get(), [&](double x, double y, double z) { *next++ = x, *next++ = y, *next++ = z; });
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
  read_rows_apart(raw, file_size_of(path), options, read_heights);
  raw.heights = true;
  return raw;
}

#endif

namespace {

/// Refuses an ESRI ASCII grid with fewer numbers than its head announces, where GDAL would see zeros, or that ends
/// within a line.
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
  std::string head = read_beginning(path, 5);
  for (char& c : head) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (head != "ncols") return read_text_cloud(path, options);
  check_ascii_grid(path);
  return read_raster(path, options);
}

}  // namespace insonify
