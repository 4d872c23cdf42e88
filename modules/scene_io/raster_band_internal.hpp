// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "scene_io/gdal_library_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: the band of a raster that holds its heights.
namespace insonify {

struct CloseGdal {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using GdalFile = std::unique_ptr<void, CloseGdal>;

/// An open raster and its band of heights.
struct HeightBand {
  GdalFile file;
  GDALRasterBandH band;
  std::array<double, 6> transform;  ///< column and row to the plane (GDALGetGeoTransform) [units of the file]
};

/// Opens a raster, while GDAL is kept from printing, and chooses the band or netCDF variable of its heights: the one
/// that `requested` names, else one whose name means heights, else the first. Sets the format, field, meaning and notes of
/// `raw`. Throws Error(content) for files that GDAL does not read, cells of unknown size, and bands that do not exist.
HeightBand open_heights(RawCloud& raw, const MeaningOverride& requested);

}  // namespace insonify
