#include "core/geodesy.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

// WGS 84.
constexpr double equator_radius = 6378137, flattening = 1 / 298.257223563;
constexpr double eccentricity2 = flattening * (2 - flattening);

/// Radius of curvature across the meridian.
double normal_radius(double latitude) {
  return equator_radius / std::sqrt(1 - eccentricity2 * std::sin(latitude) * std::sin(latitude));
}

}  // namespace

GeodeticPlace geodetic_of(const Anchor& anchor, const Eigen::Vector3d& world) {
  if (!(std::abs(anchor.latitude_deg) <= 90 && std::isfinite(anchor.longitude_deg) &&
        std::isfinite(anchor.heading_deg) && world.allFinite()))
    fail(ErrorKind::argument, "geodetic_of: anchor at latitude ", anchor.latitude_deg, ", longitude ",
         anchor.longitude_deg, ", heading ", anchor.heading_deg,
         " degrees, must be finite with a latitude within -90 and 90, and the place finite");
  // East and north on the plane (E92).
  const double heading = radians(anchor.heading_deg);
  const double east = world.x() * std::sin(heading) - world.y() * std::cos(heading);
  const double north = world.x() * std::cos(heading) + world.y() * std::sin(heading);

  // Geocentric place relative to the meridian of the anchor: x in its plane, y east, z along the earth's axis.
  const double latitude = radians(anchor.latitude_deg), sine = std::sin(latitude), cosine = std::cos(latitude);
  const double normal = normal_radius(latitude);
  const double x = (normal + world.z()) * cosine - north * sine, y = east;
  const double z = ((1 - eccentricity2) * normal + world.z()) * sine + north * cosine;

  // The latitude whose normal meets the earth's axis where the place asks for; each step gains a factor of 150.
  const double from_axis = std::hypot(x, y);
  double found = std::atan2(z, from_axis * (1 - eccentricity2));
  constexpr int steps = 10;
  for (int k = 0; k < steps; ++k)
    found = std::atan2(z + eccentricity2 * normal_radius(found) * std::sin(found), from_axis);
  const double radius = normal_radius(found);
  const double height = from_axis * std::cos(found) + z * std::sin(found) -
                        radius * (1 - eccentricity2 * std::sin(found) * std::sin(found));
  const double longitude = anchor.longitude_deg + degrees(std::atan2(y, x));
  return {degrees(found), std::remainder(longitude, 360), height};
}

std::string utc_after(const std::string& start, double seconds) {
  using namespace std::chrono;
  int y = 0, month_number = 0, day_number = 0, h = 0, min = 0, read = 0;
  double s = 0;
  const bool whole = std::sscanf(start.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%n", &y, &month_number, &day_number, &h, &min,
                                 &s, &read) == 6 &&
                     start.substr(static_cast<std::size_t>(read)) == "Z";
  const year_month_day date{year{y}, month{static_cast<unsigned>(month_number)},
                            day{static_cast<unsigned>(day_number)}};
  if (!whole || !date.ok() || h < 0 || h > 23 || min < 0 || min > 59 || !(s >= 0 && s < 61) || !std::isfinite(seconds))
    fail(ErrorKind::argument, "utc_after: '", start, "' and ", seconds,
         " s after it, must be a time of UTC like 2026-05-01T08:30:00Z and finite");
  const auto milliseconds_after = milliseconds(std::llround(1000 * (s + seconds)));
  const auto then = sys_days{date} + hours{h} + minutes{min} + milliseconds_after;
  const auto its_day = floor<days>(then);
  const year_month_day its_date{its_day};
  const hh_mm_ss clock{then - its_day};
  return printed("%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(its_date.year()),
                 static_cast<unsigned>(its_date.month()), static_cast<unsigned>(its_date.day()),
                 static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                 static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
}

}  // namespace insonify
