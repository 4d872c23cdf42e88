// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "compare/resample_image.hpp"
#include "core/error.hpp"
#include "core/pose.hpp"
#include "tool/command/option_list.hpp"

/// Files that `compare` reads.
namespace insonify::tool {

/// Options of `compare`.
struct CompareOptions {
  CommonOptions common;
  std::string a, b, output;
  int ping = 0, ping_b = -1;  ///< numbers of the pings of A and of B; -1: that of A
  int frame = 0;              ///< number of the frame of a recording of an imaging sonar
  int channel = 0;            ///< number of the channel of a recording of a side-scan
  std::string scale;          ///< MIN:MAX [dB] of grey values, or empty
  std::string window;         ///< MIN:MAX [dB], or empty: automatic
  std::string strength;       ///< field of a cloud
  std::string unit = "db";    ///< unit of the field `strength`
  std::string repeat;         ///< another record of the same place
  double cell = 0.25;         ///< [m] of grids of soundings and scene
  double angles = 5;          ///< [deg] width of the bands of angle in which swaths are compared
  bool align = false;         ///< move A by the shift that is found
  bool force = false;
};

/// An image to compare, and what it is of.
struct ComparedFile {
  ComparedImage image;
  bool from_port = false;                 ///< beams are the columns of a picture, from port to starboard
  std::optional<Pose> world_from_head{};  ///< pose of the head; absent for what is no run
  double centre_frequency = 0, bandwidth = 0, sound_speed = 0;  ///< numbers of a run [Hz, Hz, m/s]; 0: unknown
  std::string kind{};                                           ///< run, ARIS 1200, NPY, PNG of 8 bits, ...
  bool waterfall = false;                                       ///< rows are pings of one beam
  std::vector<double> altitude{};  ///< altitude of a recorded waterfall [m], by ping; 0: unknown
};

/// "MIN:MAX" in dB. Throws Error(argument) naming the option.
GreyWindow parse_window(const std::string& option, const std::string& text);

/// Returns true if a path is the recording of a side-scan, which is compared as a waterfall: pings x bins.
bool is_waterfall(const std::string& path);

/// Reads a run (directory or cube), a recording, .npy or .png; with `waterfall` all pings of a run of one beam. Throws
/// Error(argument) for another file, a ping, frame or channel that is not there, or grey values without --scale;
/// Error(content) for the waterfall of a run of several beams; and as the readers.
ComparedFile load_compared(const std::string& path, int ping, const CompareOptions& options, bool waterfall = false);

/// Returns what `body` gives; adds the names of both files to what it finds wrong with their content.
template <typename Body>
auto naming_both(const CompareOptions& options, const Body& body) {
  try {
    return body();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::content) throw;
    fail(ErrorKind::content, options.a, ", ", options.b, ": ", error.what());
  }
}

/// Brings two images to one grid: of one size as they are, beams of pictures in the order of the other's fan; of two
/// geometries A as resampled to B; of two waterfalls as many pings as both have, from the first on. Throws
/// Error(content) naming sizes and remedy if neither is possible, and both files if they have nothing in common.
void match(ComparedFile& a, ComparedFile& b, const CompareOptions& options);

/// Levels predicted by a run at the points of a cloud, against their strengths.
struct ComparedPoints {
  std::vector<double> predicted_db, measured_db, range, repeated_db;  ///< repeated: NaN where there is no point near
  std::size_t in_cloud = 0;                                           ///< points with a strength
};

/// Points of the cloud B that the image A holds; silent pixels and strengths that are not > 0 of a linear unit are left
/// out. Throws Error(argument) if A is no run, Error(content) if fewer than three points are left.
ComparedPoints compared_points(const ComparedFile& a, const CompareOptions& options);

}  // namespace insonify::tool
