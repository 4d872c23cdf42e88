// SPDX-License-Identifier: BSD-3-Clause
// The head of the viewer, moved by keys, and its option.
#include "support/test.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify::viewer_head_tests {

ViewerState inspecting() {
  ViewerState state;
  state.mode = ViewerMode::inspect;
  state.head.position = {1, 2, -3};
  return state;
}

TEST(ViewerHead, moves_along_its_own_heading) {
  ViewerState state = inspecting();
  state.stride = 2;
  const auto moved = [&](const char* key) -> Eigen::Vector3d {
    return apply_key(state, key, {}).state.head.position - state.head.position;
  };
  EXPECT_TRUE(moved("Up").isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_TRUE(moved("Left").isApprox(Eigen::Vector3d(0, 2, 0)));  // port is y
  EXPECT_TRUE(moved("Prior").isApprox(Eigen::Vector3d(0, 0, 2)));
  state.head.yaw = radians(90);  // faces y
  EXPECT_TRUE(moved("Up").isApprox(Eigen::Vector3d(0, 2, 0), 1e-12));
  EXPECT_TRUE(moved("Right").isApprox(Eigen::Vector3d(2, 0, 0), 1e-12));
  state.head.pitch = radians(60);  // horizontal nevertheless
  EXPECT_TRUE(moved("Down").isApprox(Eigen::Vector3d(0, -2, 0), 1e-12));
}

TEST(ViewerHead, turns_the_way_the_arrows_point) {
  const ViewerState state = inspecting();
  const double turn = radians(5);  // 10 degrees per metre of a stride of 0.5 m
  EXPECT_NEAR(apply_key(state, "shift+Left", {}).state.head.yaw, turn, 1e-12);   // to port
  EXPECT_NEAR(apply_key(state, "shift+Up", {}).state.head.pitch, -turn, 1e-12);  // nose up
  EXPECT_NEAR(apply_key(state, "shift+Prior", {}).state.head.roll, turn, 1e-12);
  ViewerState up = state;
  for (int i = 0; i < 100; ++i) up = apply_key(up, "shift+Up", {}).state;
  EXPECT_NEAR(up.head.pitch, -pi / 2, 1e-12);
}

TEST(ViewerHead, there_and_back_is_where_it_was) {
  const ViewerState state = inspecting();
  const std::pair<const char*, const char*> pairs[] = {{"Up", "Down"},
                                                       {"Left", "Right"},
                                                       {"Prior", "Next"},
                                                       {"shift+Left", "shift+Right"},
                                                       {"shift+Up", "shift+Down"},
                                                       {"shift+Prior", "shift+Next"},
                                                       {"comma", "period"}};
  for (const auto& [there, back] : pairs) {
    const ViewerState result = apply_key(apply_key(state, there, {}).state, back, {}).state;
    EXPECT_TRUE(pose_of(result.head).isApprox(pose_of(state.head), 1e-12)) << there;
    EXPECT_DOUBLE_EQ(result.stride, state.stride) << there;
  }
}

TEST(ViewerHead, place_is_the_inverse_of_pose) {
  for (const double yaw : {-170.0, -30.0, 0.0, 95.0})
    for (const double pitch : {-90.0, -40.0, 0.0, 90.0})
      for (const double roll : {-120.0, 0.0, 30.0}) {
        const Pose pose = pose_from_yaw_pitch_roll({1, 2, 3}, radians(yaw), radians(pitch), radians(roll));
        EXPECT_TRUE(pose_of(pose_angles(pose)).isApprox(pose, 1e-9)) << yaw << " " << pitch << " " << roll;
      }
}

TEST(ViewerHead, its_option_reads_as_a_person_writes_it) {
  PoseAngles head;
  head.position = {-1, 4.25, -2.2};
  head.pitch = radians(15);
  head.yaw = -1e-9;
  EXPECT_EQ(pose_option(head), "--pose=-1,4.25,-2.2,0,15,0");
}

TEST(ViewerHead, of_a_mounted_sonar_says_the_pose_of_the_vehicle) {
  const Pose vehicle = pose_from_yaw_pitch_roll({1, 2, -3}, radians(30), radians(5), radians(-4));
  ViewerData data;
  EXPECT_EQ(vehicle_position(data, pose_angles(vehicle)), pose_angles(vehicle));
  data.vehicle_from_head = pose_from_yaw_pitch_roll({0.5, 0, -0.2}, 0, radians(90), radians(7));
  const PoseAngles said = vehicle_position(data, pose_angles(vehicle * data.vehicle_from_head));
  EXPECT_TRUE(pose_of(said).isApprox(vehicle, 1e-9));
}

}  // namespace insonify::viewer_head_tests
