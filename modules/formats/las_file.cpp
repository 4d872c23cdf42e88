// SPDX-License-Identifier: BSD-3-Clause
#include "formats/las_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "files/utc.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr double las_step = 1e-4;          // step of coordinates [m]
constexpr double scan_angle_step = 0.006;  // step of scan angles [deg]
constexpr std::uint16_t extra_bytes_length = 4 + 4 + 4 + 2;
constexpr double adjusted_by = 1e9;  // offset of adjusted GPS time [s]

/// The numbers that differ between versions of LAS.
struct LasVersion {
  int minor;
  std::uint16_t header_bytes;
  std::uint8_t point_format;
  std::uint16_t point_bytes, encoding;
  std::uint8_t most_returns, classification;
};
constexpr LasVersion las_versions[] = {
    {2, 227, 1, 28 + extra_bytes_length, 0x01, 5, 2},     // adjusted GPS time; ground
    {4, 375, 6, 30 + extra_bytes_length, 0x11, 15, 40}};  // well-known text; bathymetric

const LasVersion& las_version(int minor) {
  for (const LasVersion& version : las_versions)
    if (version.minor == minor) return version;
  fail(ErrorKind::argument, "LasFile: options.minor = ", minor, ", must be 2 or 4");
}

/// An extra dimension, with the type's number in the specification.
struct ExtraBytes {
  std::uint8_t type;
  const char* name;
  const char* description;
};
constexpr ExtraBytes extra_bytes[] = {{9, "level_db", "dB re 1 uPa"},
                                      {9, "deviation", "predicted, of range [m]"},
                                      {5, "ping", "number of the ping, from 0"},
                                      {3, "beam", "number of the beam, from 0"}};

void put_variable_record(std::string& bytes, std::string_view user, std::uint16_t id, std::string_view description,
                         const std::string& data) {
  put_little(bytes, std::uint16_t{0});
  put_field(bytes, user, 16);
  put_little(bytes, id);
  put_little(bytes, static_cast<std::uint16_t>(data.size()));
  put_field(bytes, description, 32);
  bytes += data;
}

std::string extra_bytes_record() {
  std::string data;
  for (const ExtraBytes& extra : extra_bytes) {
    data.append(2, '\0');
    put_little(data, extra.type);
    data.push_back('\0');  // no options
    put_field(data, extra.name, 32);
    data.append(4 + 3 * 24 + 2 * 24, '\0');  // unused; no data, minimum, maximum; scale, offset
    put_field(data, extra.description, 32);
  }
  return data;
}

/// Returns the GeoTIFF keys of a projected system; cells are left undefined.
std::string geo_keys(const LasSystem& system) {
  std::string data;
  const auto code = static_cast<std::uint16_t>(system.epsg);
  for (const std::uint16_t number :
       std::initializer_list<std::uint16_t>{1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, code})
    put_little(data, number);
  return data;
}

/// Returns the day of the year, from 1, and the year of a time; 0, 0 for 0.
std::pair<std::uint16_t, std::uint16_t> day_and_year(double utc) {
  using namespace std::chrono;
  if (utc == 0) return {0, 0};
  const sys_days day(days(static_cast<int>(std::floor(utc / 86400))));
  const year of = year_month_day(day).year();
  return {static_cast<std::uint16_t>((day - sys_days(of / January / 1)).count() + 1),
          static_cast<std::uint16_t>(static_cast<int>(of))};
}

}  // namespace

std::string utm_wkt(const UtmZone& zone) {
  const std::string number = std::to_string(zone.number) + (zone.north ? "N" : "S");
  return R"(PROJCS["WGS 84 / UTM zone )" + number +
         R"(",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],)"
         R"(AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,)"
         R"(AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]],PROJECTION["Transverse_Mercator"],)"
         R"(PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",)" +
         std::to_string(6 * zone.number - 183) +
         R"(],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",)" +
         (zone.north ? "0" : "10000000") +
         R"(],UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG",")" +
         std::to_string(epsg_code(zone)) + R"("]])";
}

LasFile::LasFile(const std::string& path, LasSystem system, const Eigen::Vector3d& offset, const LasOptions& options)
    : pending_(std::make_shared<PendingFile>(path)),
      out_(pending_->temporary(), std::ios::binary),
      system_(std::move(system)),
      options_(options),
      offset_((offset / system_.unit).array().round()) {
  out_ << header();
}

/// Returns the public header block and the variable length records.
std::string LasFile::header() const {
  const LasVersion& version = las_version(options_.minor);
  std::string records;
  if (version.minor == 4)
    put_variable_record(records, "LASF_Projection", 2112, "OGC WKT", system_.wkt + '\0');
  else
    put_variable_record(records, "LASF_Projection", 34735, "GeoTIFF keys", geo_keys(system_));
  put_variable_record(records, "LASF_Spec", 4, "Extra Bytes", extra_bytes_record());
  if (!options_.remark.empty()) put_variable_record(records, "LASF_Spec", 3, "Text Area", options_.remark + '\0');

  std::string bytes = "LASF";
  put_little(bytes, std::uint16_t{0});
  put_little(bytes, version.encoding);
  bytes.append(16, '\0');  // project
  bytes.push_back(1), bytes.push_back(static_cast<char>(version.minor));
  put_field(bytes, "insonify", 32);
  put_field(bytes, "insonify export", 32);
  const auto [day, year] = day_and_year(options_.start);  // date of the survey: same points, same bytes
  put_little(bytes, day), put_little(bytes, year);
  put_little(bytes, version.header_bytes);
  put_little(bytes, static_cast<std::uint32_t>(version.header_bytes + records.size()));
  put_little(bytes, std::uint32_t{options_.remark.empty() ? 2U : 3U});  // number of variable length records
  put_little(bytes, version.point_format);
  put_little(bytes, version.point_bytes);
  const bool legacy = version.minor < 4;  // 32-bit counts, empty in later versions
  put_little(bytes, static_cast<std::uint32_t>(legacy ? points_ : 0));
  for (std::size_t k = 0; k < 5; ++k) put_little(bytes, static_cast<std::uint32_t>(legacy ? by_return_[k] : 0));
  for (int axis = 0; axis < 3; ++axis) put_little(bytes, las_step);
  for (int axis = 0; axis < 3; ++axis) put_little(bytes, offset_[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    put_little(bytes, points_ > 0 ? most_[axis] : 0.0);
    put_little(bytes, points_ > 0 ? least_[axis] : 0.0);
  }
  if (!legacy) {
    put_little(bytes, std::uint64_t{0});  // start of waveforms
    put_little(bytes, std::uint64_t{0});  // start and number of extended records
    put_little(bytes, std::uint32_t{0});
    put_little(bytes, points_);
    for (const std::uint64_t count : by_return_) put_little(bytes, count);
  }
  return bytes + records;
}

void LasFile::add(const LasPoint& point) {
  const LasVersion& version = las_version(options_.minor);
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::nearbyint((point.position[axis] / system_.unit - offset_[axis]) / las_step);
    if (!(std::abs(steps) <= 2147483647))
      fail(ErrorKind::content, "LAS: coordinate ", point.position[axis], " m of ping ", point.ping,
           " must be finite and within 214 km of ", offset_[axis], " m");
    put_little(bytes, static_cast<std::int32_t>(steps));
    const double stored = offset_[axis] + steps * las_step;
    least_[axis] = std::min(least_[axis], stored);
    most_[axis] = std::max(most_[axis], stored);
  }
  const double level = std::clamp(static_cast<double>(point.level_db), 0.0, 655.35);
  put_little(bytes, static_cast<std::uint16_t>(std::nearbyint(100 * level)));
  const int number = std::clamp<int>(point.return_number, 1, version.most_returns);
  const int returns = std::clamp<int>(point.returns, number, version.most_returns);
  const double angle = degrees(point.scan_angle);
  if (version.minor == 4) {
    put_little(bytes, static_cast<std::uint8_t>(number | returns << 4));
    put_little(bytes, static_cast<std::uint8_t>(point.withheld ? 0x04 : 0));
    put_little(bytes, version.classification);
    put_little(bytes, std::uint8_t{0});
    put_little(bytes, static_cast<std::int16_t>(std::nearbyint(std::clamp(angle, -180.0, 180.0) / scan_angle_step)));
  } else {
    put_little(bytes, static_cast<std::uint8_t>(number | returns << 3));
    put_little(bytes, static_cast<std::uint8_t>(version.classification | (point.withheld ? 0x80 : 0)));
    put_little(bytes, static_cast<std::int8_t>(std::nearbyint(std::clamp(angle, -90.0, 90.0))));
    put_little(bytes, std::uint8_t{0});
  }
  put_little(bytes, point.source);
  put_little(bytes, gps_time_of_utc(point.time) - adjusted_by);
  put_little(bytes, point.level_db);
  put_little(bytes, point.deviation);
  put_little(bytes, point.ping);
  put_little(bytes, point.beam);
  out_ << bytes;
  ++points_;
  ++by_return_[static_cast<std::size_t>(number - 1)];
}

void LasFile::finish() {
  out_.seekp(0);
  out_ << header();
  pending_->commit(out_);
}

}  // namespace insonify
