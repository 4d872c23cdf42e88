// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/input_file.hpp"
#include "files/read_apart.hpp"
#include "scene_io/coordinate_system_internal.hpp"
#include "scene_io/raster_band_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr double most_raster_cells = 0x1p28;
const char* const raster_drivers[] = {"GTiff", "BAG", "netCDF", "GMT", "AAIGrid", "GSBG", "GS7BG", nullptr};
const char* const netcdf_drivers[] = {"netCDF", nullptr};

template <auto& release>
struct Release {
  template <typename Handle>
  void operator()(Handle* handle) const {
    release(handle);
  }
};
using Group = std::unique_ptr<std::remove_pointer_t<GDALGroupH>, Release<GDALGroupRelease>>;
using Variable = std::unique_ptr<std::remove_pointer_t<GDALMDArrayH>, Release<GDALMDArrayRelease>>;
using Attribute = std::unique_ptr<std::remove_pointer_t<GDALAttributeH>, Release<GDALAttributeRelease>>;

/// Returns an attribute of a netCDF variable in lower case; empty if it has none of this name.
std::string attribute_of(const Variable& variable, const char* name) {
  const Attribute attribute(GDALMDArrayGetAttribute(variable.get(), name));
  const char* const text = attribute ? GDALAttributeReadAsString(attribute.get()) : nullptr;
  return lower_case(text ? text : "");
}

/// Returns the numbers of an attribute; empty if there is no such attribute.
std::vector<double> numbers_of(const Variable& variable, const char* name) {
  const Attribute attribute(GDALMDArrayGetAttribute(variable.get(), name));
  std::size_t count = 0;
  double* const numbers = attribute ? GDALAttributeReadAsDoubleArray(attribute.get(), &count) : nullptr;
  const std::vector<double> all(numbers, numbers + (numbers ? count : 0));
  VSIFree(numbers);
  return all;
}

/// Returns the lowest and the highest valid number of a variable, as stored; empty if it states none.
std::vector<double> valid_range_of(const Variable& variable) {
  std::vector<double> range = numbers_of(variable, "valid_range");
  if (range.size() != 2) {
    const std::vector<double> low = numbers_of(variable, "valid_min"), high = numbers_of(variable, "valid_max");
    if (low.empty() && high.empty()) return {};
    range = {low.empty() ? -HUGE_VAL : low[0], high.empty() ? HUGE_VAL : high[0]};
  }
  return range[0] <= range[1] ? range : std::vector<double>();
}

/// Returns 2 if a name means heights, 0 if it means something else, else 1.
int rank_as_heights(const std::string& name) {
  const auto says = [name = lower_case(name)](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* w) { return name.find(w) != name.npos; });
  };
  if (says({"uncert", "dev", "std", "err", "tvu", "thu", "qual", "count", "dens", "hits", "mask", "flag", "back",
            "intens", "slope", "aspect", "bnds"}))
    return 0;
  return lower_case(name) == "z" || says({"elev", "height", "depth", "bathy", "topo", "altitude"}) ? 2 : 1;
}

/// Returns the index of the band with the requested number or name, else of the first that fits best. Names it in
/// `raw`, and the others in its notes.
std::size_t choose(RawCloud& raw, const MeaningOverride& requested, const std::vector<std::string>& names) {
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < names.size(); ++i)
    if (rank_as_heights(names[i]) > rank_as_heights(names[chosen])) chosen = i;
  const auto text = [&](std::size_t i) {
    return std::to_string(i + 1) + (names[i].empty() ? "" : " (" + names[i] + ")");
  };
  std::vector<std::string> all;
  for (std::size_t i = 0; i < names.size(); ++i) all.push_back(text(i));
  if (!requested.band.empty() || requested.band_number > 0) {
    std::size_t number = requested.band_number;
    const auto named = std::find_if(names.begin(), names.end(), [&](const std::string& n) {
      return number == 0 && lower_case(n) == lower_case(requested.band);
    });
    const bool counted = (number > 0 || to_number(requested.band, number)) && number >= 1 && number <= names.size();
    if (named == names.end() && !counted)
      fail(ErrorKind::content, raw.path, ": has no band '",
           requested.band.empty() ? std::to_string(number) : requested.band, "'; it has ", joined(all));
    chosen = named != names.end() ? static_cast<std::size_t>(named - names.begin()) : number - 1;
  } else if (names.size() > 1) {
    raw.meaning.band = {text(chosen), MeaningOrigin::guessed,
                        "heights are those of band " + text(chosen) + " of " + joined(all) + "; --band takes another"};
  }
  if (lower_case(names[chosen]).find("depth") != std::string::npos) raw.named_depth = true;
  return chosen;
}

/// Reads facts about the variable of a netCDF grid and its axes, by CF conventions.
void take_attributes(RawCloud& raw, const Variable& variable, const Variable (&axes)[2]) {
  FileMeaning& meaning = raw.meaning;
  if (attribute_of(variable, "positive") == "down")
    meaning.z_down = {true, MeaningOrigin::file, "its attribute positive = down: heights are depths"};
  if (attribute_of(variable, "standard_name").find("depth") != std::string::npos) raw.named_depth = true;
  if (std::vector<double> range = valid_range_of(variable); !range.empty())
    meaning.valid = {std::move(range), MeaningOrigin::file};
  for (const Variable& axis : axes) {
    if (!axis) continue;
    const std::string units = attribute_of(axis, "units"), name = attribute_of(axis, "standard_name");
    if (units.starts_with("degree") || name == "longitude" || name == "latitude")
      meaning.no_lengths = "is in degrees by its axes, but a scene needs metres to the east, to the north and up; ";
    const std::optional<double> metres = unit_named(units);
    if (metres && *metres != 1)
      meaning.unit = {*metres, MeaningOrigin::file, "the axes are in " + units + ": converted to metres"};
  }
}

/// Opens the plane of a netCDF file's variable of heights. Returns nothing for other files, and for those in which GDAL
/// finds none with two axes.
GdalFile open_netcdf(RawCloud& raw, const MeaningOverride& requested) {
  const GdalFile file(
      GDALOpenEx(raw.path.c_str(), GDAL_OF_MULTIDIM_RASTER | GDAL_OF_READONLY, netcdf_drivers, nullptr, nullptr));
  const Group group(file ? GDALDatasetGetRootGroup(file.get()) : nullptr);
  if (!group) return nullptr;

  // List variables of two axes, and of more if the others, such as time, have one step.
  std::vector<std::string> names;
  char** const all = GDALGroupGetMDArrayNames(group.get(), nullptr);
  for (char** name = all; name && *name; ++name) {
    const Variable variable(GDALGroupOpenMDArray(group.get(), *name, nullptr));
    std::size_t count = 0;
    GDALDimensionH* const dimensions = variable ? GDALMDArrayGetDimensions(variable.get(), &count) : nullptr;
    bool plane = count >= 2;
    for (std::size_t d = 0; d < count; ++d) {
      const Variable axis(GDALDimensionGetIndexingVariable(dimensions[d]));
      plane = plane && (d + 2 < count ? GDALDimensionGetSize(dimensions[d]) == 1 : axis != nullptr);
    }
    GDALReleaseDimensions(dimensions, count);
    if (plane) names.push_back(*name);
  }
  CSLDestroy(all);
  if (names.empty()) return nullptr;

  const std::string& name = names[choose(raw, requested, names)];
  const Variable variable(GDALGroupOpenMDArray(group.get(), name.c_str(), nullptr));
  std::size_t count = 0;
  GDALDimensionH* const dimensions = GDALMDArrayGetDimensions(variable.get(), &count);
  const Variable axes[2] = {Variable(GDALDimensionGetIndexingVariable(dimensions[count - 2])),
                            Variable(GDALDimensionGetIndexingVariable(dimensions[count - 1]))};
  take_attributes(raw, variable, axes);
  GDALReleaseDimensions(dimensions, count);
  std::string view = "[";
  for (std::size_t d = 0; d + 2 < count; ++d) view += "0,";
  const Variable plane(count == 2 ? nullptr : GDALMDArrayGetView(variable.get(), (view + "...]").c_str()));
  return GdalFile(GDALMDArrayAsClassicDataset(plane ? plane.get() : variable.get(), 1, 0));
}

/// Opens any raster as GDAL presents it. Refinements of a BAG are resampled to one grid.
GdalFile open_bands(RawCloud& raw) {
  const auto open = [&](const char* const* options) {
    return GdalFile(GDALOpenEx(raw.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, raster_drivers, options, nullptr));
  };
  GdalFile file = open(nullptr);
  const char* const refined = file ? GDALGetMetadataItem(file.get(), "HAS_SUPERGRIDS", nullptr) : nullptr;
  if (!refined || std::string_view(refined) != "TRUE") return file;
  raw.notes.push_back("its refinements are read as one grid, of their finest resolution");
  const char* const options[] = {"MODE=RESAMPLED_GRID", "VALUE_POPULATION=MEAN", nullptr};
  return open(options);
}

/// Throws Error(content) for a file that GDAL does not read, and for one with too many cells.
void check_raster(const std::string& path, GDALDatasetH file) {
  const std::string reason = CPLGetLastErrorMsg();
  if (!file)
    fail(ErrorKind::content, path, ": is no raster that GDAL reads, or it is cut off",
         reason.empty() ? std::string() : " (" + reason + ")", "; it looks like ", what_it_looks_like(path));
  if (GDALGetRasterCount(file) < 1)
    fail(ErrorKind::content, path,
         ": holds several rasters or none; choose one: gdal_translate NETCDF:in.nc:elevation out.tif");
  const double whole = static_cast<double>(GDALGetRasterXSize(file)) * GDALGetRasterYSize(file);
  if (whole > most_raster_cells)
    fail(ErrorKind::content, path, ": has ", whole,
         " cells, must be at most 2^28; cut it out: gdal_translate -projwin WEST NORTH EAST SOUTH in.tif out.tif");
  expect_from_file(path, file_size_of(path),
                   {whole, "cells", 3 * sizeof(double),
                    "cut it out, or save it as it is: gdal_translate -co COMPRESS=NONE in.tif out.tif"});
}

}  // namespace

HeightBand open_heights(RawCloud& raw, const MeaningOverride& requested) {
  HeightBand heights{open_netcdf(raw, requested), nullptr, {0, 1, 0, 0, 0, 1}};
  const bool netcdf = heights.file != nullptr;
  if (!netcdf) heights.file = open_bands(raw);
  const GDALDatasetH file = heights.file.get();
  check_raster(raw.path, file);
  const std::string driver = netcdf ? "netCDF" : GDALGetDriverShortName(GDALGetDatasetDriver(file));
  int number = 1;
  if (!netcdf) {
    std::vector<std::string> names;
    for (int b = 1; b <= GDALGetRasterCount(file); ++b) names.push_back(GDALGetDescription(GDALGetRasterBand(file, b)));
    number = static_cast<int>(choose(raw, requested, names)) + 1;
  }
  heights.band = GDALGetRasterBand(file, number);
  raw.format = "raster of heights, " + driver;
  raw.fields = {{"height", GDALGetDataTypeName(GDALGetRasterDataType(heights.band))}};
  if (GDALGetGeoTransform(file, heights.transform.data()) != CE_None)
    fail(ErrorKind::content, raw.path,
         ": does not say how large its cells are; give it corners: gdal_translate -a_ullr WEST ",
         "NORTH EAST SOUTH in.tif out.tif");

  // The unit of the plane is that of the axes, else of the coordinate system; the unit of the heights that of the band.
  FileMeaning& meaning = raw.meaning;
  const std::array<double, 6>& at = heights.transform;
  const std::string zone =
      utm_code(at[0] + 0.5 * GDALGetRasterXSize(file) * at[1], at[3] + 0.5 * GDALGetRasterYSize(file) * at[5]);
  const std::string remedy = "project it first: gdalwarp -t_srs EPSG:" + zone + " -r bilinear in.tif out.tif";
  if (!meaning.no_lengths.empty()) meaning.no_lengths += remedy + if_metres;
  const Meant<double> of_axes = meaning.unit;
  take_system(GDALGetSpatialRef(file), remedy, meaning);
  if (of_axes.origin == MeaningOrigin::file) meaning.unit = of_axes;
  if (driver == "BAG") meaning.z_down = {false, MeaningOrigin::file, ""};  // elevations, whatever its system says
  const std::string unit = GDALGetRasterUnitType(heights.band);
  if (const std::optional<double> metres = unit_named(unit); metres && *metres != meaning.unit.value)
    meaning.unit_z = {*metres, MeaningOrigin::file, "the heights are in " + unit + ": converted to metres"};
  int has_none = 0;
  if (driver == "AAIGrid" && (GDALGetRasterNoDataValue(heights.band, &has_none), has_none == 0))
    meaning.no_data = {{-9999}, MeaningOrigin::convention, ""};
  return heights;
}

}  // namespace insonify
