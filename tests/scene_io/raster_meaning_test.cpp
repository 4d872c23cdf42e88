// SPDX-License-Identifier: BSD-3-Clause
// Tests holes, units, signs and bands of rasters. Files are written by GDAL; right values follow from bed_height.
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "scene_io/describe_file.hpp"
#include "scene_io/load_scene.hpp"
#include "support/test.hpp"

namespace {

using insonify::LoadedScene;
using insonify::LoadOptions;
using insonify::MeaningOverride;
using testing::Contains;
using testing::HasSubstr;

constexpr int wide = 24, deep = 16;
constexpr double west_edge = 600000, north_edge = 6000000, cell_size = 0.5;

/// Returns the height of a cell, in numbers of the file.
double bed_height(int column, int row) { return -20 + 0.1 * column + 0.05 * row; }

bool in_hole(int column, int row) { return column >= 5 && column < 9 && row >= 3 && row < 7; }
constexpr std::size_t cells_with_height = wide * deep - 16;

struct Band {
  std::string name{}, unit{};
  double factor = 1, mark = 0;  ///< the height is `factor` times bed_height; `mark` if not 0 stands in the hole
  bool once = false;            ///< true: the mark stands in a single cell
};

struct RasterFile {
  std::string driver = "GTiff", name;
  std::vector<Band> bands{Band{}};
  std::string system{};  ///< such as "EPSG:32632"
  bool masked = false;
  std::vector<std::string> options{};  ///< options of the driver
};

/// Writes a raster by CreateCopy from one in memory.
std::string write_raster(const RasterFile& file) {
  GDALAllRegister();
  const GDALDatasetH memory =
      GDALCreate(GDALGetDriverByName("MEM"), "", wide, deep, static_cast<int>(file.bands.size()), GDT_Float32, nullptr);
  double transform[6] = {west_edge, cell_size, 0, north_edge, 0, -cell_size};
  GDALSetGeoTransform(memory, transform);
  if (!file.system.empty()) {
    const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(system, file.system.c_str());
    GDALSetSpatialRef(memory, system);
    OSRDestroySpatialReference(system);
  }
  if (file.masked) GDALCreateDatasetMaskBand(memory, GMF_PER_DATASET);
  for (std::size_t b = 0; b < file.bands.size(); ++b) {
    const Band& about = file.bands[b];
    const GDALRasterBandH band = GDALGetRasterBand(memory, static_cast<int>(b) + 1);
    if (!about.name.empty()) GDALSetDescription(band, about.name.c_str());
    if (!about.unit.empty()) GDALSetRasterUnitType(band, about.unit.c_str());
    for (int row = 0; row < deep; ++row)
      for (int column = 0; column < wide; ++column) {
        double z = about.factor * bed_height(column, row), seen = in_hole(column, row) ? 0 : 255;
        if (about.mark != 0 && in_hole(column, row) && (!about.once || column + row == 8)) z = about.mark;
        EXPECT_EQ(GDALRasterIO(band, GF_Write, column, row, 1, 1, &z, 1, 1, GDT_Float64, 0, 0), CE_None);
        if (file.masked) {
          EXPECT_EQ(GDALRasterIO(GDALGetMaskBand(band), GF_Write, column, row, 1, 1, &seen, 1, 1, GDT_Float64, 0, 0),
                    CE_None);
        }
      }
  }
  const std::string path = own_path(file.name.c_str());
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  char** options = nullptr;
  for (const std::string& option : file.options) options = CSLAddString(options, option.c_str());
  const GDALDatasetH copy =
      GDALCreateCopy(GDALGetDriverByName(file.driver.c_str()), path.c_str(), memory, FALSE, options, nullptr, nullptr);
  CSLDestroy(options);
  GDALClose(memory);
  if (!copy) throw std::runtime_error("GDAL cannot write " + path);
  GDALClose(copy);
  return path;
}

using Texts = std::vector<std::pair<std::string, std::string>>;

struct NetcdfFile {
  std::string name, variable = "z";
  Texts of_heights{}, of_axes{};  ///< attributes
  double step = cell_size, factor = 1, mark = 0;
  const char *x = "x", *y = "y";
  std::vector<std::pair<std::string, std::vector<double>>> numbers{};  ///< attributes of the heights
};

void set_attributes(GDALMDArrayH array, const Texts& texts) {
  for (const auto& [name, value] : texts) {
    const GDALExtendedDataTypeH text = GDALExtendedDataTypeCreateString(0);
    const GDALAttributeH attribute = GDALMDArrayCreateAttribute(array, name.c_str(), 0, nullptr, text, nullptr);
    GDALAttributeWriteString(attribute, value.c_str());
    GDALAttributeRelease(attribute);
    GDALExtendedDataTypeRelease(text);
  }
}

/// Writes a variable over two axes. The rows run to the north, as CF and GMT have them.
std::string write_netcdf(const NetcdfFile& file) {
  GDALAllRegister();
  const std::string path = own_path(file.name.c_str());
  const GDALDatasetH made = GDALCreateMultiDimensional(GDALGetDriverByName("netCDF"), path.c_str(), nullptr, nullptr);
  const GDALGroupH root = GDALDatasetGetRootGroup(made);
  const GDALExtendedDataTypeH number = GDALExtendedDataTypeCreate(GDT_Float64);
  GDALDimensionH axes[2] = {GDALGroupCreateDimension(root, file.y, nullptr, nullptr, deep, nullptr),
                            GDALGroupCreateDimension(root, file.x, nullptr, nullptr, wide, nullptr)};
  const auto write = [&](GDALMDArrayH array, const std::vector<double>& values, std::vector<std::size_t> counts) {
    const std::vector<GUInt64> start(counts.size(), 0);
    EXPECT_TRUE(
        GDALMDArrayWrite(array, start.data(), counts.data(), nullptr, nullptr, number, values.data(), nullptr, 0));
    GDALMDArrayRelease(array);
  };
  for (const int axis : {0, 1}) {
    std::vector<double> positions;
    for (int i = 0; i < (axis == 0 ? deep : wide); ++i)
      positions.push_back((axis == 0 ? 6000 : 600) * file.step + file.step * i);
    const GDALMDArrayH array =
        GDALGroupCreateMDArray(root, axis == 0 ? file.y : file.x, 1, &axes[axis], number, nullptr);
    set_attributes(array, file.of_axes);
    write(array, positions, {positions.size()});
  }
  std::vector<double> heights;
  for (int row = 0; row < deep; ++row)
    for (int column = 0; column < wide; ++column)
      heights.push_back(file.mark != 0 && in_hole(column, row) ? file.mark : file.factor * bed_height(column, row));
  const GDALMDArrayH array = GDALGroupCreateMDArray(root, file.variable.c_str(), 2, axes, number, nullptr);
  set_attributes(array, file.of_heights);
  for (const auto& [name, values] : file.numbers) {
    const GUInt64 count = values.size();
    const GDALAttributeH attribute = GDALMDArrayCreateAttribute(array, name.c_str(), 1, &count, number, nullptr);
    GDALAttributeWriteDoubleArray(attribute, values.data(), count);
    GDALAttributeRelease(attribute);
  }
  write(array, heights, {deep, wide});
  for (const GDALDimensionH axis : axes) GDALDimensionRelease(axis);
  GDALExtendedDataTypeRelease(number);
  GDALGroupRelease(root);
  GDALClose(made);
  return path;
}

LoadedScene load_as(const std::string& path, const MeaningOverride& requested = {}) {
  LoadOptions options;
  options.meaning = requested;
  options.scan_noise = 0;
  return insonify::load_scene(path, options);
}

/// Expects so many points with a height, between the given limits.
void expect_heights(const LoadedScene& loaded, std::size_t points, double from, double to) {
  const insonify::Bounds box = insonify::bounds(loaded.scene);
  EXPECT_EQ(loaded.scene.size(), points) << loaded.report.path;
  EXPECT_NEAR(box.min.z(), from, 1e-4 * std::abs(from)) << loaded.report.path;
  EXPECT_NEAR(box.max.z(), to, 1e-4 * std::abs(to)) << loaded.report.path;
}
const double bed_low = bed_height(0, 0), bed_high = bed_height(wide - 1, deep - 1);

TEST(RasterMeaning, marks_of_holes_are_holes_though_undeclared) {
  for (const double mark : {-9999.0, -32768.0, -99999.0, -3.4028234e38, 3.4028234e38, 9.96921e36, 1e20}) {
    const LoadedScene loaded = load_as(write_raster({.name = "marked.tif", .bands = {{.mark = mark}}}));
    expect_heights(loaded, cells_with_height, bed_low, bed_high);
    const bool usual = mark > -1e6 && mark < 0;
    EXPECT_THAT(loaded.report.notes, Contains(HasSubstr(usual ? "16 heights are -" : "16 cells"))) << mark;
  }
  expect_heights(load_as(write_netcdf({.name = "nan.nc", .mark = std::nan("")})), cells_with_height, bed_low, bed_high);
}

TEST(RasterMeaning, marks_of_holes_are_heights_if_asked_for_or_among_others) {
  MeaningOverride none;
  none.no_data.emplace();
  const std::string marked = write_raster({.name = "marked.tif", .bands = {{.mark = -9999}}});
  expect_heights(load_as(marked, none), wide * deep, -9999, bed_high);
  // A bed of -10000 to -8600 m, on which some cells have this height by chance.
  const LoadedScene trench = load_as(write_raster({.name = "trench.tif", .bands = {{.factor = 500, .mark = -9999}}}));
  EXPECT_EQ(trench.scene.size(), std::size_t{wide * deep});
}

TEST(RasterMeaning, marks_that_are_given_are_holes) {
  MeaningOverride requested;
  requested.no_data = {{7.5}};
  expect_heights(load_as(write_raster({.name = "seven.tif", .bands = {{.mark = 7.5}}}), requested), cells_with_height,
                 bed_low, bed_high);
}

TEST(RasterMeaning, grids_of_esri_without_a_mark_have_its_default) {
  const std::string path = write_raster({.driver = "AAIGrid", .name = "esri.asc", .bands = {{.mark = -9999}}});
  ASSERT_THAT(file_bytes(path), testing::Not(HasSubstr("NODATA")));
  expect_heights(load_as(path), cells_with_height, bed_low, bed_high);
}

TEST(RasterMeaning, masks_are_holes) {
  expect_heights(load_as(write_raster({.name = "masked.tif", .masked = true})), cells_with_height, bed_low, bed_high);
}

TEST(RasterMeaning, single_heights_far_from_all_others_stay_with_a_note) {
  const LoadedScene loaded = load_as(write_raster({.name = "odd.tif", .bands = {{.mark = -4321, .once = true}}}));
  EXPECT_EQ(loaded.scene.size(), std::size_t{wide * deep});
  EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("heights reach -4.32e+03 m")));
}

TEST(RasterMeaning, degrees_are_refused_by_units_and_doubted_by_numbers) {
  for (const Texts& axes : {Texts{{"units", "degrees_east"}}, Texts{{"standard_name", "longitude"}}})
    insonify::expect_error(insonify::ErrorKind::content, {"degrees", "gdalwarp -t_srs EPSG:32", "give --unit m"},
                           [&] { load_as(write_netcdf({.name = "degrees.nc", .of_axes = axes, .step = 1e-3})); });
  const LoadedScene loaded = load_as(write_netcdf({.name = "maybe.nc", .step = 1e-3}));
  EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("degrees?")));
}

TEST(RasterMeaning, feet_become_metres) {
  constexpr double foot = 1200.0 / 3937;  // of EPSG:2227, California zone 3
  const LoadedScene loaded = load_as(write_raster({.name = "feet.tif", .system = "EPSG:2227"}));
  expect_heights(loaded, wide * deep, foot * bed_low, foot * bed_high);
  const insonify::Bounds box = insonify::bounds(loaded.scene);
  EXPECT_NEAR(box.min.x(), foot * (west_edge + cell_size / 2), 1e-3);
  EXPECT_NEAR(box.max.y(), foot * (north_edge - cell_size / 2), 1e-3);
  EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("heights")));

  // Heights have the unit of their band.
  expect_heights(load_as(write_raster({.name = "metres.tif", .bands = {{.unit = "m"}}, .system = "EPSG:2227"})),
                 wide * deep, bed_low, bed_high);
  expect_heights(load_as(write_raster({.name = "high.tif", .bands = {{.unit = "ft"}}, .system = "EPSG:32632"})),
                 wide * deep, 0.3048 * bed_low, 0.3048 * bed_high);
  // The caller knows better.
  MeaningOverride requested;
  requested.unit = 1;
  expect_heights(load_as(write_raster({.name = "feet.tif", .system = "EPSG:2227"}), requested), wide * deep, bed_low,
                 bed_high);
}

TEST(RasterMeaning, heights_have_the_unit_of_a_vertical_system) {
  // NAVD88 height in feet, of which a GeoTIFF 1.0 says less.
  for (const char* version : {"1.0", "1.1"}) {
    const LoadedScene loaded = load_as(write_raster(
        {.name = "compound.tif", .system = "EPSG:32632+8228", .options = {std::string("GEOTIFF_VERSION=") + version}}));
    expect_heights(loaded, wide * deep, 0.3048 * bed_low, 0.3048 * bed_high);
    const insonify::Bounds box = insonify::bounds(loaded.scene);
    EXPECT_NEAR(box.min.x(), west_edge + cell_size / 2, 1e-3) << version;
  }
}

TEST(RasterMeaning, kilometres_of_axes_become_metres) {
  const LoadedScene loaded = load_as(
      write_netcdf({.name = "km.nc", .of_heights = {{"units", "m"}}, .of_axes = {{"units", "km"}}, .step = 1e-3}));
  const insonify::Bounds box = insonify::bounds(loaded.scene);
  EXPECT_NEAR(box.max.x() - box.min.x(), wide - 1, 1e-3);
  EXPECT_NEAR(box.max.y() - box.min.y(), deep - 1, 1e-3);
  EXPECT_NEAR(box.min.z(), bed_low, 1e-4);
}

TEST(RasterMeaning, depths_are_turned_if_they_are_called_so) {
  const auto turned = [](const std::string& path, const MeaningOverride& requested = {}) {
    const LoadedScene loaded = load_as(path, requested);
    expect_heights(loaded, wide * deep, bed_low, bed_high);
    if (!requested.z_down) {
      EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("depths"))) << path;
    }
  };
  turned(write_netcdf({.name = "down.nc", .of_heights = {{"positive", "down"}}, .factor = -1}));
  turned(write_netcdf({.name = "depth.nc", .variable = "depth", .factor = -1}));
  turned(
      write_netcdf({.name = "cf.nc", .of_heights = {{"standard_name", "sea_floor_depth_below_geoid"}}, .factor = -1}));
  turned(write_raster({.name = "depth.tif", .bands = {{.name = "Depth", .factor = -1}}}));
  // Heights that are called depths stay below 0.
  expect_heights(load_as(write_raster({.name = "negative.tif", .bands = {{.name = "depth"}}})), wide * deep, bed_low,
                 bed_high);
  // Nothing is said.
  const std::string plain = write_raster({.name = "plain.tif", .bands = {{.factor = -1}}});
  const LoadedScene loaded = load_as(plain);
  expect_heights(loaded, wide * deep, -bed_high, -bed_low);
  EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("--z down")));
  MeaningOverride down;
  down.z_down = true;
  turned(plain, down);
}

TEST(RasterMeaning, depths_that_are_turned_look_up) {
  const LoadedScene loaded =
      load_as(write_netcdf({.name = "down.nc", .of_heights = {{"positive", "down"}}, .factor = -1}));
  for (const Eigen::Vector3f& normal : loaded.scene.normal) EXPECT_GT(normal.z(), 0.9F);
}

TEST(RasterMeaning, bands_are_chosen_by_name) {
  const std::string path =
      write_raster({.name = "cube.tif", .bands = {{.name = "uncertainty", .factor = 0.01}, {.name = "elevation"}}});
  const LoadedScene loaded = load_as(path);
  expect_heights(loaded, wide * deep, bed_low, bed_high);
  EXPECT_THAT(loaded.report.notes, Contains(HasSubstr("band 2 (elevation)")));
  for (const char* name : {"1", "uncertainty"}) {
    MeaningOverride requested;
    requested.band = name;
    expect_heights(load_as(path, requested), wide * deep, 0.01 * bed_low, 0.01 * bed_high);
  }
  MeaningOverride requested;
  requested.band = "backscatter";
  insonify::expect_error(insonify::ErrorKind::content, {"no band 'backscatter'", "2 (elevation)"},
                         [&] { load_as(path, requested); });
}

TEST(RasterMeaning, grids_without_attributes_of_axes_are_read) {
  const LoadedScene loaded = load_as(write_netcdf({.name = "gmt.grd"}));
  expect_heights(loaded, wide * deep, bed_low, bed_high);
  const insonify::Bounds box = insonify::bounds(loaded.scene);
  EXPECT_NEAR(box.min.x(), 600 * cell_size, 1e-3);
  EXPECT_NEAR(box.min.y(), 6000 * cell_size, 1e-3);
  EXPECT_NEAR(box.max.y(), 6000 * cell_size + (deep - 1) * cell_size, 1e-3);
  // The first row lies to the south.
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const Eigen::Vector3d p = loaded.scene.origin + loaded.scene.point[i].cast<double>();
    const int column = static_cast<int>(std::lround(p.x() / cell_size)) - 600,
              row = static_cast<int>(std::lround(p.y() / cell_size)) - 6000;
    EXPECT_NEAR(p.z(), bed_height(column, row), 1e-4);
  }
}

TEST(RasterMeaning, is_told_by_info) {
  const std::string path =
      write_raster({.name = "feet.tif", .bands = {{.name = "depth", .factor = -1}}, .system = "EPSG:2227"});
  std::string all;
  for (const insonify::MeaningItem& item : insonify::describe_file(path).meaning)
    all += item.name + "=" + item.value + " " + item.origin + "\n";
  EXPECT_THAT(all, HasSubstr("unit=0.3048006096 m file"));
  EXPECT_THAT(all, HasSubstr("z=down file"));
  EXPECT_THAT(all, HasSubstr("system=EPSG:2227"));
}

/// Returns the item of the meaning that lists valid numbers.
std::string valid_numbers(const std::string& path) {
  for (const insonify::MeaningItem& item : insonify::describe_file(path).meaning)
    if (item.name == "valid") return item.value + " " + item.origin + " " + item.sentence;
  return "";
}

TEST(RasterMeaning, numbers_outside_the_valid_range_of_a_netcdf_are_holes_and_are_counted) {
  const std::string counted = "16 cells lie outside the valid range";
  for (const auto& [said, numbers] : std::vector<std::pair<std::string, decltype(NetcdfFile::numbers)>>{
           {"-100 to 0 file ", {{"valid_range", {-100, 0}}}},
           {"-inf to 12 file ", {{"valid_max", {12}}}},
           {"-30 to inf file ", {{"valid_min", {-30}}}}}) {
    const double mark = numbers[0].first == "valid_min" ? -50 : 50;
    const std::string path = write_netcdf({.name = "valid.nc", .mark = mark, .numbers = numbers});
    EXPECT_THAT(valid_numbers(path), HasSubstr(said + counted)) << path;
    const LoadedScene loaded = load_as(path);
    expect_heights(loaded, cells_with_height, bed_low, bed_high);
    EXPECT_THAT(loaded.report.notes, Contains(HasSubstr(counted)));
    MeaningOverride all;
    all.no_data.emplace();
    EXPECT_EQ(load_as(path, all).scene.size(), static_cast<std::size_t>(wide * deep));
  }
  // All within: nothing to say. Of packed numbers the range is that of the numbers as stored.
  EXPECT_EQ(valid_numbers(write_netcdf({.name = "all.nc", .numbers = {{"valid_range", {-100, 0}}}})),
            "-100 to 0 file ");
  expect_heights(load_as(write_netcdf({.name = "packed.nc",
                                       .factor = 100,
                                       .mark = 5000,
                                       .numbers = {{"scale_factor", {0.01}}, {"valid_range", {-3000, 0}}}})),
                 cells_with_height, bed_low, bed_high);
}

}  // namespace
