// SPDX-License-Identifier: BSD-3-Clause
// Tests the differences between pings of a survey (E126).
#include "survey/randomise.hpp"

#include "support/test.hpp"

TEST(Randomise, draws_are_uniform_and_of_seed_head_and_number_alone) {
  const Randomisation spread{3, 2, 5, 1, 0.2, 0.1, 0.05};
  double sum = 0, squares = 0, most = 0;
  for (std::int64_t number = 0; number < 4000; ++number) {
    const RandomisedPing by = randomised(spread, 7, {.head = 1, .number = number});
    sum += by.source_level_db, squares += by.source_level_db * by.source_level_db;
    most = std::max(
        {most, std::abs(by.position.x()) / 0.2, std::abs(by.angles[1]) / 0.05, std::abs(by.temperature_c) / 5});
  }
  EXPECT_NEAR(sum / 4000, 0, 3 * 3 / std::sqrt(3 * 4000.0));  // three standard errors
  EXPECT_NEAR(squares / 4000, 3, 0.13);                       // 3^2 / 3
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.999);
  const SurveyPing one{.head = 0, .number = 5}, other_time{.head = 0, .number = 5, .time = 9},
      next{.head = 0, .number = 6};
  EXPECT_EQ(randomised(spread, 7, one).position, randomised(spread, 7, other_time).position);
  EXPECT_NE(randomised(spread, 7, one).position, randomised(spread, 7, next).position);
  EXPECT_NE(randomised(spread, 7, one).position, randomised(spread, 8, one).position);
  EXPECT_FALSE(Randomisation{}.any());
  EXPECT_EQ(randomised({}, 7, one).position, Eigen::Vector3d::Zero());
}

TEST(Randomise, moves_and_turns_the_head_and_changes_level_and_water) {
  RandomisedPing by;
  by.position = {1, 2, 3};
  by.angles = {pi / 2, 0, 0};
  by.source_level_db = -2, by.temperature_c = 50, by.noise_db = 4;
  const Pose moved = moved_by(by, pose_from_yaw_pitch_roll({1, 0, 0}, pi / 2, 0, 0));
  EXPECT_TRUE(moved.translation().isApprox(Eigen::Vector3d(2, 2, 3)));
  EXPECT_TRUE((moved.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitX()));
  SonarHead head;
  head.pulse.source_level_db = 210;
  Environment environment;
  environment.self_noise_db = 30;
  apply(by, head, environment);
  EXPECT_EQ(head.pulse.source_level_db, 208);
  EXPECT_EQ(*environment.self_noise_db, 34);
  EXPECT_EQ(environment.water.temperature_c, 40);  // water stays water
}
