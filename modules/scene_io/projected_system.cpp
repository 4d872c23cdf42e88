// SPDX-License-Identifier: BSD-3-Clause
// Projected coordinate systems through GDAL and PROJ. Without GDAL all are refused, with a remedy.
#include "scene_io/projected_system.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

#ifdef INSONIFY_GDAL
#include "scene_io/gdal_library_internal.hpp"
#endif

namespace insonify {

#ifndef INSONIFY_GDAL

ProjectedSystem::ProjectedSystem(int epsg, const char* option) {
  fail(ErrorKind::runtime, option, " EPSG:", epsg,
       ": needs GDAL, which was not found when insonify was built; install libgdal-dev and build again, or leave ",
       option, " out for UTM");
}
int ProjectedSystem::epsg() const { return 0; }
double ProjectedSystem::unit() const { return 1; }
std::string ProjectedSystem::wkt() const { return ""; }
Eigen::Vector2d ProjectedSystem::position_of(const GeoPosition&) const { return {0, 0}; }
GeoPosition ProjectedSystem::geo_position_of(const Eigen::Vector3d&) const { return {}; }

#else

namespace {

constexpr double beside_area_deg = 0.5;  // margin for surveys at the border of a system's area
constexpr int wgs84_degrees = 4326;

struct FreeTransformation {
  void operator()(void* transformation) const { OCTDestroyCoordinateTransformation(transformation); }
};

GdalReference reference_of(int epsg, const std::string& named) {
  GdalReference reference(OSRNewSpatialReference(nullptr));
  if (OSRImportFromEPSG(reference.get(), epsg) != OGRERR_NONE)
    fail(ErrorKind::argument, named, " is not known to PROJ", QuietGdalErrors::reason(),
         "; look it up at epsg.org, e.g. EPSG:32632 for UTM zone 32N");
  OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

/// Returns a transformation. It does not guess where data for a datum are missing.
void* transformation_between(void* from, void* to) {
  const auto options = OCTNewCoordinateTransformationOptions();
  OCTCoordinateTransformationOptionsSetBallparkAllowed(options, 0);
  void* const made = OCTNewCoordinateTransformationEx(from, to, options);
  OCTDestroyCoordinateTransformationOptions(options);
  return made;
}

}  // namespace

struct ProjectedSystem::Parts {
  int epsg = 0;
  std::string named;
  GdalReference reference;
  double unit = 1;
  bool bounded = false;
  double west = -180, south = -90, east = 180, north = 90;  ///< area of use [deg]
  std::string area;
  std::unique_ptr<void, FreeTransformation> transformation, back;  ///< longitude, latitude [deg] to plane, and back

  bool holds(double longitude, double latitude) const {
    if (!bounded) return true;
    if (latitude < south - beside_area_deg || latitude > north + beside_area_deg) return false;
    double width = east - west;  // negative across the 180th meridian
    if (width < 0) width += 360;
    const double away = std::remainder(longitude - (west + width / 2), 360);
    return std::abs(away) <= width / 2 + beside_area_deg;
  }
};

ProjectedSystem::ProjectedSystem(int epsg, const char* option) {
  const auto parts = std::make_shared<Parts>();
  parts_ = parts;
  Parts& p = *parts;
  p.epsg = epsg;
  p.named = std::string(option) + " EPSG:" + std::to_string(epsg);
  if (epsg < 1024 || epsg > 32766)
    fail(ErrorKind::argument, p.named, " must be within 1024 and 32766, the codes that GeoTIFF holds");
  const QuietGdalErrors quiet;
  p.reference = reference_of(epsg, p.named);
  void* const reference = p.reference.get();
  const std::string name = OSRGetName(reference);
  if (OSRIsGeographic(reference) || OSRIsGeocentric(reference))
    fail(ErrorKind::argument, p.named, " (", name,
         ") has degrees or earth-centred axes, but cells need metres: give a ", "projected system, or leave ", option,
         " out for UTM");
  if (!OSRIsProjected(reference) || OSRIsCompound(reference))
    fail(ErrorKind::argument, p.named, " (", name, ") is no projected system alone; give that of its plane, or leave ",
         option, " out for UTM");
  OGRAxisOrientation first = OAO_Other, second = OAO_Other;
  OSRGetAxis(reference, nullptr, 0, &first), OSRGetAxis(reference, nullptr, 1, &second);
  const bool east_north = first == OAO_East && second == OAO_North,
             north_east = first == OAO_North && second == OAO_East;
  if (!east_north && !north_east)
    fail(ErrorKind::argument, p.named, " (", name, ") counts to the ", OSRAxisEnumToName(first), " and the ",
         OSRAxisEnumToName(second), ", but a grid is north up: leave ", option, " out for UTM");
  p.unit = OSRGetLinearUnits(reference, nullptr);
  const char* area = nullptr;
  p.bounded = OSRGetAreaOfUse(reference, &p.west, &p.south, &p.east, &p.north, &area) && p.west > -1000;
  p.area = name + (area ? std::string(", for ") + area : std::string());
  const GdalReference globe = reference_of(wgs84_degrees, "EPSG:4326");
  p.transformation.reset(transformation_between(globe.get(), reference));
  p.back.reset(transformation_between(reference, globe.get()));
  if (!p.transformation || !p.back)
    fail(ErrorKind::content, p.named, " (", p.area, "): PROJ has no transformation from WGS 84",
         QuietGdalErrors::reason(), "; install proj-data, or leave ", option, " out for UTM");
}

int ProjectedSystem::epsg() const { return parts_->epsg; }
double ProjectedSystem::unit() const { return parts_->unit; }

std::string ProjectedSystem::wkt() const {
  const QuietGdalErrors quiet;
  char* text = nullptr;
  OSRExportToWkt(parts_->reference.get(), &text);
  const std::string wkt = text ? text : "";
  VSIFree(text);
  return wkt;
}

Eigen::Vector2d ProjectedSystem::position_of(const GeoPosition& position) const {
  double x = degrees(position.longitude), y = degrees(position.latitude);
  if (!parts_->holds(x, y))
    fail(ErrorKind::argument, parts_->named, " (", parts_->area, ") does not reach to latitude ", y, ", longitude ", x,
         "; give the system of that place, or none for UTM");
  const QuietGdalErrors quiet;
  const double longitude = x, latitude = y;
  if (!OCTTransform(parts_->transformation.get(), 1, &x, &y, nullptr) || !std::isfinite(x) || !std::isfinite(y))
    fail(ErrorKind::content, parts_->named, " (", parts_->area, "): PROJ has no place for latitude ", latitude,
         ", longitude ", longitude, QuietGdalErrors::reason(), "; install proj-data, or leave it out for UTM");
  return Eigen::Vector2d(x, y) * parts_->unit;
}

GeoPosition ProjectedSystem::geo_position_of(const Eigen::Vector3d& position) const {
  const QuietGdalErrors quiet;
  double x = position.x() / parts_->unit, y = position.y() / parts_->unit;
  if (!OCTTransform(parts_->back.get(), 1, &x, &y, nullptr) || !std::isfinite(x) || !std::isfinite(y))
    fail(ErrorKind::content, parts_->named, " (", parts_->area, "): PROJ has no place for (", position.x(), ", ",
         position.y(), ") m", QuietGdalErrors::reason(), "; is the world in another system?");
  if (!parts_->holds(x, y))
    fail(ErrorKind::argument, parts_->named, " (", parts_->area, ") does not reach to latitude ", y, ", longitude ", x,
         ", where it has (", position.x(), ", ", position.y(), ") m; is the world in another system?");
  return {radians(y), radians(x), position.z()};
}

#endif

int epsg_of_system(const std::string& system) {
  constexpr std::size_t digits = 5;  // their offset, after "EPSG:"
  int code = 0;
  if (system.size() <= digits || (system.compare(0, digits, "EPSG:") != 0 && system.compare(0, digits, "epsg:") != 0))
    return 0;
  const char* const end = system.data() + system.size();
  const char* const stopped = std::from_chars(system.data() + digits, end, code).ptr;
  return stopped == end || *stopped == ' ' ? code : 0;
}

Georeference georeference_in(int epsg, const char* option) {
  Georeference reference;
  reference.zone = utm_zone_with(epsg);
  if (!reference.zone)
    reference.system = {epsg, [system = ProjectedSystem(epsg, option)](const Eigen::Vector3d& world) {
                          return system.geo_position_of(world);
                        }};
  return reference;
}

}  // namespace insonify
