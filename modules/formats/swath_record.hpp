// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.hpp"

namespace insonify {

/// Stands for a number that a recording does not state.
inline constexpr double not_recorded = std::numeric_limits<double>::quiet_NaN();

/// A sounding of a recorded swath, in level axes below the position of its ping. Numbers that the recording does not
/// state are not_recorded.
struct SwathSounding {
  std::size_t beam = 0;               ///< entry of the ping, from 0
  double depth = 0;                   ///< below the vertical datum of the recording [m], positive down
  double across = 0, along = 0;       ///< [m], positive to starboard and ahead
  double angle = 0;                   ///< seen from the head, from straight down [rad], positive to starboard (E210)
  double travel_time = not_recorded;  ///< two-way travel time [s]
  double level_db = not_recorded;     ///< level of the echo, in the unit of the recording
  double vertical_deviation = not_recorded, horizontal_deviation = not_recorded;  ///< standard deviations [m]
  bool rejected = false;                                                          ///< flagged as not usable
};

/// A ping of a recorded swath.
struct SwathPing {
  std::uint32_t number = 0;
  double time = 0;                          ///< UTC, seconds since 1970
  GeoPosition position{};                   ///< reference of across and along
  double heading = 0, pitch = 0, roll = 0;  ///< [rad]: clockwise from north, bow up, starboard down
  double heave = 0;                         ///< [m]
  double head_depth = 0;                    ///< depth of the head below the vertical datum [m]; 0: not stated
  double sound_speed = 0;                   ///< sound speed at the head [m/s]; 0: not stated
  double frequency = 0;                     ///< [Hz]; 0: not stated
  std::size_t beams = 0;                    ///< number of entries, with and without a sounding
  std::vector<SwathSounding> soundings{};   ///< ascending by beam
};

/// A recorded profile of sound speed against depth below the water level, as it is recorded.
struct RecordedProfile {
  double time = 0;                             ///< UTC, seconds since 1970
  std::vector<double> depth{}, sound_speed{};  ///< [m, m/s]
};

/// A recorded attitude: [rad] clockwise from north, bow up, starboard down, and heave [m].
struct RecordedAttitude {
  double time = 0;  ///< UTC, seconds since 1970
  double heading = 0, pitch = 0, roll = 0, heave = 0;
};

/// A recording of a multibeam echo sounder.
struct SwathRecord {
  std::string format;  ///< "GSF 3.06", "R2Sonic XTF by QINSy", "KMALL"
  std::string sonar;
  std::string unit;               ///< unit of levels; empty if none are recorded
  bool total_deviations = false;  ///< true: deviations times 1.96 are total uncertainties (TVU, THU) at 95 %
  std::vector<SwathPing> pings{};
  std::vector<RecordedProfile> profiles{};
  std::vector<RecordedAttitude> attitudes{};
  std::map<std::string, std::size_t> records{};  ///< numbers of records by their kind, those that are skipped too
};

/// Returns the angle from straight down under which a head sees a sounding [rad], positive to starboard (E210): atan2
/// of its distance across and its depth below the head.
double swath_angle(const SwathSounding& sounding, double head_depth);

/// Reads a swath from any of the formats that are known, by the ending of its path: .gsf, .kmall, .xtf. Throws
/// Error(argument) for another ending, and as read_gsf, read_kmall and read_r2sonic_xtf.
SwathRecord read_swath(const std::string& path);

/// Returns true for the path of a swath: those that end with .gsf or .kmall, and an XTF file that describes channels of
/// bathymetry and none of a side-scan.
bool is_swath(const std::string& path);

}  // namespace insonify
