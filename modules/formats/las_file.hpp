// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/geodesy.hpp"

namespace insonify {

class PendingFile;

/// Returns the well-known text (OGC 01-009) of a UTM zone on WGS 84, with its EPSG codes.
std::string utm_wkt(const UtmZone& zone);

/// The projected system of the coordinates of a LAS file.
struct LasSystem {
  int epsg = 0;     ///< code of EPSG, within 1024 and 32766
  std::string wkt;  ///< well-known text (OGC 01-009)
  double unit = 1;  ///< length of the unit of all coordinates [m]
  /// Takes code, text and unit [m].
  LasSystem(int code, std::string text, double metres = 1) : epsg(code), wkt(std::move(text)), unit(metres) {}
  /// Takes a zone on WGS 84.
  LasSystem(const UtmZone& zone) : LasSystem(epsg_code(zone), utm_wkt(zone)) {}
};

/// A point of a LAS file.
struct LasPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< easting, northing, height [m]
  double time = 0;                                     ///< UTC, seconds since 1970
  float level_db = 0;                                  ///< dB re 1 uPa
  float deviation = 0;                                 ///< standard deviation of the range [m]
  std::uint32_t ping = 0;
  std::uint16_t beam = 0;
  std::uint16_t source = 0;                     ///< number of the line of the survey, from 1; 0: no line
  std::uint8_t return_number = 1, returns = 1;  ///< among the soundings of its beam, nearest first
  double scan_angle = 0;                        ///< angle from straight down [rad], positive to starboard
  bool withheld = false;                        ///< true: not to be used
};

/// Options of a LasFile.
struct LasOptions {
  int minor = 4;         ///< minor version: 4, point format 6; or 2, point format 1
  double start = 0;      ///< UTC, seconds since 1970: day and year of the header; 0: not known
  std::string remark{};  ///< remark on the file, as a text area description; empty: none
};

/// Writes points as LAS. Points stream: only the header is written twice.
///
///   1.4 (ASPRS 2019)   point format 6: coordinates in steps of 0.1 mm, intensity in steps of 0.01 dB from 0, class 40
///                      (bathymetric point), adjusted GPS time (gps_time_of_utc less 1e9 s), and level_db, deviation,
///                      ping and beam as extra bytes; the system as well-known text
///   1.2                for readers that know no other: point format 1, class 2 (ground, because there is no 40), at
///                      most five returns, scan angles in whole degrees, the system as GeoTIFF keys
class LasFile {
 public:
  /// Begins a file. `offset` [m] is subtracted from coordinates, which may be up to 214 km from it. Throws Error(file)
  /// if the file cannot be made, Error(argument) for another version.
  LasFile(const std::string& path, LasSystem system, const Eigen::Vector3d& offset, const LasOptions& options = {});
  /// Writes a point. Throws Error(content) for a point that is not finite or too far from the offset.
  void add(const LasPoint& point);
  /// Completes the file. Throws Error(file) if not all could be written.
  void finish();

 private:
  std::string header() const;

  std::shared_ptr<PendingFile> pending_;
  std::ofstream out_;
  LasSystem system_;
  LasOptions options_;
  Eigen::Vector3d offset_;
  std::uint64_t points_ = 0;
  std::array<std::uint64_t, 15> by_return_{};
  Eigen::Vector3d least_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most_ = -least_;
};

}  // namespace insonify
