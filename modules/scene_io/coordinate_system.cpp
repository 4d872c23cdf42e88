// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "core/geodesy.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "scene_io/coordinate_system_internal.hpp"
#include "scene_io/read_apart_internal.hpp"

#ifdef INSONIFY_GDAL
#include "scene_io/gdal_library_internal.hpp"
#endif

namespace insonify {

std::string utm_code(double longitude, double latitude) {
  if (!(std::abs(longitude) <= 360 && std::abs(latitude) <= 90)) return "326ZZ";
  return std::to_string(epsg_code(utm_zone_of({radians(latitude), radians(longitude), 0})));
}

#ifndef INSONIFY_GDAL

void take_system(const std::string&, const SystemRecords&, const std::string&, FileMeaning& meaning) {
  meaning.unit.sentence =
      "the coordinate system of the file was not read, as insonify was built without GDAL: taken as metres; if it is "
      "in "
      "feet, give --unit us-ft or --unit ft";
}

#else

template <typename Stream>
void pass(Stream& stream, SystemRecords& records) {
  stream(records.wkt, records.keys, records.numbers, records.texts);
}

namespace {

Meant<double> unit_of(double metres, const char* name, const std::string& noun) {
  if (metres == 1) return {1, MeaningOrigin::file};
  return {metres, MeaningOrigin::file,
          printed("%s in the file are in %.60s (%.10g m) and become metres", noun.c_str(), name ? name : "its unit",
                  metres)};
}

std::string name_of_system(OGRSpatialReferenceH reference) {
  const char* name = OSRGetName(reference);
  const char* const part = OSRIsProjected(reference) && OSRIsCompound(reference) ? "PROJCS" : nullptr;  // for the plane
  const char* const authority = OSRGetAuthorityName(reference, part);
  const char* const code = OSRGetAuthorityCode(reference, part);
  if (!authority || !code) return name ? name : "unnamed";
  return std::string(authority) + ":" + code + " (" + (name ? name : "unnamed") + ")";
}

/// Returns a TIFF of one pixel with the records of a GeoTIFF, which GDAL can read.
std::string tiff_with(const SystemRecords& records) {
  struct Entry {
    std::uint16_t tag, type, bytes_each;
    std::string value;
  };
  const auto number = [](auto n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
  const auto word = [&](std::uint16_t tag, std::uint16_t value) { return Entry{tag, 3, 2, number(value)}; };
  std::vector<Entry> entries = {word(256, 1), word(257, 1), word(258, 8),
                                word(259, 1), word(262, 1), {273, 4, 4, number(std::uint32_t{8})},
                                word(277, 1), word(278, 1), word(279, 1)};
  if (!records.keys.empty()) entries.push_back({34735, 3, 2, records.keys});
  if (!records.numbers.empty()) entries.push_back({34736, 12, 8, records.numbers});
  if (!records.texts.empty()) entries.push_back({34737, 2, 1, records.texts});
  constexpr std::size_t directory = 10;  // after the head and the pixel, which is at 8
  std::string values, tiff = std::string("II*\0", 4) + number(static_cast<std::uint32_t>(directory));
  tiff.resize(directory);
  tiff += number(static_cast<std::uint16_t>(entries.size()));
  const std::size_t behind = directory + 2 + 12 * entries.size() + 4;
  for (Entry& e : entries) {
    const auto count = static_cast<std::uint32_t>(e.value.size() / e.bytes_each);
    tiff += number(e.tag) + number(e.type) + number(count);
    e.value.resize(std::max<std::size_t>(e.value.size() + e.value.size() % 2, 4));
    tiff += e.value.size() == 4 ? e.value : number(static_cast<std::uint32_t>(behind + values.size()));
    if (e.value.size() > 4) values += e.value;
  }
  return tiff + std::string(4, '\0') + values;
}

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};

/// Lets GDAL read the records. Runs in the child process.
void read_records(const SystemRecords& records, const std::string& remedy, FileMeaning& meaning) {
  const QuietGdalErrors quiet;
  if (!records.wkt.empty()) {
    const GdalReference reference(OSRNewSpatialReference(nullptr));
    std::string text = records.wkt.c_str();
    char* at = text.data();
    if (OSRImportFromWkt(reference.get(), &at) == OGRERR_NONE) take_system(reference.get(), remedy, meaning);
    return;
  }
  const GdalReading reading;
  std::string tiff = tiff_with(records);
  const char* const name = "/vsimem/system.tif";
  VSIFCloseL(VSIFileFromMemBuffer(name, reinterpret_cast<GByte*>(tiff.data()), tiff.size(), false));
  const std::unique_ptr<void, CloseDataset> file(GDALOpenEx(name, GDAL_OF_RASTER, nullptr, nullptr, nullptr));
  if (file) take_system(GDALGetSpatialRef(file.get()), remedy, meaning);
}

}  // namespace

void take_system(void* reference, const std::string& remedy, FileMeaning& meaning) {
  if (!reference) return;
  meaning.system = {name_of_system(reference), MeaningOrigin::file};
  const bool degrees = OSRIsGeographic(reference);
  if (degrees || OSRIsGeocentric(reference)) {
    meaning.no_lengths = "is in " + std::string(degrees ? "degrees" : "earth-centred coordinates") +
                         " by its coordinate system, " + meaning.system.value +
                         ", but a scene needs metres to the east, to the north and up; " + remedy + if_metres;
    return;
  }
  char* name = nullptr;
  const double plane = OSRGetLinearUnits(reference, &name);
  if (!(plane > 0) || !std::isfinite(plane)) return;
  meaning.unit = unit_of(plane, name, "coordinates");
  const double high = OSRIsCompound(reference) ? OSRGetTargetLinearUnits(reference, "VERT_CS", &name) : 0;
  if (high > 0 && std::isfinite(high)) {
    if (std::abs(high - plane) > 1e-9 * plane) meaning.unit_z = unit_of(high, name, "heights");
  } else if (plane != 1) {
    meaning.unit.sentence += "; so do heights, whose unit the file does not state";
  }
  OGRAxisOrientation up = OAO_Up;
  if (high > 0 && OSRGetAxis(reference, "VERT_CS", 0, &up) && up == OAO_Down)
    meaning.z_down = {
        true, MeaningOrigin::file,
        "heights count downwards by the coordinate system " + meaning.system.value + "; --z up keeps them"};
}

void take_system(const std::string& path, const SystemRecords& records, const std::string& remedy,
                 FileMeaning& meaning) {
  if (records.wkt.empty() && records.keys.empty()) return;
  const auto read = [](ArraySender& to, const SystemRecords& of_file, const std::string& remedy_of_degrees,
                       FileMeaning& found) {
    try {
      read_records(of_file, remedy_of_degrees, found);
    } catch (const Error&) {  // GDAL is not there
    }
    to(found);
  };
  read_apart(path, limits_of_file(records.wkt.size()), read, records, remedy, meaning)(meaning);
  if (meaning.system.value.empty())
    meaning.unit.sentence =
        "the coordinate system of the file cannot be read: taken as metres; if it is in feet, give --unit us-ft or "
        "--unit ft";
}

#endif

}  // namespace insonify
