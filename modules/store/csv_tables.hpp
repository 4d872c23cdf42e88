// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "acoustics/motion.hpp"
#include "acoustics/sound_speed_profile.hpp"
#include "sampling/scatterers.hpp"
#include "survey/mission.hpp"

// Tables of other programs as CSV: a header with its columns in any order, then rows. '#' starts a comment line. Blank
// lines, a byte-order mark and Windows line ends are accepted. All functions throw Error(file), or Error(content) with
// path, line, column, value and rule.
namespace insonify {

/// Returns a sound speed profile from a file with the header depth_m,sound_speed [m, m/s] or
/// depth_m,temperature_c,salinity_psu. Depths ascend strictly and are positive down. Temperature and salinity are
/// converted to sound speed by UNESCO (E1) at latitude 45 degrees. Rules: those of require_valid(profile) and, for
/// temperature and salinity, require_valid(water).
SoundSpeedProfile load_sound_speed_profile(const std::string& path);

/// Returns a trajectory of the head from a file with the header time_s,x_m,y_m,z_m,qx,qy,qz,qw (the unit quaternion of
/// world_from_head) or time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg (as pose_from_yaw_pitch_roll: world z up, pitch
/// positive nose down). Quaternions within 1e-3 of unit length are normalised; q and -q are equivalent. Rules: times
/// ascend strictly, angles are within -360 and 360 degrees, there are at least two entries.
Trajectory load_trajectory(const std::string& path);

/// Returns notes on doubtful angles in a file of load_trajectory: on each angle that changes by half a turn or more
/// between two entries. Attitudes take the shortest turn between entries; a longer turn needs entries in between. Files
/// of quaternions have no notes. Throws as load_trajectory.
std::vector<std::string> trajectory_notes(const std::string& path);

/// Returns a trajectory from a file in the TUM format: lines of time, x, y, z, qx, qy, qz, qw, separated by blanks,
/// without a header. Rules as load_trajectory.
Trajectory load_tum_trajectory(const std::string& path);

/// Returns a tide from a file with the header time_s,height_m [s, world z in m]. Rules: times ascend strictly, there
/// are at least two entries.
TideSeries load_tide(const std::string& path);

/// Scatterers from another program: positions, cross-sections and complex amplitudes.
struct ScattererTable {
  Scatterers scatterers;                 ///< range, azimuth, elevation, id = line order
  std::vector<double> sigma;             ///< backscattering cross-section [m^2]
  std::vector<std::complex<double>> xi;  ///< random amplitude, E|xi|^2 = 1
};

/// Returns scatterers from a file with the header range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im.
ScattererTable load_scatterer_table(const std::string& path);

/// Soundings of a table, row by row.
struct SoundingTable {
  std::vector<Eigen::Vector3d> position;  ///< [m]
  std::vector<std::int64_t> ping;         ///< number of the ping; empty: the table has no column `ping`
  std::vector<double> time;               ///< time of the ping [s]; empty: the table has no column `time_s`
};
/// Returns positions from the columns x_m, y_m and z_m of a table such as `insonify export --to csv` writes, and ping
/// and time_s if the table has them. Other columns are ignored; fields must not have quotes. Rules: at least one row.
SoundingTable load_sounding_table(const std::string& path);

/// A user-defined label of a position in a picture.
struct Label {
  double bearing_deg = 0;  ///< positive to starboard
  double range = 0;        ///< [m]
  std::string text;
};

/// Returns labels from a file with the header bearing_deg,range_m,text, in this order; the text is everything after the
/// second comma, optionally in double quotes. Rules: bearings within -360 and 360 degrees, ranges > 0, at least one
/// label.
std::vector<Label> load_labels(const std::string& path);

}  // namespace insonify
