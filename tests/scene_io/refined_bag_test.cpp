// SPDX-License-Identifier: BSD-3-Clause
// A bathymetric attributed grid of variable resolution: a coarse grid, of which each cell holds a finer one.
#include <cpl_error.h>
#include <gdal.h>
#include <hdf5.h>
#include <ogr_srs_api.h>

#include "scene_io/load_scene.hpp"
#include "support/test.hpp"

namespace {

constexpr int coarse_columns = 12, coarse_rows = 8, finer = 4;
constexpr double coarse_cell = 2, fine_cell = coarse_cell / finer;

struct Refinement {
  unsigned index, columns, rows;
  float resolution_x, resolution_y, corner_x, corner_y;
};
struct RefinedNode {
  float depth, uncertainty;
};

/// Returns a plane by the distance from the south-west corner of the grid [m].
double bag_height(double x, double y) { return -15 + 0.1 * x - 0.05 * y; }

void add_number(hid_t object, const char* name, hid_t type, const void* value) {
  const hid_t space = H5Screate(H5S_SCALAR),
              attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, value);
  H5Aclose(attribute), H5Sclose(space);
}

/// Adds the two datasets of refinements (Open Navigation Surface, Format Specification 2.0, variable resolution).
void refine(const std::string& path) {
  std::vector<Refinement> cells;
  std::vector<RefinedNode> nodes;
  for (int row = 0; row < coarse_rows; ++row)  // from the south
    for (int column = 0; column < coarse_columns; ++column) {
      const float size = fine_cell, corner = fine_cell / 2;
      cells.push_back({static_cast<unsigned>(nodes.size()), finer, finer, size, size, corner, corner});
      for (int v = 0; v < finer; ++v)
        for (int u = 0; u < finer; ++u)
          nodes.push_back({static_cast<float>(bag_height(column * coarse_cell + (u + 0.5) * fine_cell,
                                                         row * coarse_cell + (v + 0.5) * fine_cell)),
                           0.1F});
    }
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t cell = H5Tcreate(H5T_COMPOUND, sizeof(Refinement)), node = H5Tcreate(H5T_COMPOUND, sizeof(RefinedNode));
  const char* const whole[] = {"index", "dimensions_x", "dimensions_y"};
  for (std::size_t k = 0; k < 3; ++k) H5Tinsert(cell, whole[k], 4 * k, H5T_NATIVE_UINT32);
  const char* const real[] = {"resolution_x", "resolution_y", "sw_corner_x", "sw_corner_y"};
  for (std::size_t k = 0; k < 4; ++k) H5Tinsert(cell, real[k], 12 + 4 * k, H5T_NATIVE_FLOAT);
  H5Tinsert(node, "depth", 0, H5T_NATIVE_FLOAT), H5Tinsert(node, "depth_uncrt", 4, H5T_NATIVE_FLOAT);
  const auto add = [&](const char* name, hid_t type, hsize_t rows, hsize_t columns, const void* values) {
    const hsize_t size[] = {rows, columns};
    const hid_t space = H5Screate_simple(2, size, nullptr);
    const hid_t data = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
    H5Sclose(space);
    return data;
  };
  const hid_t refinements = add("/BAG_root/varres_metadata", cell, coarse_rows, coarse_columns, cells.data());
  const float size = fine_cell;
  const unsigned side = finer;
  for (const char* which : {"min_", "max_"})
    for (const char* axis : {"x", "y"}) {
      add_number(refinements, (std::string(which) + "resolution_" + axis).c_str(), H5T_NATIVE_FLOAT, &size);
      add_number(refinements, (std::string(which) + "dimensions_" + axis).c_str(), H5T_NATIVE_UINT32, &side);
    }
  H5Dclose(refinements);
  H5Dclose(add("/BAG_root/varres_refinements", node, 1, nodes.size(), nodes.data()));
  H5Tclose(cell), H5Tclose(node), H5Fclose(file);
}

/// Writes a coarse grid by GDAL's own writer. Returns "" if this GDAL has none.
std::string coarse_bag() {
  GDALAllRegister();
  const GDALDriverH driver = GDALGetDriverByName("BAG");
  if (!driver) return {};
  const GDALDatasetH memory =
      GDALCreate(GDALGetDriverByName("MEM"), "", coarse_columns, coarse_rows, 1, GDT_Float32, nullptr);
  double transform[6] = {500000, coarse_cell, 0, 6000000 + coarse_rows * coarse_cell, 0, -coarse_cell};
  GDALSetGeoTransform(memory, transform);
  const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  OSRImportFromEPSG(system, 32632);
  GDALSetSpatialRef(memory, system);
  OSRDestroySpatialReference(system);
  std::vector<float> heights(coarse_columns * coarse_rows, -15.0F);
  EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(memory, 1), GF_Write, 0, 0, coarse_columns, coarse_rows, heights.data(),
                         coarse_columns, coarse_rows, GDT_Float32, 0, 0),
            CE_None);
  const std::string path = own_path("refined.bag");
  CPLPushErrorHandler(CPLQuietErrorHandler);
  GDALClose(GDALCreateCopy(driver, path.c_str(), memory, FALSE, nullptr, nullptr, nullptr));
  CPLPopErrorHandler();
  GDALClose(memory);
  return path;
}

TEST(RefinedBag, is_read_at_its_finest_resolution) {
  const std::string path = coarse_bag();
  if (path.empty()) GTEST_SKIP() << "this GDAL writes no BAG";
  refine(path);
  insonify::LoadOptions options;
  options.scan_noise = 0;
  const insonify::LoadedScene loaded = insonify::load_scene(path, options);
  ASSERT_EQ(loaded.scene.size(), std::size_t{coarse_columns * coarse_rows * finer * finer});
  for (const Eigen::Vector3f& point : loaded.scene.point) {
    const Eigen::Vector3d p = loaded.scene.origin + point.cast<double>();
    EXPECT_NEAR(p.z(), bag_height(p.x() - 500000, p.y() - 6000000), 1e-3);
  }
  EXPECT_THAT(loaded.report.notes, testing::Contains(testing::HasSubstr("refinements")));
}

}  // namespace
