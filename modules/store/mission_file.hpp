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

/// Which sonar a head of the mission is.
struct MissionSonar {
  std::string sonar;                  ///< preset, or path of a sonar file
  std::string range;                  ///< "min:max" [m], or empty: the sonar's
  std::vector<std::string> settings;  ///< "sonar.beams=128", ...
};

/// What a mission says of the water level, for soundings.
struct MissionWater {
  std::optional<double> level{};  ///< world z [m]; absent: that of the environment's surface, else 0
  std::string datum = "UNKNOWN";  ///< name of the vertical datum z = 0, e.g. "MSL"
};

/// A mission file. Of the tables [scene] and [ping] only the lines are looked at: they hold settings of the tool.
struct MissionFile {
  std::string path, text;            ///< text: the whole file
  std::string scene;                 ///< path
  std::string environment, profile;  ///< paths, or empty
  std::uint64_t seed = 1;
  MissionWater water{};       ///< of the table [water]
  Randomisation randomise{};  ///< of the table [randomise]: by how much pings differ
  bool coverage = false;      ///< the survey keeps what its pings did to each surfel
  std::string start_utc;      ///< of time 0, e.g. "2026-05-01T08:30:00Z", or empty
  std::optional<Anchor> anchor;
  std::string trajectory;            ///< path, or empty: waypoints
  double position_deviation = 0;     ///< of nav_noise, of each coordinate [m]
  Mission mission;                   ///< listening times are 0: they follow from sonar and water
  std::vector<MissionSonar> sonars;  ///< of each head
};

/// When and where on the globe a survey is.
struct SurveyFrame {
  std::string start_utc;         ///< of time 0, or empty
  std::optional<Anchor> anchor;  ///< of the world's axes
};

/// Reads start_utc and anchor of a mission alone; errors as load_mission.
SurveyFrame load_survey_frame(const std::string& path);

/// What the pings of a survey differ by.
struct SurveyRandomisation {
  Randomisation spread;
  std::uint64_t seed = 1;
};

/// Reads seed and [randomise] of a mission alone; errors as load_mission.
SurveyRandomisation load_survey_randomisation(const std::string& path);

/// Reads a mission from TOML (docs/survey.md lists the keys). Paths are looked up from the current folder, then from
/// the folder of the file, then from the one above. Unknown keys, wrong types, and whatever require_valid(mission)
/// refuses are errors with file, line and rule. Throws Error(file) or Error(content).
MissionFile load_mission(const std::string& path);

}  // namespace insonify
