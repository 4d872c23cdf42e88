// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include <Eigen/Core>

#include "acoustics/environment.hpp"
#include "core/pose.hpp"
#include "sonar/sonar_head.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

/// By how much the pings of a survey may differ from what the mission says: half widths of uniform distributions, 0:
/// not at all.
struct Randomisation {
  double source_level_db = 0;                      ///< of the sonar
  double noise_db = 0;                             ///< of the sonar's own noise and of the ambient level
  double temperature_c = 0, salinity_psu = 0;      ///< of the water
  double position = 0, heading = 0, attitude = 0;  ///< of the head: each coordinate [m]; yaw; pitch and roll each [rad]
  std::int64_t scene_pings = 0;  ///< scattered bodies of a scene are drawn anew every so many pings; 0: once

  /// Whether pings differ by sonar, water or pose.
  bool any() const {
    return source_level_db > 0 || noise_db > 0 || temperature_c > 0 || salinity_psu > 0 || position > 0 ||
           heading > 0 || attitude > 0;
  }
};

/// What a ping differs by: numbers within the half widths.
struct RandomisedPing {
  double source_level_db = 0, noise_db = 0, temperature_c = 0, salinity_psu = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], world axes
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();    ///< yaw, pitch, roll about the head's own axes [rad]
};

/// What a ping differs by: a function of seed, head and number of the ping alone.
RandomisedPing randomised(const Randomisation& spread, std::uint64_t seed, const SurveyPing& ping);

/// The pose moved and turned.
Pose moved_by(const RandomisedPing& by, const Pose& world_from_head);

/// Applies what concerns sonar and water. Salinity stays within 0 and 45 psu, temperature within 0 and 40 degrees.
void apply(const RandomisedPing& by, SonarHead& head, Environment& environment);

}  // namespace insonify
