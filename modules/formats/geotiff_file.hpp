// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// A band of a raster; NaN: no value.
struct GeoBand {
  std::string name, unit;  ///< unit: in the form of GDAL's metadata, e.g. m; may be empty
  Grid<float> values;      ///< columns along easting, rows along northing, from the south-west
};

/// Coordinate system, position and cell size of a raster.
struct GeoGrid {
  int epsg = 0;                ///< code of its projected system, from 1024 to 32767; 0: a plane of its own
  double west = 0, south = 0;  ///< corner of the cell of row 0, column 0 [m]
  double cell = 1;             ///< size [m]
  double unit = 1;             ///< length of the unit of the coordinates [m]
  std::string remark{};        ///< remark on the file (ImageDescription); empty: none
};

/// Writes bands as a GeoTIFF 1.1 of 32-bit floats, north up, not compressed. Cells are areas; NaN means no value. The
/// same bands give the same bytes. Throws Error(argument) without bands, for bands of different or no extent, for a
/// cell or unit that is not > 0 and finite, for an EPSG code out of range, or for more than 4 GiB; Error(file) if it
/// cannot write.
void write_geotiff(const std::string& path, const std::vector<GeoBand>& bands, const GeoGrid& grid);

}  // namespace insonify
