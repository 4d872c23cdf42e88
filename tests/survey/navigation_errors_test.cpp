// SPDX-License-Identifier: BSD-3-Clause
#include "survey/navigation_errors.hpp"

#include "core/pose.hpp"
#include "core/units.hpp"
#include "support/test.hpp"

namespace {

const Trajectory long_way{
    {0, 1e5}, {pose_from_yaw_pitch_roll({0, 0, -3}, 0, 0, 0), pose_from_yaw_pitch_roll({1e5, 0, -3}, 0, 0, 0)}};

}  // namespace

// A first-order Gauss-Markov process has its deviation at every node and the correlation exp(-t / T) between two.
TEST(NavigationErrors, are_gauss_markov_processes_of_their_deviation_and_correlation_time) {
  const NavigationNoise noise{0.5, radians(2), radians(0.1), 20};
  const auto nodes = navigation_errors(long_way, noise, 3).nodes;
  const double n = static_cast<double>(nodes.size());
  ASSERT_GT(n, 49000);
  for (int c = 0; c < 6; ++c) {
    double variance = 0, lagged = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      variance += nodes[k][c] * nodes[k][c] / n;
      if (k >= 10) lagged += nodes[k][c] * nodes[k - 10][c] / n;
    }
    const double sigma = c < 3 ? 0.5 : c == 3 ? radians(2) : radians(0.1);
    EXPECT_NEAR(std::sqrt(variance) / sigma, 1, 0.06) << c;
    EXPECT_NEAR(lagged / variance, std::exp(-1), 0.06) << c;
  }
  double across = 0;
  for (const auto& node : nodes) across += node[0] * node[1] / n;
  EXPECT_NEAR(across / 0.25, 0, 0.06) << "components are independent";
}

TEST(NavigationErrors, depend_on_the_seed_alone_and_move_and_turn_the_pose) {
  const NavigationNoise noise{0.5, radians(2), radians(0.5), 20};
  const NavigationErrors errors = navigation_errors(long_way, noise, 3);
  EXPECT_EQ(errors.nodes[77], navigation_errors(long_way, noise, 3).nodes[77]);
  EXPECT_NE(errors.nodes[77], navigation_errors(long_way, noise, 4).nodes[77]);
  const Pose truth = pose_from_yaw_pitch_roll({100, 5, -3}, radians(40), 0, 0);
  const auto e = errors.nodes[50];
  const PoseAngles believed = pose_angles(believed_pose(errors, 100, truth));
  EXPECT_LT((believed.position - truth.translation() - e.head<3>()).norm(), 1e-12);
  EXPECT_NEAR(believed.yaw, radians(40) + e[3], 1e-3);
  EXPECT_NEAR(std::abs(believed.pitch), std::abs(e[4]), 1e-9);
  const Eigen::Vector3d between = believed_pose(errors, 101, truth).translation(),
                        after = believed_pose(errors, 102, truth).translation();
  EXPECT_LT((between - (believed.position + after) / 2).norm(), 1e-12) << "linear between nodes";
  EXPECT_TRUE(believed_pose({}, 7, truth).isApprox(truth, 0));
}

TEST(NavigationErrors, refuse_what_cannot_be) {
  EXPECT_THAT(error_of([] { navigation_errors(long_way, {0.1, 0, 0, 0}, 1); }), HasSubstr("correlation_time = 0 s"));
  EXPECT_THAT(error_of([] { navigation_errors(long_way, {0.1, 0, 0, 1e-3}, 1); }), HasSubstr("must be at least 0.1"));
  EXPECT_THAT(error_of([] { navigation_errors(long_way, {0.1, -1, 0, 1}, 1); }), HasSubstr("heading = -1"));
}
