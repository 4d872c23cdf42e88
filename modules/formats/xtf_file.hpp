// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace insonify {

class PendingFile;

/// Side of a channel of a side-scan, with the numbers of XTF.
enum class XtfSide : std::uint8_t { subbottom = 0, port = 1, starboard = 2 };

/// Storage of the samples of a channel, with the numbers of XTF. Integers are unsigned.
enum class XtfSamples : std::uint8_t { ibm_float = 1, integer_32 = 2, integer_16 = 3, ieee_float = 5, integer_8 = 8 };

/// Returns the size of a sample [bytes].
std::size_t sample_bytes(XtfSamples samples);
/// Returns the largest value of a sample: 255, 65535 or 4294967295; 1 for floats.
double full_scale(XtfSamples samples);

/// Description of a channel in the file's header.
struct XtfChannel {
  XtfSide side = XtfSide::starboard;
  XtfSamples samples = XtfSamples::integer_16;
  std::string name{};
  double frequency = 0;                                        ///< [Hz]; 0: unknown
  double beam_width = 0, elevation_width = 0, depression = 0;  ///< along, across, of the axis [rad]; 0: unknown
};

/// The samples of one channel in a ping, over ranges from `begin` to `end` [m], the nearest first.
struct XtfTrace {
  std::size_t channel = 0;  ///< number in the file
  double begin = 0, end = 0;
  double frequency = 0;    ///< [Hz]; 0: unknown
  bool with_gain = false;  ///< true: the samples contain a time-varied gain
  std::vector<float> samples{};
};

/// A ping of a side-scan.
struct XtfPing {
  std::uint32_t number = 0;
  double time = 0;         ///< UTC, seconds since 1970, to a hundredth; 0: not stated
  double sound_speed = 0;  ///< [m/s]; 0: unknown
  double period = 0;       ///< time since the last ping [s]; 0: unknown
  Eigen::Vector2d ship = Eigen::Vector2d::Zero(), sensor = Eigen::Vector2d::Zero();  ///< longitude and latitude [deg]
  double ship_heading = 0, heading = 0, pitch = 0, roll = 0;  ///< [rad]: clockwise from north, bow up, starboard down
  double yaw = 0;       ///< direction of a scanning head relative to `heading` [rad], positive to starboard
  double speed = 0;     ///< speed over ground [m/s]
  double depth = 0;     ///< depth of the sonar below the water level [m]
  double altitude = 0;  ///< altitude of the sonar above the bottom [m]; 0: unknown
  std::vector<XtfTrace> traces{};
};

/// Contents of the file's header, and its annotations.
struct XtfHeader {
  std::string program{}, version{};  ///< recording program, 8 characters each
  std::string sonar{};               ///< 16 characters
  std::string note{};                ///< 64 characters
  bool in_degrees = true;            ///< true: positions are longitude and latitude; false: easting and northing [m]
  std::vector<XtfChannel> channels{};
  std::vector<std::string> notes{};  ///< annotations of at most 200 characters
};

/// Writes pings as eXtended Triton Format (Triton Imaging, X41 of 2016): header, annotations, and a sonar packet for
/// each ping, padded to 64 bytes. The channel of port is stored with its farthest sample first, as by recorders. The
/// same pings give the same bytes.
class XtfFile {
 public:
  /// Begins a file. Throws Error(file) if the file cannot be made, Error(argument) for no channel or more than six,
  /// places in metres, or samples other than of 16 bits and IEEE floats.
  XtfFile(const std::string& path, const XtfHeader& header);
  /// Writes a ping. Integer samples are rounded to the nearest. Throws Error(content) naming ping and quantity for a
  /// ping without traces, a number that its field cannot hold, a sample that is not finite, or a time before 1970 or
  /// after 2106.
  void add(const XtfPing& ping);
  /// Completes the file. Throws Error(file) if not all could be written.
  void finish();

 private:
  std::shared_ptr<PendingFile> pending_;
  std::ofstream out_;
  std::vector<XtfChannel> channels_;
};

/// A recording of a side-scan.
struct XtfRecord {
  XtfHeader header;
  std::vector<XtfPing> pings;
  std::size_t other_packets = 0;  ///< packets that are neither pings of a side-scan nor annotations
};

/// Returns the contents of a recording of any program: samples of 8, 16 and 32 bits, IEEE and IBM floats, with their
/// weighting factor. Packets of other kinds are skipped. A sound speed below 1000 m/s is read as half the true one
/// (that of one way). Throws Error(file) if the file cannot be read; Error(content) if it is not an XTF file, is
/// truncated or damaged (naming packet and byte), or has no ping.
XtfRecord read_xtf(const std::string& path);

}  // namespace insonify
