// SPDX-License-Identifier: BSD-3-Clause
#include "survey/randomise.hpp"

#include <algorithm>
#include <array>

#include "core/random.hpp"

namespace insonify {
namespace {

// Returns four numbers, uniform within -1 and 1.
std::array<double, 4> symmetric_numbers(std::uint64_t seed, const SurveyPing& ping, std::uint64_t group) {
  std::array<double, 4> numbers =
      random_uniform(seed, RandomStage::randomise,
                     {static_cast<std::uint64_t>(ping.head), static_cast<std::uint64_t>(ping.number), group});
  for (double& number : numbers) number = 2 * number - 1;  // (E126)
  return numbers;
}

}  // namespace

RandomisedPing randomised(const Randomisation& spread, std::uint64_t seed, const SurveyPing& ping) {
  const auto sonar = symmetric_numbers(seed, ping, 0), place = symmetric_numbers(seed, ping, 1),
             turn = symmetric_numbers(seed, ping, 2);
  RandomisedPing by;
  by.source_level_db = spread.source_level_db * sonar[0];
  by.noise_db = spread.noise_db * sonar[1];
  by.temperature_c = spread.temperature_c * sonar[2];
  by.salinity_psu = spread.salinity_psu * sonar[3];
  by.position = spread.position * Eigen::Vector3d(place[0], place[1], place[2]);
  by.angles = {spread.heading * turn[0], spread.attitude * turn[1], spread.attitude * turn[2]};
  return by;
}

Pose moved_by(const RandomisedPing& by, const Pose& world_from_head) {
  Pose moved =
      world_from_head * pose_from_yaw_pitch_roll(Eigen::Vector3d::Zero(), by.angles[0], by.angles[1], by.angles[2]);
  moved.translation() += by.position;
  return moved;
}

void apply(const RandomisedPing& by, SonarHead& head, Environment& environment) {
  head.pulse.source_level_db += by.source_level_db;
  if (environment.self_noise_db) *environment.self_noise_db += by.noise_db;
  Water& water = environment.water;
  water.temperature_c = std::clamp(water.temperature_c + by.temperature_c, 0.0, 40.0);
  water.salinity_psu = std::clamp(water.salinity_psu + by.salinity_psu, 0.0, 45.0);
}

}  // namespace insonify
