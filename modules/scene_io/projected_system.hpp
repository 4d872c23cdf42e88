// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include <Eigen/Core>

#include "core/geodesy.hpp"

namespace insonify {

/// A projected coordinate system by its EPSG code, as GDAL and PROJ know it, and places in it.
class ProjectedSystem {
 public:
  /// Throws Error(argument) naming `option` for a code that is unknown, not of a projected system alone (degrees,
  /// heights), not within 1024 and 32766, where GeoTIFF has them, or whose axes do not count to the east and the north;
  /// Error(runtime) in a build without GDAL, or if its library is not there.
  ProjectedSystem(int epsg, const char* option);

  /// Its code.
  int epsg() const;
  /// Length of its unit [m]: 1, or that of a foot.
  double unit() const;
  /// Easting and northing [m, whatever its unit] of a place on WGS 84, by the most accurate transformation that this
  /// machine has the data for. Throws Error(argument) outside of the area that the system is for, by more than half a
  /// degree, and Error(content) where PROJ finds no transformation.
  Eigen::Vector2d place_of(const GeoPlace& place) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace insonify
