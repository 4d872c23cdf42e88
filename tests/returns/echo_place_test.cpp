// SPDX-License-Identifier: BSD-3-Clause
#include "returns/echo_place.hpp"

#include "acoustics/motion.hpp"
#include "core/units.hpp"
#include "support/test.hpp"

namespace {

constexpr double water = 1480;

/// A ping of a head that moves and turns, and a scatterer that it receives.
struct Heard {
  Ping ping;
  Eigen::Vector3d to_scatterer;  // vector from the head at transmission, world [m]
  double range = 0;              // c T / 2
  Eigen::Vector3d direction;     // head axes at reception
};

/// Solves the definition of a delay by bisection: sound leaves the head, and meets it again where it is then.
Heard beam_azimuth(const Eigen::Vector3d& to_scatterer, const Motion& motion) {
  Heard h;
  h.ping.world_from_head = pose_from_yaw_pitch_roll({530000, -20, -7}, 2.1, 0.7, -0.3);
  h.ping.motion = motion;
  h.to_scatterer = to_scatterer;
  const auto excess = [&](double t) {
    return to_scatterer.norm() + (to_scatterer - motion.velocity * t).norm() - water * t;
  };
  double low = 0, high = 3 * to_scatterer.norm() / water;
  for (int k = 0; k < 200; ++k) (excess(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  h.range = 0.5 * water * low;
  const double turn = motion.turn_rate.norm();
  Eigen::Matrix3d axes = h.ping.world_from_head.linear();
  if (turn > 0) axes = Eigen::AngleAxisd(turn * low, motion.turn_rate / turn) * axes;
  h.direction = axes.transpose() * (to_scatterer - motion.velocity * low).normalized();
  return h;
}

}  // namespace

TEST(EchoPlace, is_where_a_moving_and_turning_head_hears_it_from) {
  for (const Motion& motion : {Motion{}, Motion{{0.3, -4, 1.2}, Eigen::Vector3d::Zero()},
                               Motion{Eigen::Vector3d::Zero(), {0.4, -0.1, 0.2}}, Motion{{9, 5, -8}, {2, 1, -3}}})
    for (const Eigen::Vector3d& to : {Eigen::Vector3d(60, -5, -20), Eigen::Vector3d(0.01, 0.3, 0.2)}) {
      const Heard h = beam_azimuth(to, motion);
      const Eigen::Vector3d way = way_of_echo(h.ping, h.direction, h.range, water);
      EXPECT_LT((way - to).norm() / to.norm(), 1e-12) << motion.velocity.transpose();
      const Eigen::Vector3d sent = h.ping.world_from_head.linear().transpose() * to.normalized();
      EXPECT_NEAR(distance_of_echo(h.ping, sent, h.range, water) / to.norm(), 1, 1e-12);
    }
}

// A line array resolves the cone about itself when it receives; elevation is that of the pulse that was sent.
TEST(EchoPlace, beams_have_the_elevation_that_was_sent_and_the_cone_that_was_heard) {
  for (const Motion& motion :
       {Motion{}, Motion{{0.3, -4, 1.2}, Eigen::Vector3d::Zero()}, Motion{{9, 5, -8}, {2, 1, -3}}})
    for (const Eigen::Vector3d& to : {Eigen::Vector3d(-30, 10, -20), Eigen::Vector3d(-3, 8, 5)}) {
      Heard h = beam_azimuth(to, motion);
      const Eigen::Vector3d sent = h.ping.world_from_head.linear().transpose() * to.normalized();
      const double elevation = std::asin(sent.z()), along = std::asin(h.direction.y() / std::cos(elevation));
      h.ping.fan.azimuth = {0, sent.x() < 0 ? pi - along : along};
      h.ping.fan.elevation = {0, elevation};
      EXPECT_LT((way_of_beam(h.ping, 1, h.range, water) - to).norm() / to.norm(), 1e-9) << motion.velocity.transpose();
      h.ping.fan.row_width = 0.1;  // a planar array hears the elevation, too
      const Eigen::Vector3d axis = unit_vector({h.ping.fan.azimuth[1], elevation});
      EXPECT_EQ(way_of_beam(h.ping, 1, h.range, water), way_of_echo(h.ping, axis, h.range, water));
    }
}

TEST(EchoPlace, needs_the_sound_speed) {
  const Ping ping;
  EXPECT_EQ(error_of([&] { way_of_echo(ping, {1, 0, 0}, 5, 0); }), "way_of_echo: sound_speed = 0 m/s, must be > 0");
  EXPECT_EQ(error_of([&] {
              distance_of_echo(ping, {1, 0, 0}, 5, 0);
            }),
            "distance_of_echo: sound_speed = 0 m/s, must be > 0");
}
