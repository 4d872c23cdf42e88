// SPDX-License-Identifier: BSD-3-Clause
#include "core/geodesy.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <complex>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;

constexpr double flatness = wgs84_flattening;
constexpr double eccentricity_squared = flatness * (2 - flatness);
constexpr double scale_on_meridian = 0.9996, false_easting = 500000, false_northing = 10000000;

/// Returns the radius of curvature in the prime vertical [m].
double normal_radius(double latitude) {
  const double s = std::sin(latitude);
  return wgs84_semi_major_axis / std::sqrt(1 - eccentricity_squared * s * s);
}

/// Returns the axes at a position, with rows east, north, up in earth-centred axes.
Eigen::Matrix3d axes_at(double latitude, double longitude) {
  const double sp = std::sin(latitude), cp = std::cos(latitude), sl = std::sin(longitude), cl = std::cos(longitude);
  Eigen::Matrix3d axes;
  axes << -sl, cl, 0, -sp * cl, -sp * sl, cp, cp * cl, cp * sl, sp;
  return axes;
}

/// Returns the world's axes in columns, as east, north, up.
Eigen::Matrix3d world_axes(double heading) {
  const double s = std::sin(heading), c = std::cos(heading);
  Eigen::Matrix3d axes;
  axes << s, -c, 0, c, s, 0, 0, 0, 1;
  return axes;
}

// Krueger's series to the sixth order of n (Karney 2011, eq. 35), and the radius of its sphere [m].
constexpr double third_flattening = flatness / (2 - flatness);
constexpr std::array<double, 6> krueger_series() {
  constexpr double n = third_flattening, n2 = n * n, n3 = n2 * n, n4 = n3 * n, n5 = n4 * n, n6 = n5 * n;
  return {n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180 - 127 * n5 / 288 + 7891 * n6 / 37800,
          13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440 + 281 * n5 / 630 - 1983433 * n6 / 1935360,
          61 * n3 / 240 - 103 * n4 / 140 + 15061 * n5 / 26880 + 167603 * n6 / 181440,
          49561 * n4 / 161280 - 179 * n5 / 168 + 6601661 * n6 / 7257600,
          34729 * n5 / 80640 - 3418889 * n6 / 1995840,
          212378941 * n6 / 319334400};
}
constexpr double rectifying_radius() {
  constexpr double n2 = third_flattening * third_flattening;
  return wgs84_semi_major_axis / (1 + third_flattening) * (1 + n2 / 4 + n2 * n2 / 64 + n2 * n2 * n2 / 256);
}

/// Returns the difference of the series from the spherical transverse Mercator projection.
Complex series_at(const Complex& sphere) {
  Complex sum = 0;
  for (int j = 1; j <= 6; ++j) sum += krueger_series()[static_cast<std::size_t>(j - 1)] * std::sin(2.0 * j * sphere);
  return sum;
}

/// Returns the tangent of the conformal latitude from that of the latitude. (Karney 2011, eq. 7)
double conformal_tangent(double t) {
  const double e = std::sqrt(eccentricity_squared), root = std::sqrt(1 + t * t);
  const double s = std::sinh(e * std::atanh(e * t / root));
  return t * std::sqrt(1 + s * s) - s * root;
}

/// Inverts conformal_tangent by Newton's method. (Karney 2011, eq. 19 to 21)
double tangent_from_conformal(double conformal) {
  double t = conformal / (1 - eccentricity_squared);
  for (int step = 0; step < 8; ++step) {
    const double now = conformal_tangent(t);
    const double delta = (conformal - now) / std::sqrt(1 + now * now) * (1 + (1 - eccentricity_squared) * t * t) /
                         ((1 - eccentricity_squared) * std::sqrt(1 + t * t));
    t += delta;
    if (std::abs(delta) <= 1e-15 * std::max(1.0, std::abs(t))) break;
  }
  return t;
}

double middle_of(const UtmZone& zone) {
  if (zone.number < 1 || zone.number > 60)
    fail(ErrorKind::argument, "UTM zone ", zone.number, " does not exist, must be within 1 and 60");
  return radians(6.0 * zone.number - 183);
}

}  // namespace

void require_valid(const Anchor& anchor, const char* who) {
  if (!(std::abs(anchor.latitude_deg) <= 90))
    fail(ErrorKind::argument, who, ": latitude = ", anchor.latitude_deg, " deg, must be within -90 and 90");
  if (!(std::abs(anchor.longitude_deg) <= 360))
    fail(ErrorKind::argument, who, ": longitude = ", anchor.longitude_deg, " deg, must be within -360 and 360");
  if (!std::isfinite(anchor.heading_deg))
    fail(ErrorKind::argument, who, ": heading = ", anchor.heading_deg, " deg, must be finite");
}

Eigen::Vector3d ecef_of(const GeoPosition& p) {
  const double radius = normal_radius(p.latitude), cp = std::cos(p.latitude);  // (E90)
  return {(radius + p.height) * cp * std::cos(p.longitude), (radius + p.height) * cp * std::sin(p.longitude),
          (radius * (1 - eccentricity_squared) + p.height) * std::sin(p.latitude)};
}

GeoPosition geo_position_of(const Eigen::Vector3d& ecef) {
  const double equatorial = std::hypot(ecef.x(), ecef.y());
  GeoPosition position{std::atan2(ecef.z(), equatorial * (1 - eccentricity_squared)), std::atan2(ecef.y(), ecef.x()),
                       0};
  for (int step = 0; step < 12; ++step)  // each step divides the error by 150 or more
    position.latitude = std::atan2(
        ecef.z() + eccentricity_squared * normal_radius(position.latitude) * std::sin(position.latitude), equatorial);
  const double s = std::sin(position.latitude), c = std::cos(position.latitude);
  position.height = equatorial * c + ecef.z() * s - wgs84_semi_major_axis * std::sqrt(1 - eccentricity_squared * s * s);
  return position;
}

GeoPosition geo_from_world(const Anchor& anchor, const Eigen::Vector3d& world) {
  require_valid(anchor, "geo_from_world");
  const double latitude = radians(anchor.latitude_deg), longitude = radians(anchor.longitude_deg);
  const Eigen::Vector3d local = world_axes(radians(anchor.heading_deg)) * world;
  return geo_position_of(ecef_of({latitude, longitude, 0}) + axes_at(latitude, longitude).transpose() * local);
}

Eigen::Vector3d world_from_geo(const Anchor& anchor, const GeoPosition& position) {
  require_valid(anchor, "world_from_geo");
  const double latitude = radians(anchor.latitude_deg), longitude = radians(anchor.longitude_deg);
  const Eigen::Vector3d local = axes_at(latitude, longitude) * (ecef_of(position) - ecef_of({latitude, longitude, 0}));
  return world_axes(radians(anchor.heading_deg)).transpose() * local;
}

UtmZone utm_zone_of(const GeoPosition& position) {
  const double east = degrees(std::remainder(position.longitude, 2 * pi));  // within -180 .. 180
  return {static_cast<int>(std::floor((east + 180) / 6)) % 60 + 1, position.latitude >= 0};
}

UtmPosition utm_position_of(const GeoPosition& position, const UtmZone& zone) {
  const double from_middle = std::remainder(position.longitude - middle_of(zone), 2 * pi);
  if (!(std::abs(from_middle) <= radians(60)))
    fail(ErrorKind::argument, "utm_position_of: longitude ", degrees(position.longitude),
         " deg, must be within 60 deg of the ", "middle of zone ", zone.number);
  const double t = conformal_tangent(std::tan(position.latitude)), c = std::cos(from_middle);
  const Complex sphere(std::atan2(t, c), std::asinh(std::sin(from_middle) / std::hypot(t, c)));
  const Complex plane = scale_on_meridian * rectifying_radius() * (sphere + series_at(sphere));  // (E91)
  return {false_easting + plane.imag(), plane.real() + (zone.north ? 0 : false_northing)};
}

GeoPosition geo_position_of(const UtmPosition& position, const UtmZone& zone) {
  const double middle = middle_of(zone);
  const Complex plane =
      Complex(position.northing - (zone.north ? 0 : false_northing), position.easting - false_easting) /
      (scale_on_meridian * rectifying_radius());
  Complex sphere = plane;
  for (int step = 0; step < 12; ++step) sphere = plane - series_at(sphere);  // each step divides the error by about 300
  const double s = std::sinh(sphere.imag()), c = std::cos(sphere.real());
  const double t = tangent_from_conformal(std::sin(sphere.real()) / std::hypot(s, c));
  return {std::atan(t), std::remainder(middle + std::atan2(s, c), 2 * pi), 0};
}

int epsg_code(const UtmZone& zone) { return (zone.north ? 32600 : 32700) + zone.number; }

std::optional<UtmZone> utm_zone_with(int epsg) {
  const int number = epsg % 100, family = epsg / 100;
  if ((family != 326 && family != 327) || number < 1 || number > 60) return {};
  return UtmZone{number, family == 326};
}

GeoPosition geo_from_world(const Georeference& reference, const Eigen::Vector3d& world) {
  if (!reference.zone && reference.system.epsg > 0) return reference.system.position_of(world);
  if (!reference.zone) return geo_from_world(reference.anchor, world);
  GeoPosition position = geo_position_of(UtmPosition{world.x(), world.y()}, *reference.zone);
  position.height = world.z();
  return position;
}

double heading_of(const Georeference& reference, const Eigen::Vector3d& world, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d step(direction.x(), direction.y(), 0);
  const GeoPosition from = geo_from_world(reference, world), to = geo_from_world(reference, world + step.normalized());
  const Eigen::Vector3d way = axes_at(from.latitude, from.longitude) * (ecef_of(to) - ecef_of(from));
  const double heading = std::atan2(way.x(), way.y());
  return heading < 0 ? heading + 2 * pi : heading;
}

Anchor parse_anchor(const std::string& text, const std::string& option) {
  std::vector<double> numbers;
  bool all_numbers = true;
  for (const std::string_view word : split_at(',', text)) {
    const auto number = finite_number(trimmed(word));
    all_numbers = all_numbers && number;
    numbers.push_back(number.value_or(0));
  }
  if (!all_numbers || (numbers.size() != 2 && numbers.size() != 3))
    fail(ErrorKind::argument, option, " '", text, "', must be LAT,LON[,HEADING] in degrees, e.g. 54.1,7.9,90");
  const Anchor anchor{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0};
  require_valid(anchor, option.c_str());
  return anchor;
}

void require_plausible(const Georeference& reference, const Eigen::Vector3d& world, const std::string& option) {
  constexpr double highest = 9e3;  // height above all mountains [m]
  if (const double away = world.head<2>().norm(); !reference.is_projected() && away > farthest_from_anchor)
    fail(ErrorKind::argument, option, ": the world has (", std::llround(world.x()), ", ", std::llround(world.y()),
         "), ", std::llround(away / 1000),
         " km from its origin, and an anchor serves worlds within 100 km of theirs: such ",
         "coordinates are projected; give --utm ZONE, e.g. 32N, or --system EPSG:N of the scene instead");
  if (const double height = geo_from_world(reference, world).height; height > highest)
    fail(ErrorKind::argument, option, ": a height of ", std::llround(height), " m, must be at most 9000 m; z of the ",
         "world is ", world.z(), " m");
}

UtmZone parse_utm_zone(const std::string& text, const std::string& option) {
  UtmZone zone;
  const char side = text.empty() ? ' ' : text.back();
  zone.north = side == 'N' || side == 'n';
  const bool known = zone.north || side == 'S' || side == 's';
  const bool numbered = !text.empty() && to_number(std::string_view(text).substr(0, text.size() - 1), zone.number) &&
                        zone.number >= 1 && zone.number <= 60;
  const char band = static_cast<char>(std::toupper(static_cast<unsigned char>(side)));
  if (numbered && !known && band >= 'C' && band <= 'X' && band != 'I' && band != 'O')
    fail(ErrorKind::argument, option, " '", text, "': ", band,
         " is a band of MGRS, but a zone ends in its hemisphere, ", "N or S; this band is in zone ", zone.number,
         band < 'N' ? "S" : "N");
  if (!known || !numbered)
    fail(ErrorKind::argument, option, " '", text, "', must be a number from 1 to 60 and N or S, e.g. 32N");
  return zone;
}

}  // namespace insonify
