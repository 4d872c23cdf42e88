// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include <Eigen/Core>

namespace insonify {

/// The WGS 84 ellipsoid: semi-major axis [m] and flattening.
inline constexpr double wgs84_semi_major_axis = 6378137.0;
inline constexpr double wgs84_flattening = 1 / 298.257223563;

/// Where the origin of the world is, and which way its x axis points: for products with coordinates of the globe.
struct Anchor {
  double latitude_deg = 0, longitude_deg = 0;
  double heading_deg = 0;  ///< of the world's x axis, clockwise from north
};

/// A place on WGS 84.
struct GeoPlace {
  double latitude = 0, longitude = 0;  ///< [rad], positive north and east
  double height = 0;                   ///< above the ellipsoid [m]
};

/// A place of a UTM zone.
struct UtmPlace {
  double easting = 0, northing = 0;  ///< [m]
};

/// A zone of the Universal Transverse Mercator projection.
struct UtmZone {
  int number = 1;  ///< 1 to 60
  bool north = true;
  bool operator==(const UtmZone&) const = default;
};

/// Throws Error(argument) unless the latitude is within -90 and 90 degrees, the longitude within -360 and 360, and the
/// heading finite; `who` names the caller.
void require_valid(const Anchor& anchor, const char* who);

/// Returns earth-centred, earth-fixed coordinates [m] (E90), and their inverse, good to 1e-9 m: longitude in (-pi, pi].
Eigen::Vector3d ecef_of(const GeoPlace& place);
/// The inverse of ecef_of.
GeoPlace geo_place_of(const Eigen::Vector3d& ecef);

/// Returns the place of a point of the world [m], whose plane z = 0 touches the ellipsoid at the anchor (E90): x points
/// along the heading, y to its left, z up. Errors as require_valid.
GeoPlace geo_from_world(const Anchor& anchor, const Eigen::Vector3d& world);
/// The inverse of geo_from_world [m].
Eigen::Vector3d world_from_geo(const Anchor& anchor, const GeoPlace& place);

/// Returns the zone of a place, by longitude alone: the exceptions of Norway and Svalbard are not made.
UtmZone utm_zone_of(const GeoPlace& place);
/// Returns the transverse Mercator projection of a place (E91), within a micrometre to 30 degrees from the zone's
/// middle. Throws Error(argument) for a zone that does not exist, or a place further than 60 degrees from its middle.
UtmPlace utm_place_of(const GeoPlace& place, const UtmZone& zone);
/// The inverse of utm_place_of, at height 0.
GeoPlace geo_place_of(const UtmPlace& place, const UtmZone& zone);
/// The EPSG code of the zone on WGS 84: 32601 to 32660 north, 32701 to 32760 south.
int epsg_code(const UtmZone& zone);

/// Returns where coordinates of the world are on the globe: of a world in UTM its zone, else an anchor.
struct Georeference {
  std::optional<UtmZone> zone{};  ///< world x is easting, y northing; `anchor` does not count
  Anchor anchor{};
};
/// The place of a point of the world [m]; in a zone its height is z.
GeoPlace geo_from_world(const Georeference& reference, const Eigen::Vector3d& world);
/// Angle of a horizontal direction of the world clockwise from north [rad, 0 to 2 pi) at a point of the world, of a
/// zone with the convergence of its meridians: from the places of two points 1 m apart.
double heading_of(const Georeference& reference, const Eigen::Vector3d& world, const Eigen::Vector3d& direction);

/// Reads LAT,LON[,HEADING] in degrees, and a zone as 32N or 19S. Throw Error(argument) naming `option`, with the rule.
Anchor parse_anchor(const std::string& text, const std::string& option);
/// The same of a zone.
UtmZone parse_utm_zone(const std::string& text, const std::string& option);

}  // namespace insonify
