#include "formats/las_file.hpp"

#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/utc.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr double las_step = 1e-4;  // of coordinates [m]
constexpr std::uint16_t las_header_bytes = 375, las_point_bytes = 30 + 4 + 4 + 4 + 2;
constexpr double adjusted_by = 1e9;  // of adjusted GPS time [s]
constexpr std::uint8_t bathymetric_point = 40;

/// An extra dimension; types as the specification numbers them.
struct ExtraBytes {
  std::uint8_t type;
  const char* name;
  const char* description;
};
constexpr ExtraBytes extra_bytes[] = {{9, "level_db", "dB re 1 uPa"},
                                      {9, "deviation", "predicted, of range [m]"},
                                      {5, "ping", "number of the ping"},
                                      {3, "beam", "number of the beam, from port"}};

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

LasFile::LasFile(const std::string& path, const UtmZone& zone, const Eigen::Vector3d& offset)
    : pending_(path),
      out_(pending_.temporary(), std::ios::binary),
      wkt_(utm_wkt(zone)),
      offset_(offset.array().round()) {
  out_ << header();
}

/// Public header block and variable length records.
std::string LasFile::header() const {
  std::string records;
  put_variable_record(records, "LASF_Projection", 2112, "OGC WKT", wkt_ + '\0');
  put_variable_record(records, "LASF_Spec", 4, "Extra Bytes", extra_bytes_record());

  std::string bytes = "LASF";
  put_little(bytes, std::uint16_t{0});
  put_little(bytes, std::uint16_t{0x11});  // adjusted GPS time, well-known text
  bytes.append(16, '\0');                  // project
  bytes.push_back(1), bytes.push_back(4);
  put_field(bytes, "insonify", 32);
  put_field(bytes, "insonify export", 32);
  put_little(bytes, std::uint32_t{0});  // day and year of creation: the same points, the same bytes
  put_little(bytes, las_header_bytes);
  put_little(bytes, static_cast<std::uint32_t>(las_header_bytes + records.size()));
  put_little(bytes, std::uint32_t{2});  // variable length records
  put_little(bytes, std::uint8_t{6});
  put_little(bytes, las_point_bytes);
  bytes.append(4 + 5 * 4, '\0');  // legacy counts
  for (int axis = 0; axis < 3; ++axis) put_little(bytes, las_step);
  for (int axis = 0; axis < 3; ++axis) put_little(bytes, offset_[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    put_little(bytes, points_ > 0 ? most_[axis] : 0.0);
    put_little(bytes, points_ > 0 ? least_[axis] : 0.0);
  }
  put_little(bytes, std::uint64_t{0});  // waveforms
  put_little(bytes, std::uint64_t{0});  // extended records: start and number
  put_little(bytes, std::uint32_t{0});
  put_little(bytes, points_);
  put_little(bytes, points_);  // all are first returns
  bytes.append(14 * 8, '\0');
  return bytes + records;
}

void LasFile::add(const LasPoint& point) {
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::nearbyint((point.position[axis] - offset_[axis]) / las_step);
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
  put_little(bytes, std::uint8_t{0x11});  // first of one return
  put_little(bytes, std::uint8_t{0});
  put_little(bytes, bathymetric_point);
  put_little(bytes, std::uint8_t{0});
  put_little(bytes, std::int16_t{0});
  put_little(bytes, std::uint16_t{0});
  put_little(bytes, gps_time_of_utc(point.time) - adjusted_by);
  put_little(bytes, point.level_db);
  put_little(bytes, point.deviation);
  put_little(bytes, point.ping);
  put_little(bytes, point.beam);
  out_ << bytes;
  ++points_;
}

void LasFile::finish() {
  out_.seekp(0);
  out_ << header();
  pending_.commit(out_);
}

}  // namespace insonify
