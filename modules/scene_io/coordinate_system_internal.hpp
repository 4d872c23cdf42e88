// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene_io/file_meaning.hpp"

// Private to scene_io: what the coordinate system of a file means for its numbers.
namespace insonify {

/// A coordinate system as files state it: as WKT, else as the three records of GeoTIFF: keys (GeoKeyDirectory), numbers
/// (GeoDoubleParams) and texts (GeoAsciiParams).
struct SystemRecords {
  std::string wkt, keys, numbers, texts;
};

/// End of a message about coordinates in degrees.
inline constexpr const char* if_metres = "; if the numbers are metres all the same, give --unit m";

/// Returns the EPSG code of the UTM zone of a place in degrees; "326ZZ" if the numbers are no place on the earth.
std::string utm_code(double longitude, double latitude);

/// Sets unit, unit of the heights and name of `meaning` to those of a coordinate system, an OGRSpatialReferenceH; null
/// says nothing. If its coordinates are no lengths, meaning.no_lengths says so, with `remedy`. Only with GDAL.
void take_system(void* reference, const std::string& remedy, FileMeaning& meaning);

/// Does the same for the records of a file. GDAL reads them in a child process; without GDAL, or if GDAL cannot read
/// them, only a sentence about the unit says so. Throws as read_in_child.
void take_system(const std::string& path, const SystemRecords& records, const std::string& remedy,
                 FileMeaning& meaning);

}  // namespace insonify
