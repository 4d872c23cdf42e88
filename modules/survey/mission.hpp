// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/motion.hpp"
#include "survey/navigation_errors.hpp"

namespace insonify {

/// How a scanning head goes on at the end of a sweep: again from the start, back the way it came, or not at all.
enum class ScanMode { continuous, sector, single };

/// A head that turns about its own z axis between pings; angles in rad, positive to port. During a ping it rests.
struct HeadScan {
  double start = 0, stop = 0;  ///< a whole turn or more apart: the stop is the start again, and no direction of its own
  double step = 0;             ///< between neighbouring directions, > 0
  ScanMode mode = ScanMode::continuous;
};

/// A sonar head on the vehicle and when it pings: at one of `interval`, `distance` and `times`, or, of a head that
/// scans, each time as soon as it has listened long enough.
struct MissionHead {
  std::string name;
  Pose vehicle_from_head = Pose::Identity();  ///< at scan angle 0
  double interval = 0;                        ///< between pings [s]; 0: not given
  double distance = 0;                        ///< along the trajectory between pings [m]; 0: not given
  std::vector<double> times{};                ///< of transmission [s], ascending; empty: not given
  double listening_time = 0;                  ///< 2 max_range / c [s]: no two pings are closer
  std::optional<HeadScan> scan{};
};

/// A named part of the trajectory: pings are sent at times from <= t < to, and at the end of the trajectory if that is
/// `to`. A leg that is not active is a transit without pings.
struct MissionLeg {
  std::string name;
  double from = 0, to = 0;  ///< [s]
  bool active = true;
  std::vector<std::string> heads{};   ///< that ping on it; empty: all
  double interval = 0, distance = 0;  ///< in place of those of the heads, if not 0
};

/// A vehicle with sonar heads on its way.
struct Mission {
  Trajectory trajectory;  ///< world_from_vehicle; vehicle axes as head axes: x forward, y port, z up
  std::vector<MissionHead> heads;
  std::vector<MissionLeg> legs;   ///< in the order of time; empty: one over the whole trajectory
  NavigationErrors navigation{};  ///< by which the poses that are stored differ from those of the trajectory
};

/// Throws Error(argument) unless head `i` can ping: it has a name of letters, digits, '-', '_' and '.' that no head
/// before it has, says once when it pings, and its scan is of finite angles and a step > 0 of at most its span.
void require_valid_head(const Mission& mission, std::size_t i, const char* who);

/// Throws Error(argument) unless leg `i` lies within the trajectory, after the legs before it, has a name of its own,
/// and names heads of the mission.
void require_valid_leg(const Mission& mission, std::size_t i, const char* who);

/// Throws Error(argument) unless trajectory, heads and legs are valid and there is at least one head.
void require_valid(const Mission& mission, const char* who);

}  // namespace insonify
