#pragma once
#include <string>
#include <vector>

#include "core/geodesy.hpp"
#include "core/grid.hpp"

namespace insonify {

/// A band of a raster; NaN: no value.
struct GeoBand {
  std::string name, unit;  ///< unit: as GDAL's metadata have it, e.g. m; may be empty
  Grid<float> values;      ///< columns along easting, rows along northing, from the south-west
};

/// Where a raster lies.
struct GeoGrid {
  UtmZone zone{};
  double west = 0, south = 0;  ///< corner of the cell of row 0, column 0 [m]
  double cell = 1;             ///< size [m]
  std::string remark{};        ///< of the whole file (ImageDescription); empty: none
};

/// Writes bands as a GeoTIFF 1.1 of 32-bit floats, north up, cells as areas, not compressed, no value NaN. The same bands
/// give the same bytes. Throws Error(argument) without bands, for bands of different or no extent, for a cell that is not
/// > 0 and finite, or for more than 4 GiB; Error(file) if it cannot write.
void write_geotiff(const std::string& path, const std::vector<GeoBand>& bands, const GeoGrid& grid);

}  // namespace insonify
