// SPDX-License-Identifier: BSD-3-Clause
// Tests the differences between pings of a survey (E126).
#include "survey/randomise.hpp"

#include "scene/built_in_scenes.hpp"
#include "scene/ground.hpp"
#include "support/test.hpp"

namespace {

const RandomPoses six_metres{200, {1, -3, -4}, {7, 3, 0}, {radians(-20), radians(40)}, {radians(5), radians(5)},
                             {},  0.5};

/// The ground of the built-in reef, whose rocks stand in the box.
Ground ground_of_reef() {
  Ground ground;
  ground.add({.name = "reef",
              .cloud = std::make_shared<const SceneCloud>(make_built_in_scene("reef", {.points = 30000})),
              .captured = true});
  return ground;
}

}  // namespace

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

TEST(RandomPoses, are_uniform_in_their_box_and_of_seed_and_number_alone) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), least = Eigen::Vector3d::Constant(9), most = -least;
  double yaw = 0;
  constexpr int count = 4000;
  for (std::int64_t number = 0; number < count; ++number) {
    const Pose pose = drawn_pose(six_metres, 7, number, Ground());
    const Eigen::Vector3d at = pose.translation(), ahead = pose.linear().col(0);
    sum += at, least = least.cwiseMin(at), most = most.cwiseMax(at);
    const double turn = std::atan2(ahead.y(), ahead.x());
    ASSERT_GE(turn, radians(-20));
    ASSERT_LE(turn, radians(40));
    yaw += turn;
    EXPECT_NEAR(std::asin(-ahead.z()), radians(5), 1e-9);  // nose down
  }
  for (const int axis : {0, 1, 2}) {
    const double low = six_metres.low[axis], high = six_metres.high[axis], spread = high - low;
    EXPECT_NEAR(sum[axis] / count, (low + high) / 2, 4 * spread / std::sqrt(12.0 * count));  // four standard errors
    EXPECT_GE(least[axis], low);
    EXPECT_LE(most[axis], high);
    EXPECT_LT(least[axis] - low, 0.01 * spread);
    EXPECT_LT(high - most[axis], 0.01 * spread);
  }
  EXPECT_NEAR(yaw / count, radians(10), 4 * radians(60) / std::sqrt(12.0 * count));
  const Pose pose = drawn_pose(six_metres, 7, 3, Ground());
  EXPECT_EQ(pose.matrix(), drawn_pose(six_metres, 7, 3, Ground()).matrix());
  EXPECT_NE(pose.matrix(), drawn_pose(six_metres, 8, 3, Ground()).matrix());
  EXPECT_NE(pose.matrix(), drawn_pose(six_metres, 7, 4, Ground()).matrix());
}

TEST(RandomPoses, are_clear_of_the_ground_below_and_around) {
  const Ground ground = ground_of_reef();
  RandomPoses rule = six_metres;
  const auto least_height = [&](const Pose& pose) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 64; ++k) {
      const double turn = 2 * pi * k / 64;
      const Eigen::Vector2d around(std::cos(turn), std::sin(turn));
      for (const double away : {0.0, 0.5})
        if (const auto below = ground.at(pose.translation().head<2>() + away * around))
          least = std::min(least, pose.translation().z() - below->height);
    }
    return least;
  };
  std::size_t lower = 0, moved = 0;
  for (std::int64_t number = 0; number < 300; ++number) {
    const Pose clear = drawn_pose(rule, 5, number, ground);
    rule.clearance = 0;
    const Pose any = drawn_pose(rule, 5, number, ground);
    rule.clearance = 0.5;
    const double height = least_height(clear);
    EXPECT_GE(height, 0.4) << "ping " << number;  // between two of the eight places the ground may rise a little
    lower += least_height(any) < 0.4;
    moved += clear.matrix() != any.matrix();
  }
  EXPECT_GT(lower, 20U) << "the box reaches below the ground";
  EXPECT_GE(moved, lower);
  rule.high.z() = -6, rule.low.z() = -9;
  EXPECT_THAT(error_with_kind([&] { drawn_pose(rule, 5, 17, ground); }),
              HasSubstr("ping 17: none of 1000 places drawn in the box is 0.5 m clear of the ground"));
}

TEST(RandomPoses, refuse_limits_that_do_not_ascend) {
  RandomPoses rule = six_metres;
  rule.yaw = {1, 0};
  EXPECT_THAT(error_with_kind([&] { require_valid(rule, "poses"); }),
              HasSubstr("poses: yaw from 1 to 0, must be finite"));
  rule = six_metres, rule.low.x() = 8;
  EXPECT_THAT(error_with_kind([&] { require_valid(rule, "poses"); }), HasSubstr("poses: box from 8 to 7"));
  rule = six_metres, rule.clearance = -1;
  EXPECT_THAT(error_with_kind([&] { require_valid(rule, "poses"); }), HasSubstr("clearance = -1 m"));
}
