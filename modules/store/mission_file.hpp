// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.hpp"
#include "survey/mission.hpp"
#include "survey/randomise.hpp"

namespace insonify {

/// The sonar of a head of the mission.
struct MissionSonar {
  std::string sonar;                  ///< preset, or path of a sonar file
  std::string range;                  ///< "min:max" [m]; empty: the range of the sonar
  std::vector<std::string> settings;  ///< such as "sonar.beams=128"
  std::string assumed_profile{};      ///< path of the profile that the processing believes; empty: the true one
};

/// The water level of a mission, for soundings.
struct MissionWater {
  std::optional<double> level{};  ///< world z [m]; absent: that of the environment's surface, else 0
  std::string datum = "UNKNOWN";  ///< name of the vertical datum z = 0, e.g. "MSL"
  std::string tide{};             ///< path of the tide; empty: none, or lists in the mission
};

/// Standard deviations of what the instruments of a vehicle state, by which soundings have uncertainties (E214).
struct InstrumentDeviations {
  double position = 0;             ///< each horizontal coordinate of the vehicle [m]
  double height = 0;               ///< height of the vehicle, by heave, tide or satellites [m]
  double heading = 0;              ///< [rad]
  double attitude = 0;             ///< pitch and roll each [rad]
  double latency = 0;              ///< time of pings in that of the navigation [s]
  double sound_speed = 0;          ///< mean of the profile from the head to the bottom [m/s]
  double surface_sound_speed = 0;  ///< at the head, by which its beams are steered [m/s]
};

/// The contents of a mission file. The tables [scene] and [ping] are settings of the tool; they are not read here.
struct MissionFile {
  std::string path, text;            ///< text: the whole file
  std::string scene;                 ///< path of the scene
  std::string environment, profile;  ///< paths; empty: none
  std::uint64_t seed = 1;
  MissionWater water{};        ///< table [water]
  Randomisation randomise{};   ///< table [randomise]: random differences between pings
  RandomPoses random_poses{};  ///< table [randomise.pose]: poses that replace the trajectory
  bool coverage = false;       ///< true: the survey writes the coverage of each surfel
  std::string start_utc;       ///< date of time 0, such as "2026-05-01T08:30:00Z"; empty: unknown
  std::optional<Anchor> anchor;
  std::string system;             ///< system of the world's coordinates, "EPSG:25832"; empty: unknown
  std::string trajectory;         ///< path of the trajectory; empty: waypoints, or random poses
  double position_deviation = 0;  ///< standard deviation of nav_noise in each coordinate [m]
  std::optional<InstrumentDeviations> instruments{};  ///< table [instruments], else by nav_noise; absent: not stated
  Mission mission;  ///< listening times are 0: they follow from sonar and water; random poses are not drawn
  std::vector<MissionSonar> sonars;  ///< one for each head
};

/// Returns a mission without trajectory, heads and legs, and without the files that it names: for its date, place, seed
/// and [randomise]. Throws as load_mission.
MissionFile load_mission_tables(const std::string& path);

/// Returns a mission from TOML (docs/survey.md lists the keys). Paths are looked up from the current folder, then from
/// the folder of the file, then from the folder above it. Unknown keys, wrong types, and missions that
/// require_valid(mission) refuses are errors with file, line and rule. Throws Error(file) or Error(content).
MissionFile load_mission(const std::string& path);

}  // namespace insonify
