// SPDX-License-Identifier: BSD-3-Clause
// Rasters of heights in the formats of sea floors, written by GDAL.
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/stop_watch.hpp"
#include "scene_io/bounds_of_file.hpp"
#include "scene_io/load_scene.hpp"
#include "support/test.hpp"

namespace {

constexpr int raster_columns = 30, raster_rows = 20;
constexpr double west = 565000, north = 5995000, raster_cell = 0.5;

/// Returns z = -20 + 0.5 x - 0.25 y, x to the east and y to the north of the south-west corner.
double raster_height(int column, int row) {
  return -20 + 0.5 * raster_cell * (column + 0.5) - 0.25 * raster_cell * (raster_rows - row - 0.5);
}

struct RasterKind {
  const char* driver;
  const char* file;
  int epsg = 32632;
  double no_value = -9999;
  bool hole = true;  ///< true: cell (column 4, row 3) has no height
  bool nothing = false;
  int columns = raster_columns, rows = raster_rows;
};

/// Writes the plane with one of GDAL's own writers. Returns "" if this GDAL lacks it.
std::string raster_file(const RasterKind& kind) {
  GDALAllRegister();
  const GDALDriverH driver = GDALGetDriverByName(kind.driver), memory = GDALGetDriverByName("MEM");
  if (!driver) return {};
  const GDALDatasetH source = GDALCreate(memory, "", kind.columns, kind.rows, 1, GDT_Float32, nullptr);
  const bool degrees_of_arc = kind.epsg == 4326;
  const double step = degrees_of_arc ? 1e-5 : raster_cell;
  double transform[6] = {degrees_of_arc ? 9.5 : west, step, 0, degrees_of_arc ? 54.1 : north, 0, -step};
  GDALSetGeoTransform(source, transform);
  const OGRSpatialReferenceH reference = OSRNewSpatialReference(nullptr);
  OSRImportFromEPSG(reference, kind.epsg);
  GDALSetSpatialRef(source, reference);
  OSRDestroySpatialReference(reference);
  const GDALRasterBandH band = GDALGetRasterBand(source, 1);
  GDALSetRasterNoDataValue(band, kind.no_value);
  for (int row = 0; row < kind.rows; ++row) {
    std::vector<float> values;
    for (int column = 0; column < kind.columns; ++column)
      values.push_back(kind.nothing || (kind.hole && column == 4 && row == 3)
                           ? static_cast<float>(kind.no_value)
                           : static_cast<float>(raster_height(column, row)));
    if (GDALRasterIO(band, GF_Write, 0, row, kind.columns, 1, values.data(), kind.columns, 1, GDT_Float32, 0, 0) !=
        CE_None)
      throw std::runtime_error("GDAL cannot write");
  }
  const std::string path = own_path(kind.file);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const GDALDatasetH copy = GDALCreateCopy(driver, path.c_str(), source, FALSE, nullptr, nullptr, nullptr);
  CPLPopErrorHandler();
  GDALClose(source);
  if (copy) GDALClose(copy);
  return copy ? path : std::string();
}

void expect_plane(const std::string& path, double tolerance) {
  const LoadedScene loaded = load_scene(path);
  const SceneCloud& scene = loaded.scene;
  ASSERT_EQ(scene.size(), static_cast<std::size_t>(raster_columns * raster_rows - 1)) << path;
  ASSERT_TRUE(loaded.mesh.has_value()) << path;
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.5, 0.25, 1).normalized();
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3d p = scene.origin + scene.point[i].cast<double>();
    const double x = p.x() - west, y = p.y() - (north - raster_rows * raster_cell);
    EXPECT_NEAR(p.z(), -20 + 0.5 * x - 0.25 * y, tolerance) << path;
    EXPECT_GT(std::hypot(x - 4.5 * raster_cell, y - (raster_rows - 3.5) * raster_cell), 0.4) << "stands in the hole";
    EXPECT_NEAR(scene.normal[i].cast<double>().dot(normal), 1, 1e-3) << path;
  }
  // Triangles between the middles of cells, but for the four about the hole, of which triangles at its corners remain.
  double area = 0;
  for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t) area += area_of(corners_of(*loaded.mesh, t));
  const double whole = (raster_columns - 1) * (raster_rows - 1) * raster_cell * raster_cell / normal.z();
  EXPECT_NEAR(area, whole - 2 * raster_cell * raster_cell / normal.z(), 1e-3 * whole) << path;
}

}  // namespace

TEST(RasterFiles, of_every_kind_are_the_same_bed) {
  int read = 0;
  for (const RasterKind& kind :
       {RasterKind{"GTiff", "bed.tif"}, RasterKind{"AAIGrid", "bed.asc"}, RasterKind{"netCDF", "bed.nc"},
        RasterKind{"GMT", "bed.grd"}, RasterKind{"BAG", "bed.bag", 32632, 1e6}}) {
    const std::string path = raster_file(kind);
    if (path.empty()) continue;  // this GDAL cannot write it
    ++read;
    expect_plane(path, 2e-3);
  }
  EXPECT_GE(read, 3);
}

TEST(RasterFiles, have_the_bounds_that_other_readers_find) {
  int read = 0;
  for (const RasterKind& kind : {RasterKind{"GTiff", "a.tif"}, RasterKind{"AAIGrid", "a.asc"},
                                 RasterKind{"netCDF", "a.nc"}, RasterKind{"BAG", "a.bag", 32632, 1e6}})
    if (const std::string path = raster_file(kind); !path.empty()) read += has_bounds_of_other_reader(path);
  if (read == 0) GTEST_SKIP() << "/usr/bin/python3 is not there";
  EXPECT_GE(read, 3);
}

TEST(RasterFiles, say_which_cells_are_holes) {
  const LoadedScene loaded = load_scene(raster_file({"GTiff", "hole.tif"}));
  EXPECT_THAT(loaded.report.notes, testing::Contains(HasSubstr("1 cells of the raster have no height")));
}

TEST(RasterFiles, in_degrees_or_without_heights_are_refused) {
  EXPECT_THAT(error_of(
                  [] {
                    load_scene(raster_file({"GTiff", "degrees.tif", 4326}));
                  },
                  ErrorKind::content),
              testing::AllOf(HasSubstr("is in degrees"), HasSubstr("gdalwarp -t_srs EPSG:32632")));
  EXPECT_THAT(error_of(
                  [] {
                    load_scene(raster_file({"GTiff", "none.tif", 32632, -9999, true, true}));
                  },
                  ErrorKind::content),
              HasSubstr("none of its 600 cells has a height"));
}

namespace {

/// Returns all points of the scene.
std::vector<Eigen::Vector3f> points_of_raster(const std::string& path) { return load_scene(path).scene.point; }

/// Expects every beginning of a file, in steps, to be refused in one line that names it, or to lack only padding.
/// Returns false if this GDAL cannot write such a file.
bool expect_no_part_passes(const RasterKind& kind, std::size_t step) {
  const std::string path = raster_file(kind);
  if (path.empty()) return false;
  const std::string bytes = file_bytes(path), name = std::string("cut_") + kind.file;
  const std::vector<Eigen::Vector3f> whole = points_of_raster(path);
  std::size_t passed = 0;
  for (std::size_t size = 0; size < bytes.size(); size += std::min(step, bytes.size() - size)) {
    const std::string cut = own_file(name, bytes.substr(0, size));
    try {
      EXPECT_EQ(points_of_raster(cut), whole) << name << " of " << size << " bytes";
      ++passed;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(name)) << size;
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n"))) << size;
    }
  }
  EXPECT_LT(passed, 2 + bytes.size() / 20) << name;
  return true;
}

}  // namespace

TEST(RasterFiles, cut_off_at_any_byte_are_refused) {
  for (const auto& [driver, file] : {std::pair{"GTiff", "bed.tif"}, std::pair{"AAIGrid", "bed.asc"},
                                     std::pair{"netCDF", "bed.nc"}, std::pair{"GMT", "bed.grd"}})
    expect_no_part_passes({driver, file, 32632, -9999, true, false, 7, 5}, 1);
}

TEST(RasterFiles, of_hdf5_cut_off_are_refused) {
  if (!expect_no_part_passes({"BAG", "bed.bag", 32632, 1e6}, 97)) GTEST_SKIP() << "this GDAL cannot write BAG";
}

TEST(RasterFiles, of_either_byte_order_are_read_and_of_a_wrong_one_or_another_kind_refused) {
  const std::string bytes = file_bytes(raster_file({"GTiff", "whole.tif"}));
  const char* big_options[] = {"ENDIANNESS=BIG", nullptr};
  const GDALDatasetH source = GDALOpen(own_path("whole.tif").c_str(), GA_ReadOnly);
  GDALClose(GDALCreateCopy(GDALGetDriverByName("GTiff"), own_path("big.tif").c_str(), source, FALSE,
                           const_cast<char**>(big_options), nullptr, nullptr));
  GDALClose(source);
  EXPECT_EQ(file_bytes(own_path("big.tif")).substr(0, 4), std::string("MM\0*", 4));
  expect_plane(own_path("big.tif"), 2e-3);
  for (const std::string& order : {std::string("MM\0*", 4), std::string("MM*\0", 4), std::string("II\0*", 4)})
    EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "swapped.tif", order + bytes.substr(4)),
                HasSubstr("swapped.tif"));
  EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "cloud.tif", "x y z\n1 2 3\n"),
              HasSubstr("is no raster that GDAL reads"));
}

TEST(RasterFiles, damaged_ones_are_not_to_be_renamed) {
  EXPECT_THAT(
      error_of_file([](const std::string& p) { load_scene(p); }, "damaged.tif", std::string("II*\0garbage", 11)),
      testing::AllOf(HasSubstr("is no raster that GDAL reads"), HasSubstr("copy or export it again"),
                     testing::Not(HasSubstr("rename it"))));
}

// A GeoTIFF that insonify exported, by GDAL: place, projection, no data, names and heights.
// A few bytes that unpack to gigabytes: refused before they are unpacked.
TEST(RasterFiles, that_unpack_to_too_much_are_refused_at_once) {
  GDALAllRegister();
  for (const char* packing : {"COMPRESS=LZW", "COMPRESS=ZSTD", "COMPRESS=DEFLATE"}) {
    const char* const options[] = {packing, "TILED=YES", "BLOCKXSIZE=2048", "BLOCKYSIZE=2048", nullptr};
    const std::string path = own_path("bomb.tif");
    const GDALDatasetH file =
        GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), 10000, 10000, 1, GDT_Byte, const_cast<char**>(options));
    if (!file) continue;  // this GDAL lacks it
    double transform[6] = {west, raster_cell, 0, north, 0, -raster_cell};
    GDALSetGeoTransform(file, transform);
    GDALClose(file);
    ASSERT_LT(std::filesystem::file_size(path), 1000000U) << packing;
    StopWatch watch;
    expect_error(ErrorKind::content,
                 {"bomb.tif: its header announces 100000000 cells, 2288.8", "MiB at most", "COMPRESS=NONE"},
                 [&] { load_scene(path); });
    EXPECT_LT(watch.lap(), 5) << packing;
  }
}

TEST(RasterFiles, of_insonify_are_read_by_gdal) {
  GDALAllRegister();
  const GDALDatasetH file = GDALOpen(INSONIFY_GOLDEN_RASTER, GA_ReadOnly);
  ASSERT_NE(file, nullptr);
  double at[6];
  ASSERT_EQ(GDALGetGeoTransform(file, at), CE_None);
  EXPECT_EQ(std::vector<double>(at, at + 6), (std::vector<double>{565400, 0.5, 0, 5995101, 0, -0.5}));
  EXPECT_STREQ(OSRGetName(GDALGetSpatialRef(file)), "WGS 84 / UTM zone 32N");
  ASSERT_EQ(GDALGetRasterCount(file), 2);
  const GDALRasterBandH band = GDALGetRasterBand(file, 1);
  EXPECT_STREQ(GDALGetDescription(band), "height");
  EXPECT_STREQ(GDALGetRasterUnitType(band), "m");
  int has_none = 0;
  EXPECT_TRUE(std::isnan(GDALGetRasterNoDataValue(band, &has_none)));
  EXPECT_TRUE(has_none);
  std::vector<float> heights(6);
  ASSERT_EQ(GDALRasterIO(band, GF_Read, 0, 0, 3, 2, heights.data(), 3, 2, GDT_Float32, 0, 0), CE_None);
  EXPECT_EQ(std::vector<float>(heights.begin(), heights.end() - 1),
            (std::vector<float>{-18, -17.5F, 2.25F, -20, -21}));  // from the north
  GDALClose(file);
}
