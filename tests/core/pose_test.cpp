// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.hpp"

#include "support/test.hpp"

using Eigen::Vector3d;

namespace {
void expect_near(const Vector3d& a, const Vector3d& b) {
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " | " << b.transpose();
}
}  // namespace

TEST(Pose, yaw_turns_to_port_pitch_lowers_the_nose_roll_lowers_starboard) {
  const Vector3d forward = Vector3d::UnitX(), port = Vector3d::UnitY();
  expect_near(pose_from_yaw_pitch_roll({0, 0, 0}, radians(90), 0, 0) * forward, port);
  EXPECT_LT((pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(30), 0) * forward).z(), 0);
  EXPECT_GT((pose_from_yaw_pitch_roll({0, 0, 0}, 0, 0, radians(30)) * port).z(), 0);
}

TEST(Pose, applies_roll_first_and_yaw_last) {
  const Pose pose = pose_from_yaw_pitch_roll({1, 2, 3}, radians(90), radians(90), 0);
  expect_near(pose * Vector3d::UnitX(), Vector3d(1, 2, 2));  // nose straight down whatever the yaw
}

TEST(Pose, from_ned_is_the_same_pose_in_z_up_axes) {
  // 3 m deep, heading 30 deg clockwise (east of north), nose 10 deg up.
  const Pose ned = pose_from_ned({5, 7, 3}, radians(30), radians(10), 0);
  expect_near(ned.translation(), Vector3d(5, -7, -3));
  const Vector3d nose = ned.linear() * Vector3d::UnitX();
  EXPECT_NEAR(direction_of(nose).azimuth, radians(-30), 1e-12);
  EXPECT_NEAR(direction_of(nose).elevation, radians(10), 1e-12);
}

TEST(Direction, survives_a_round_trip_and_the_poles) {
  for (const double az : {-3.0, -1.0, 0.0, 0.5, 2.9})
    for (const double el : {-1.5, -0.3, 0.0, 1.2}) {
      const Direction d = direction_of(7.5 * unit_vector({az, el}));
      EXPECT_NEAR(d.azimuth, az, 1e-12);
      EXPECT_NEAR(d.elevation, el, 1e-12);
    }
  EXPECT_EQ(direction_of({0, 0, -2}).azimuth, 0);
  EXPECT_DOUBLE_EQ(direction_of({0, 0, -2}).elevation, -pi / 2);
}
