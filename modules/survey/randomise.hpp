// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "acoustics/environment.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "sonar/sonar_head.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

/// Random differences between the pings of a survey and its mission: half widths of uniform distributions; 0: no
/// difference.
struct Randomisation {
  double source_level_db = 0;                      ///< level of the sonar
  double noise_db = 0;                             ///< the sonar's own noise and the ambient level
  double temperature_c = 0, salinity_psu = 0;      ///< water
  double position = 0, heading = 0, attitude = 0;  ///< head: each coordinate [m]; yaw; pitch and roll each [rad]
  std::int64_t scene_pings = 0;                    ///< pings between draws of a scene's scattered bodies; 0: drawn once

  /// Returns true if pings differ by sonar, water or pose.
  bool any() const {
    return source_level_db > 0 || noise_db > 0 || temperature_c > 0 || salinity_psu > 0 || position > 0 ||
           heading > 0 || attitude > 0;
  }
};

class Ground;

/// Poses of a vehicle that are drawn at random: limits of uniform draws.
struct RandomPoses {
  std::int64_t pings = 0;                               ///< number of poses; 0: none
  Eigen::Vector3d low = Eigen::Vector3d::Zero();        ///< least coordinates [m, world]
  Eigen::Vector3d high = Eigen::Vector3d::Zero();       ///< greatest coordinates [m, world]
  std::array<double, 2> yaw{-pi, pi}, pitch{}, roll{};  ///< least and greatest angle [rad]
  double clearance = 0.5;  ///< least height above the ground, below and at eight places as far around [m]; 0: any
};

/// Throws Error(argument) unless all limits are finite and ascend, and the clearance is at least 0.
void require_valid(const RandomPoses& rule, const char* who);

/// Returns the pose of the vehicle at a ping, in world axes: the first of up to 1000 draws that is clear of the ground
/// (E198). It depends on rule, seed, number and ground alone. Where there is no ground, a position is clear. Throws
/// Error(content) naming the ping if no draw is clear.
Pose drawn_pose(const RandomPoses& rule, std::uint64_t seed, std::int64_t number, const Ground& ground);

/// The differences of one ping, within the half widths.
struct RandomisedPing {
  double source_level_db = 0, noise_db = 0, temperature_c = 0, salinity_psu = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], world axes
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();    ///< yaw, pitch, roll about the head's own axes [rad]
};

/// Returns the differences of a ping. They depend on seed, head and number of the ping alone.
RandomisedPing randomised(const Randomisation& spread, std::uint64_t seed, const SurveyPing& ping);

/// Returns a pose that is moved and turned by the differences.
Pose moved_by(const RandomisedPing& by, const Pose& world_from_head);

/// Applies the differences of sonar and water. Salinity stays within 0 and 45 psu, temperature within 0 and 40 degrees.
void apply(const RandomisedPing& by, SonarHead& head, Environment& environment);

}  // namespace insonify
