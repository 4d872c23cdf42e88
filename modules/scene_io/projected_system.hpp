// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include <Eigen/Core>

#include "core/geodesy.hpp"

namespace insonify {

/// A projected coordinate system of GDAL and PROJ, selected by its EPSG code.
class ProjectedSystem {
 public:
  /// Looks up the system. Throws Error(argument) naming `option` for an unknown code, for a system that is not purely
  /// projected (degrees, heights), for a code outside 1024 to 32766, the range of GeoTIFF, and for axes that do not
  /// point to the east and the north. Throws Error(runtime) in a build without GDAL, or if the GDAL library is missing.
  ProjectedSystem(int epsg, const char* option);

  /// Returns the EPSG code.
  int epsg() const;
  /// Returns the length of the system's unit [m]: 1, or that of a foot.
  double unit() const;
  /// Returns the well-known text (OGC 01-009).
  std::string wkt() const;
  /// Returns easting and northing of a position on WGS 84, in metres for any unit of the system. The transformation is the
  /// most accurate for which this machine has the data. Throws Error(argument) more than half a degree outside the
  /// system's area of use, and Error(content) where PROJ finds no transformation.
  Eigen::Vector2d position_of(const GeoPosition& position) const;
  /// Returns the position on WGS 84 of easting and northing in metres, at height z: the inverse of position_of. Throws as
  /// position_of.
  GeoPosition geo_position_of(const Eigen::Vector3d& position) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// Returns the EPSG code in a system of FileMeaning, "EPSG:32632 (WGS 84 / UTM zone 32N)", or in "EPSG:32632"; 0 for a
/// system without a code of EPSG.
int epsg_of_system(const std::string& system);

/// Returns the reference of a world in a projected system: a zone on WGS 84, for which GDAL is not needed, or another.
/// Throws as ProjectedSystem; the reference throws, too, more than half a degree outside the area of use.
Georeference georeference_in(int epsg, const char* option);

}  // namespace insonify
