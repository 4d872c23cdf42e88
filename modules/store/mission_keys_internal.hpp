// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "store/key_table.hpp"
#include "store/mission_file.hpp"
#include "survey/navigation_errors.hpp"
#include "survey/waypoint_trajectory.hpp"

namespace insonify {

/// Values of a mission file that a Mission stores in another form, and the values of one head and one leg.
struct MissionTables {
  Anchor anchor{};
  bool afloat = false;                  ///< true: heights of the trajectory count from the water level
  bool ned = false;                     ///< true: the trajectory's file has north-east-down axes
  double time_offset = 0, max_gap = 0;  ///< 0: not given
  Waypoints way{};
  NavigationNoise noise{};
  InstrumentDeviations instruments{};
  double random_pings = 0;             ///< 0: not given
  std::vector<Eigen::Vector3d> box{};  ///< corners of the box of random poses
  MissionHead head{};
  MissionSonar sonar{};
  HeadScan scan{0, 2 * pi, radians(1)};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double roll = 0, pitch = 0, heading = 0;  ///< mounting in ship axes: x forward, y starboard, z down [rad]
  /// The same as the processing believes them; absent: as they are.
  std::optional<Eigen::Vector3d> assumed_offset{};
  std::optional<double> assumed_roll{}, assumed_pitch{}, assumed_heading{};
  bool starboard = false;
  double rate = 0, dwell = 0;  ///< 0: not given
  MissionLeg leg{};
};

/// Returns the keys of a mission without [scene] and [ping], bound to `tables` and `mission`.
std::vector<Key> mission_keys(MissionTables& tables, MissionFile& mission);

}  // namespace insonify
