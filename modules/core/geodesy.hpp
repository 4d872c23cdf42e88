// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace insonify {

/// The WGS 84 ellipsoid: semi-major axis [m] and flattening.
inline constexpr double wgs84_semi_major_axis = 6378137.0;
inline constexpr double wgs84_flattening = 1 / 298.257223563;

/// Position of the world's origin on the globe, and direction of the world's x axis.
struct Anchor {
  double latitude_deg = 0, longitude_deg = 0;
  double heading_deg = 0;  ///< direction of the world's x axis, clockwise from north
};

/// A position on WGS 84.
struct GeoPosition {
  double latitude = 0, longitude = 0;  ///< [rad], positive north and east
  double height = 0;                   ///< height above the ellipsoid [m]
};

/// A position in a UTM zone.
struct UtmPosition {
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

/// Returns the earth-centred, earth-fixed coordinates [m] of a position (E90).
Eigen::Vector3d ecef_of(const GeoPosition& position);
/// Returns the position of earth-centred, earth-fixed coordinates [m], within 1e-9 m; longitude in (-pi, pi].
GeoPosition geo_position_of(const Eigen::Vector3d& ecef);

/// Returns the geographic position of a point of the world [m], whose plane z = 0 touches the ellipsoid at the anchor
/// (E90): x points along the heading, y to its left, z up. Errors as require_valid.
GeoPosition geo_from_world(const Anchor& anchor, const Eigen::Vector3d& world);
/// Returns the point of the world [m] at a position, the inverse of geo_from_world.
Eigen::Vector3d world_from_geo(const Anchor& anchor, const GeoPosition& position);

/// Returns the zone of a position, by longitude alone, without the exceptions of Norway and Svalbard.
UtmZone utm_zone_of(const GeoPosition& position);
/// Returns the transverse Mercator projection of a position (E91), within a micrometre to 30 degrees from the zone's
/// middle. Throws Error(argument) for a zone that does not exist, or a position further than 60 degrees from its
/// middle.
UtmPosition utm_position_of(const GeoPosition& position, const UtmZone& zone);
/// Returns the position of coordinates in a zone, at height 0, the inverse of utm_position_of.
GeoPosition geo_position_of(const UtmPosition& position, const UtmZone& zone);
/// Returns the EPSG code of the zone on WGS 84: 32601 to 32660 north, 32701 to 32760 south.
int epsg_code(const UtmZone& zone);
/// Returns the zone on WGS 84 with this EPSG code, the inverse of epsg_code; absent for any other code.
std::optional<UtmZone> utm_zone_with(int epsg);

/// The projected system of a world's coordinates, other than a zone on WGS 84: x is easting, y northing, in metres.
struct WorldSystem {
  int epsg = 0;
  std::function<GeoPosition(const Eigen::Vector3d&)>
      position_of{};  ///< position of a point of the world; its height is z
};

/// Relation of the world's axes to the globe: the zone of a world in UTM, otherwise its projected system or an anchor.
struct Georeference {
  std::optional<UtmZone> zone{};  ///< world x is easting, y northing; `anchor` is unused
  Anchor anchor{};
  WorldSystem system{};  ///< used if it has a code; `anchor` is then unused

  /// Returns true if the world's coordinates are those of a projected system.
  bool is_projected() const { return zone || system.epsg > 0; }
};
/// Returns the position of a point of the world [m]; in a zone or another projected system, the height is z.
GeoPosition geo_from_world(const Georeference& reference, const Eigen::Vector3d& world);
/// Returns the angle of a horizontal direction of the world at one of its points, clockwise from north [rad, 0 to 2
/// pi). The angle follows from the positions of two points 1 m apart; in a zone, it includes the convergence of the
/// meridians.
double heading_of(const Georeference& reference, const Eigen::Vector3d& world, const Eigen::Vector3d& direction);

/// Returns the anchor of a text LAT,LON[,HEADING] in degrees. Throws Error(argument) with `option` and the rule.
Anchor parse_anchor(const std::string& text, const std::string& option);
/// Largest distance from an anchor [m]. The plane of an anchor touches the ellipsoid: there it is 780 m above it.
inline constexpr double farthest_from_anchor = 100e3;

/// Throws Error(argument) naming `option` if a point of the world [m] is not plausible: more than 100 km from the
/// anchor, since coordinates of such a world are projected ones; or more than 9 km above the ellipsoid.
void require_plausible(const Georeference& reference, const Eigen::Vector3d& world, const std::string& option);
/// Returns the zone of a text such as 32N or 19S, whose letter is the hemisphere. Throws Error(argument) with `option`
/// and the rule; for a letter of the bands of MGRS, with the zone of that band.
UtmZone parse_utm_zone(const std::string& text, const std::string& option);

}  // namespace insonify
