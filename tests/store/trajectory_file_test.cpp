// SPDX-License-Identifier: BSD-3-Clause
#include "store/csv_tables.hpp"
#include "support/test.hpp"

namespace {
const std::string angles = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n";
const std::string quaternions = "time_s,x_m,y_m,z_m,qx,qy,qz,qw\n";

void refuses_way(const std::string& text, const std::string& what) {
  EXPECT_EQ(error_of_file(load_trajectory, "way.csv", text), "content: way.csv:" + what);
}
}  // namespace

TEST(TrajectoryFile, reads_yaw_pitch_and_roll_in_degrees) {
  const auto t = load_trajectory(own_file("t.csv", "# run 3\n" + angles + "0,1,2,-3,30,15,-5\n0.5,1,2,-4,-90,0,0\n"));
  EXPECT_EQ(t.time, (std::vector<double>{0, 0.5}));
  EXPECT_TRUE(t.pose[0].isApprox(pose_from_yaw_pitch_roll({1, 2, -3}, radians(30), radians(15), radians(-5)), 1e-15));
  EXPECT_TRUE(t.pose[1].isApprox(pose_from_yaw_pitch_roll({1, 2, -4}, -pi / 2, 0, 0), 1e-15));
}

TEST(TrajectoryFile, reads_unit_quaternions_in_any_order_of_columns) {
  // The quaternion of yaw 90 degrees is (0, 0, sin 45, cos 45).
  const auto t = load_trajectory(
      own_file("t.csv", "qw,qx,qy,qz,time_s,x_m,y_m,z_m\n0.7071,0,0,0.7071,0,1,2,3\n-0.7071,0,0,-0.7071,1,1,2,3\n"));
  const Pose port = pose_from_yaw_pitch_roll({1, 2, 3}, pi / 2, 0, 0);
  EXPECT_TRUE(t.pose[0].isApprox(port, 1e-12));
  EXPECT_TRUE(t.pose[1].isApprox(port, 1e-12));
}

// Two entries, yaw 0 and 360, are no turn, and say so; entries less than half a turn apart are one.
TEST(TrajectoryFile, a_change_of_half_a_turn_is_the_shortest_one_and_noted) {
  const std::string still = own_file("still.csv", angles + "0,0,0,0,0,0,0\n4,0,0,0,360,0,0\n");
  EXPECT_TRUE(pose_at(load_trajectory(still), 1).isApprox(Pose::Identity(), 1e-12));
  ASSERT_EQ(trajectory_notes(still).size(), 1U);
  EXPECT_THAT(trajectory_notes(still)[0],
              AllOf(HasSubstr("still.csv:3: yaw_deg goes from 0 to 360, taken as the shortest turn, 0 degrees"),
                    HasSubstr("less than half a turn apart")));
  const std::string turn =
      own_file("turn.csv", angles + "0,0,0,0,0,0,0\n1,0,0,0,120,0,0\n2,0,0,0,240,0,0\n3,0,0,0,360,0,0\n");
  EXPECT_TRUE(trajectory_notes(turn).empty());
  EXPECT_TRUE(pose_at(load_trajectory(turn), 1.5).isApprox(pose_from_yaw_pitch_roll({0, 0, 0}, pi, 0, 0), 1e-12));
  // A compass goes through north the short way.
  const std::string north = own_file("north.csv", angles + "0,0,0,0,359,0,0\n1,0,0,0,1,0,0\n2,0,0,0,357,0,0\n");
  EXPECT_TRUE(pose_at(load_trajectory(north), 0.5).isApprox(Pose::Identity(), 1e-12));
  EXPECT_THAT(trajectory_notes(north)[0], AllOf(HasSubstr("shortest turn, 2 degrees"), HasSubstr("(and 1 more)")));
  EXPECT_TRUE(trajectory_notes(own_file("q.csv", quaternions + "0,0,0,0,0,0,0,1\n1,0,0,0,0,0,1,0\n")).empty());
}

TEST(TrajectoryFile, names_line_column_value_and_rule) {
  refuses_way(angles + "0,0,0,0,0,0,0\n0,0,0,0,0,0,0\n", "3: time_s = 0 s, must be later than the previous line, 0 s");
  refuses_way(angles + "0,0,0,0,0,1000,0\n", "2: pitch_deg = 1000 degrees, must be within -360 and 360");
  refuses_way(quaternions + "0,0,0,0,0,0,0,2\n", "2: length of (qx, qy, qz, qw) = 2, must be 1 within 0.001");
  refuses_way(angles + "0,0,nan,0,0,0,0\n", "2: y_m = 'nan', must be a finite number");
  refuses_way("time_s,x_m,y_m,z_m,yaw_deg,pitch_deg\n", "1: missing column 'roll_deg'");
  refuses_way("time,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n", "1: unknown column 'time'; did you mean 'time_s'?");
  refuses_way(angles + "0,0,0,0,0,0,0\n", " has 1 entries, must have at least two");
}
