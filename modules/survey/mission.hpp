// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/environment.hpp"
#include "acoustics/motion.hpp"
#include "survey/navigation_errors.hpp"

namespace insonify {

/// The motion of a scanning head at the end of a sweep: it starts again, goes back, or stops.
enum class ScanMode { continuous, sector, single };

/// A head that turns about its own z axis between pings; angles in rad, positive to port. During a ping it rests.
struct HeadScan {
  double start = 0, stop = 0;  ///< directions of the sweep; they coincide if it is a whole turn or more
  double step = 0;             ///< angle between neighbouring directions, > 0
  ScanMode mode = ScanMode::continuous;
};

/// The installation of a head as the processing of a survey believes it. Absent parts are as they are in truth.
struct AssumedInstallation {
  std::optional<Pose> vehicle_from_head{};  ///< mounting, at scan angle 0
  std::optional<double> latency{};          ///< MissionHead::latency [s]
  std::optional<double> draught{};          ///< MissionHead::draught [m]
  std::optional<double> sound_speed{};      ///< at the head [m/s]: it steers beams, and converts delays to ranges

  /// Returns true if any part is there.
  bool any() const { return vehicle_from_head || latency || draught || sound_speed; }
};

/// A sonar head on the vehicle, and the rule for its pings: exactly one of `interval`, `distance` and `times`. A
/// scanning head may have none; it then pings as soon as the listening time of the last ping is over.
struct MissionHead {
  std::string name;
  Pose vehicle_from_head = Pose::Identity();  ///< mounting, at scan angle 0
  double interval = 0;                        ///< time between pings [s]; 0: not given
  double distance = 0;                        ///< distance between pings along the trajectory [m]; 0: not given
  std::vector<double> times{};                ///< times of transmission [s], ascending; empty: not given
  double listening_time = 0;                  ///< 2 max_range / c [s]: no two pings are closer
  std::optional<HeadScan> scan{};
  double latency = 0;             ///< age of the poses that navigation delivers for its pings [s]
  double draught = 0;             ///< depth below the water level at rest [m], from which an assumed one differs
  AssumedInstallation assumed{};  ///< errors of its installation: pings are made by the truth, and stored by these
};

/// The height of the water level over time, linear between entries (E217); without entries there is no tide.
struct TideSeries {
  std::vector<double> time;    ///< [s], ascending
  std::vector<double> height;  ///< world z of the water level [m]
};

/// Throws Error(argument) unless a tide has two entries at least, as many times as heights, ascends in time, is finite,
/// and covers the trajectory.
void require_valid(const TideSeries& tide, const Trajectory& trajectory, const char* who);

/// Returns the height of the water level [m]. Throws Error(argument) for a time outside of the series, which states
/// nothing there.
double water_height_at(const TideSeries& tide, double time);

/// Returns the environment at a time: its water level, and with it a sea surface, has the height of the tide. Without a
/// tide it is as it was. Throws as water_height_at.
Environment at_tide(Environment environment, const TideSeries& tide, double time);

/// Returns the trajectory of a vehicle that rises and falls with the water: to its z, which counts from the water
/// level, that of the tide is added. The entries of both remain, so that it is exact between them. Throws as
/// water_height_at.
Trajectory on_the_water(const Trajectory& trajectory, const TideSeries& tide);

/// A named part of the trajectory. Its pings have times from <= t < to; a ping at `to` belongs to it only at the end of
/// the trajectory. A leg that is not active is a transit without pings.
struct MissionLeg {
  std::string name;
  double from = 0, to = 0;  ///< [s]
  bool active = true;
  std::vector<std::string> heads{};   ///< heads that ping on this leg; empty: all
  double interval = 0, distance = 0;  ///< replace those of the heads unless 0
};

/// A vehicle with sonar heads along a trajectory, or at poses that are drawn at random.
struct Mission {
  Trajectory trajectory;  ///< world_from_vehicle; vehicle axes as head axes: x forward, y port, z up
  std::vector<MissionHead> heads;
  std::vector<MissionLeg> legs;   ///< in the order of time; empty: one leg over the whole trajectory
  NavigationErrors navigation{};  ///< differences of the stored poses from the true ones
  TideSeries tide{};              ///< water level; without entries it is that of the environment
  /// No ping is sent between two entries of the trajectory that are farther apart than this [s].
  double max_gap = std::numeric_limits<double>::infinity();
  /// Number of poses that replace the trajectory, at rest, one for each ping of every head; 0: there is a trajectory.
  std::int64_t random_pings = 0;
  std::vector<Pose> poses{};  ///< drawn poses, world_from_vehicle; empty until draw_poses has drawn them
};

/// Returns true if a head or leg, and with it a folder, may have this name: it consists of letters, digits, '-', '_'
/// and '.', and does not begin with '.'.
bool is_plain_name(const std::string& name);

/// Throws Error(argument) unless head `i` is valid. Its name consists of letters, digits, '-', '_' and '.' and differs
/// from those of earlier heads. It has exactly one rule for its pings, or none and no scan at random poses. Its scan has
/// finite angles and a step > 0 of at most its span.
void require_valid_head(const Mission& mission, std::size_t i, const char* who);

/// Throws Error(argument) unless leg `i` lies within the trajectory, after the legs before it, has a name of its own,
/// and names heads of the mission.
void require_valid_leg(const Mission& mission, std::size_t i, const char* who);

/// Returns the distance of entries above which a recorded trajectory has a gap [s]: ten times the median distance, but
/// at least 5 s; infinity for fewer than four entries.
double gap_of(const Trajectory& trajectory);

/// An interval [s] in which a trajectory has no entries.
struct TrajectoryGap {
  double from = 0, to = 0;
};
/// Returns the gap that holds `time`, not at its ends: between two entries farther apart than `max_gap` [s]; nothing if
/// there is none.
std::optional<TrajectoryGap> gap_at(const Trajectory& trajectory, double time, double max_gap);

/// Throws Error(argument) unless trajectory, tide, heads and legs are valid and there is at least one head. Random
/// poses have neither trajectory nor tide nor legs.
void require_valid(const Mission& mission, const char* who);

}  // namespace insonify
