#pragma once
#include <string>

#include <Eigen/Core>

namespace insonify {

/// Where the world's axes are on the globe: its z axis is the normal of the WGS 84 ellipsoid at this place, its origin on
/// the ellipsoid.
struct Anchor {
  double latitude_deg = 0, longitude_deg = 0;
  double heading_deg = 0;  ///< of the world's x axis, clockwise from north
};

/// A place on the globe (WGS 84).
struct GeodeticPlace {
  double latitude_deg = 0, longitude_deg = 0;  ///< longitude within -180 and 180
  double height = 0;                           ///< above the ellipsoid [m]
};

/// Latitude, longitude and height of a place in the world [m] (E92): east = x sin h - y cos h, north = x cos h + y sin h, up
/// = z of a local tangent plane (topocentric axes, EPSG method 9837), from there to geocentric axes and back to the
/// ellipsoid (EPSG method 9602). A rigid motion: exact at any distance. Throws Error(argument) for a latitude beyond 90
/// degrees or values that are not finite.
GeodeticPlace geodetic_of(const Anchor& anchor, const Eigen::Vector3d& world);

/// The time `seconds` after `start` (UTC like "2026-05-01T08:30:00Z", perhaps with fractions of the second) in the same form
/// with milliseconds; days have 86400 s. Throws Error(argument) unless `start` is such a time.
std::string utc_after(const std::string& start, double seconds);

}  // namespace insonify
