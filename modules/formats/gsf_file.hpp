// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "acoustics/sound_speed_profile.hpp"
#include "core/geodesy.hpp"

namespace insonify {

class PendingFile;

/// A sounding of a swath, in level axes below the head; "along" is the heading of the ship.
struct GsfBeam {
  bool detected = false;   ///< false: the beam is flagged as unusable, and all other members are 0
  double depth = 0;        ///< below the vertical datum [m], positive down, from -10 km on
  double across = 0;       ///< [m], positive to starboard
  double along = 0;        ///< [m], positive ahead
  double travel_time = 0;  ///< two-way travel time [s]
  double angle = 0;        ///< angle of the beam from straight down at the head [rad], 0 to pi
  double azimuth = 0;      ///< azimuth of the beam, counter-clockwise from starboard [rad]: ahead is pi / 2, port is pi
  double level_db = 0;     ///< dB re 1 uPa
  double quality = 0;      ///< log10(range / its standard deviation)
  double vertical_deviation = 0, horizontal_deviation = 0;  ///< standard deviations [m]
  bool by_phase = false;  ///< true: found from the zero of the phase; false: from the centre of gravity of the echo
  bool rejected = false;  ///< true: flagged as edited by a filter
};

/// One ping of a swath, beams from port to starboard. Each sounding has an entry, and a beam may have several; a beam
/// without soundings has one entry.
struct GsfPing {
  double time = 0;                          ///< UTC, seconds since 1970
  GeoPosition position{};                   ///< position of the head
  double heading = 0, roll = 0, pitch = 0;  ///< ship's attitude [rad]: clockwise from north, starboard down, bow up
  double course = 0, speed = 0;             ///< course and speed over ground [rad, m/s]
  double heave = 0;                         ///< [m], not included in head_depth
  double head_depth = 0;                    ///< depth of the head below the water level [m], part of all depths
  double ship_depth = 0;                    ///< depth of the ship's origin below the water level [m]
  double tide = 0;                          ///< depth below the datum, less depth below the water level [m]
  double separation = 0;                    ///< height of the datum above the ellipsoid [m]
  std::uint32_t number = 0;
  double period = 0;                                   ///< time since the last ping [s]; 0: unknown
  double surface_sound_speed = 0;                      ///< sound speed at the head [m/s]
  double range = 0;                                    ///< end of the range gate [m]
  double sample_rate = 0;                              ///< sample rate of the beams [Hz]
  double centre_frequency = 0, bandwidth = 0;          ///< [Hz]
  double source_level_db = 0;                          ///< dB re 1 uPa at 1 m
  double absorption_db_per_m = 0;                      ///< absorption, one way
  double beam_width_along = 0, beam_width_across = 0;  ///< [rad]
  std::vector<GsfBeam> beams{};
};

/// Sonars with their own subrecord in GSF. All others use that of a SeaBat II, which has beam widths and sound speed.
enum class GsfSensor : std::uint8_t { seabat_ii = 114, em2040 = 149, r2sonic_2024 = 152 };

/// Returns the subrecord for a sonar of this name: em2040 and r2sonic-2024 have their own.
GsfSensor gsf_sensor_of(const std::string& sonar);

/// Mounting of a head on its ship.
struct GsfMounting {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< ahead, to starboard, down from the ship's origin [m]
  double heading = 0, pitch = 0, roll = 0;  ///< turn from straight down [rad]: clockwise, bow up, starboard down
};

/// Processing parameters of the file.
struct GsfProcessing {
  double draft = 0;          ///< depth of the head below the water level at the first ping [m]
  bool submersible = false;  ///< true: the ship's origin is below the water level
  bool tide_compensated = false;
  std::string tidal_datum = "UNKNOWN";    ///< name of the vertical datum, e.g. "MSL"
  std::optional<GsfMounting> mounting{};  ///< absent: unknown
};

/// Contents of the file before its pings.
struct GsfSurvey {
  GsfSensor sensor = GsfSensor::seabat_ii;
  SoundSpeedProfile profile{};  ///< profile of the first pings; depths below the water level
  GeoPosition position{};       ///< position of the profile
  double time = 0;              ///< time of profile, parameters, comment and history, UTC, seconds since 1970
  GsfProcessing processing{};
  std::string comment{};                             ///< names the sonar and the simulator
  std::string history_command{}, history_comment{};  ///< processing of the data
  std::optional<double> position_deviation{};        ///< standard deviation of each coordinate [m], if known
};

/// Attitude and heave of the ship at a ping, as in GsfPing.
struct GsfAttitude {
  double time = 0, pitch = 0, roll = 0, heave = 0, heading = 0;
};

/// Extent of the pings of a file in time and space.
struct GsfSummary {
  std::size_t pings = 0, soundings = 0;
  double begin = 0, end = 0;                        ///< UTC, seconds since 1970
  double south = 0, west = 0, north = 0, east = 0;  ///< bounds of the heads' positions [rad]
  double least_depth = 0, greatest_depth = 0;       ///< bounds of the soundings' depths [m]
};

/// Writes bathymetry in the Generic Sensor Format 3.11 (Leidos 2024). The records are header, summary, comment,
/// history, processing parameters, sound-speed profile, errors of the positions if known, and pings. The attitudes
/// follow after at most a minute of pings. docs/reference/gsf.md lists the fields. The same pings give the same bytes.
class GsfFile {
 public:
  /// Throws Error(file) if the file cannot be made, Error(content) for a time before 1970 or after 2106.
  GsfFile(const std::string& path, const GsfSurvey& survey);
  /// Writes a profile for the following pings, measured and applied at `time` [s, UTC since 1970].
  void add_profile(const SoundSpeedProfile& profile, const GeoPosition& position, double time);
  /// Writes a ping. Throws Error(content) for a ping without beams, with more bytes than a record may have (2^19), with
  /// a number that its field cannot hold, or with a time before 1970 or after 2106; the message names the ping and the
  /// quantity.
  void add(const GsfPing& ping);
  /// Completes the file. Throws Error(file) if not all could be written.
  void finish();

 private:
  void record(std::uint32_t id, std::string data);
  void put_attitudes();

  std::shared_ptr<PendingFile> pending_;
  std::ofstream out_;
  GsfSensor sensor_;
  bool scaled_ = false;  ///< true: a ping has had the scale factors
  GsfSummary summary_{};
  std::vector<GsfAttitude> attitudes_;  ///< attitudes not yet written
};

}  // namespace insonify
