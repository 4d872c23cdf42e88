// SPDX-License-Identifier: BSD-3-Clause
#include "survey/randomise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/ground.hpp"

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

// Groups of the draws of poses, counted by (ping, try, group); those of heads and water have the groups 0 to 2.
constexpr std::uint64_t place_group = 3, turn_group = 4;
constexpr std::uint64_t most_poses_tried = 1000;

// Returns true if a position is clear of the ground below it and at eight places as far around.
bool is_clear(const Eigen::Vector3d& position, double clearance, const Ground& ground) {
  if (clearance == 0) return true;
  for (int k = 0; k <= 8; ++k) {
    const double turn = pi / 4 * k, away = k < 8 ? clearance : 0;
    const Eigen::Vector2d at = position.head<2>() + away * Eigen::Vector2d(std::cos(turn), std::sin(turn));
    if (const auto below = ground.at(at); below && position.z() < below->height + clearance) return false;
  }
  return true;
}

}  // namespace

void require_valid(const RandomPoses& rule, const char* who) {
  const auto ascend = [&](const char* what, double least, double most) {
    if (!(std::isfinite(least) && std::isfinite(most) && least <= most))
      fail(ErrorKind::argument, who, ": ", what, " from ", least, " to ", most, ", must be finite and ascend");
  };
  for (const int axis : {0, 1, 2}) ascend("box", rule.low[axis], rule.high[axis]);
  ascend("yaw", rule.yaw[0], rule.yaw[1]);
  ascend("pitch", rule.pitch[0], rule.pitch[1]);
  ascend("roll", rule.roll[0], rule.roll[1]);
  if (!(rule.clearance >= 0 && std::isfinite(rule.clearance)))
    fail(ErrorKind::argument, who, ": clearance = ", rule.clearance, " m, must be finite and >= 0");
}

Pose drawn_pose(const RandomPoses& rule, std::uint64_t seed, std::int64_t number, const Ground& ground) {
  require_valid(rule, "drawn_pose");
  const auto within = [](const std::array<double, 2>& limits, double u) {
    return limits[0] + (limits[1] - limits[0]) * u;  // (E198)
  };
  for (std::uint64_t k = 0; k < most_poses_tried; ++k) {
    const auto numbers = [&](std::uint64_t group) {
      return random_uniform(seed, RandomStage::randomise, {static_cast<std::uint64_t>(number), k, group});
    };
    const auto u = numbers(place_group), v = numbers(turn_group);
    const Eigen::Vector3d position =
        rule.low + (rule.high - rule.low).cwiseProduct(Eigen::Vector3d(u[0], u[1], u[2]));  // (E198)
    if (!is_clear(position, rule.clearance, ground)) continue;
    return pose_from_yaw_pitch_roll(position, within(rule.yaw, v[0]), within(rule.pitch, v[1]),
                                    within(rule.roll, v[2]));
  }
  fail(ErrorKind::content, "ping ", number, ": none of ", most_poses_tried, " places drawn in the box is ",
       rule.clearance, " m clear of the ground; raise the box, or lower the clearance");
}

RandomisedPing randomised(const Randomisation& spread, std::uint64_t seed, const SurveyPing& ping) {
  const auto sonar = symmetric_numbers(seed, ping, 0), position = symmetric_numbers(seed, ping, 1),
             turn = symmetric_numbers(seed, ping, 2);
  RandomisedPing by;
  by.source_level_db = spread.source_level_db * sonar[0];
  by.noise_db = spread.noise_db * sonar[1];
  by.temperature_c = spread.temperature_c * sonar[2];
  by.salinity_psu = spread.salinity_psu * sonar[3];
  by.position = spread.position * Eigen::Vector3d(position[0], position[1], position[2]);
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
