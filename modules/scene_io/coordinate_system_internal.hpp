// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene_io/file_meaning.hpp"

// Private to scene_io: the meaning of a file's numbers by its coordinate system.
namespace insonify {

/// A coordinate system in the form of files: WKT, else the three records of GeoTIFF: keys (GeoKeyDirectory), numbers
/// (GeoDoubleParams) and texts (GeoAsciiParams).
struct SystemRecords {
  std::string wkt, keys, numbers, texts;
};

/// End of a message about coordinates in degrees.
inline constexpr const char* if_metres = "; if the numbers are metres all the same, give --unit m";

/// Returns the EPSG code of the UTM zone of a position in degrees; "326ZZ" if the numbers are no place on the earth.
std::string utm_code(double longitude, double latitude);

/// Sets unit, unit of the heights and name of `meaning` to those of a coordinate system, an OGRSpatialReferenceH; null
/// changes nothing. If its coordinates are no lengths, sets meaning.no_lengths, with `remedy`. Only with GDAL.
void take_system(void* reference, const std::string& remedy, FileMeaning& meaning);

/// Sets `meaning` by the coordinate system in the records of a file. GDAL reads them in a child process. Without GDAL,
/// or if GDAL cannot read them, only a sentence about the unit says so. Throws as read_apart.
void take_system(const std::string& path, const SystemRecords& records, const std::string& remedy,
                 FileMeaning& meaning);

}  // namespace insonify
