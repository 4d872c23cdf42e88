// Rasters of heights in the formats of sea floors, written by GDAL.
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "scene_io/load_scene.hpp"
#include "support/test.hpp"

namespace {

constexpr int raster_columns = 30, raster_rows = 20;
constexpr double west = 565000, north = 5995000, raster_cell = 0.5;

/// z = -20 + 0.5 x - 0.25 y, x to the east and y to the north of the south-west corner.
double raster_height(int column, int row) {
  return -20 + 0.5 * raster_cell * (column + 0.5) - 0.25 * raster_cell * (raster_rows - row - 0.5);
}

struct RasterKind {
  const char* driver;
  const char* file;
  int epsg = 32632;
  double no_value = -9999;
  bool hole = true;  ///< cell (column 4, row 3) has no height
  bool nothing = false;
};

/// Writes the plane with one of GDAL's own writers; empty if this GDAL lacks it.
std::string raster_file(const RasterKind& kind) {
  GDALAllRegister();
  const GDALDriverH driver = GDALGetDriverByName(kind.driver), memory = GDALGetDriverByName("MEM");
  if (!driver) return {};
  const GDALDatasetH source = GDALCreate(memory, "", raster_columns, raster_rows, 1, GDT_Float32, nullptr);
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
  for (int row = 0; row < raster_rows; ++row) {
    std::vector<float> values;
    for (int column = 0; column < raster_columns; ++column)
      values.push_back(kind.nothing || (kind.hole && column == 4 && row == 3)
                           ? static_cast<float>(kind.no_value)
                           : static_cast<float>(raster_height(column, row)));
    if (GDALRasterIO(band, GF_Write, 0, row, raster_columns, 1, values.data(), raster_columns, 1, GDT_Float32, 0, 0) !=
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

TEST(RasterFiles, cut_off_or_of_another_kind_are_refused) {
  const std::string bytes = file_bytes(raster_file({"GTiff", "whole.tif"}));
  for (std::size_t size = 1; size < bytes.size() - 200; size += 97)
    EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "cut.tif", bytes.substr(0, size)),
                HasSubstr("cut.tif"))
        << size;
  EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "cloud.tif", "x y z\n1 2 3\n"),
              HasSubstr("is no raster that GDAL reads"));
  std::string other_order = bytes;
  std::swap(other_order[2], other_order[3]);
  EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "swapped.tif", other_order),
              HasSubstr("swapped.tif"));
}
