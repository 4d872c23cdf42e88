// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/motion.hpp"

#include "acoustics/direct_echoes.hpp"
#include "support/point_targets.hpp"
#include "support/test.hpp"

namespace insonify::motion_tests {

constexpr double frequency = 900e3;
const Medium medium{c0, {0, 0, 0}};

Echoes echoes_of(const Scatterers& s) {
  Echoes echoes = insonify::echoes_of(s, pulse_900k, clear_water());
  echoes.v.assign(s.size(), 0);
  return echoes;
}

Echoes moved(const Motion& motion, const Scatterers& s, const Pose& pose = Pose::Identity()) {
  Echoes echoes = echoes_of(s);
  move_echoes(motion, pose, s, frequency, c0, echoes);
  return echoes;
}

const Scatterers ahead = scatterers_at({{30, 0, 0}});
const Scatterers spread = scatterers_at({{30, 5, -4}, {7, -6, 2}, {80, 1, 10}});

Trajectory bent_track() {
  return {{0, 2, 3},
          {pose_from_yaw_pitch_roll({0, 0, 0}, 0, 0, 0), pose_from_yaw_pitch_roll({4, 0, -1}, 0.5, 0, 0),
           pose_from_yaw_pitch_roll({4, 3, -1}, 0.5, 0.2, 0)}};
}

TEST(MoveEchoes, leaves_echoes_of_a_head_at_rest_as_they_are) {
  const Echoes before = echoes_of(spread), after = moved({}, spread);
  EXPECT_EQ(before.delay, after.delay);
  EXPECT_EQ(before.u, after.u);
  EXPECT_EQ(before.amplitude, after.amplitude);
  EXPECT_TRUE(after.doppler.empty());
}

// The head approaches during propagation: c0 t = r + (r - v t), so t = 2 r / (c0 + v).
TEST(MoveEchoes, accounts_for_an_approaching_head) {
  for (const double v : {2.0, -2.0, 14.0}) {
    const Echoes e = moved({{v, 0, 0}, {0, 0, 0}}, ahead);
    const double r0 = 30, r1 = 30 * (c0 - v) / (c0 + v);
    EXPECT_NEAR(e.delay[0], 2 * r0 / (c0 + v), 1e-17);
    EXPECT_NEAR(e.doppler[0] / (frequency * 2 * v / (c0 - v)), 1, 1e-14);
    const auto before = echoes_of(ahead).amplitude[0];
    EXPECT_NEAR(std::abs(e.amplitude[0] / before), r0 / r1, 1e-14);
    EXPECT_NEAR(std::abs(std::polar(1.0, 2 * pi * frequency / c0 * (r1 - r0)) - e.amplitude[0] / before * (r1 / r0)), 0,
                1e-9);
    EXPECT_EQ(e.u[0], 0);
  }
  EXPECT_NEAR(moved({{2, 0, 0}, {0, 0, 0}}, ahead).doppler[0], 2400, 4);  // 2 v f / c0
}

TEST(MoveEchoes, tends_to_rest_as_motion_vanishes) {
  const Echoes rest = echoes_of(spread);
  for (const double v : {1e-3, 1e-6, 1e-9}) {
    const Echoes e = moved({{v, -v, 0.5 * v}, {0, v, v}}, spread);
    for (std::size_t i = 0; i < spread.size(); ++i) {
      EXPECT_NEAR(e.delay[i], rest.delay[i], 3 * v / c0 * rest.delay[i] + 1e-17);
      EXPECT_NEAR(e.u[i], rest.u[i], 2 * v);
      EXPECT_NEAR(std::abs(e.amplitude[i] / rest.amplitude[i] - 1.0), 0,
                  2 * pi * frequency * 3 * v / c0 * rest.delay[i] + 1e-12);
      EXPECT_NEAR(e.doppler[i], 0, frequency * 4 * v / c0);
    }
  }
}

TEST(MoveEchoes, solves_the_two_way_equation_wherever_the_head_goes) {
  const Motion motion{{3, -7, 2}, {0, 0, 0}};
  const Echoes e = moved(motion, spread);
  for (std::size_t i = 0; i < spread.size(); ++i) {
    const Eigen::Vector3d d = spread.range[i] * unit_vector({spread.azimuth[i], spread.elevation[i]});
    const double back = (d - motion.velocity * e.delay[i]).norm();
    EXPECT_NEAR(c0 * e.delay[i], d.norm() + back, 1e-12);
    EXPECT_NEAR(e.u[i], (d - motion.velocity * e.delay[i]).y() / back, 1e-15);
    EXPECT_NEAR(e.v[i], (d - motion.velocity * e.delay[i]).z() / back, 1e-15);
  }
}

// Sound that leaves a little later, from where the head is then, arrives later by 1 / (1 + doppler / f).
TEST(MoveEchoes, shifts_the_carrier_by_the_rate_of_the_delay) {
  const Eigen::Vector3d velocity(6, -9, 3), target(20, 12, -5);
  const auto arrival = [&](double leaves) {
    const Scatterers s = scatterers_at({target - velocity * leaves});
    return leaves + moved({velocity, {0, 0, 0}}, s).delay[0];
  };
  const double h = 1e-3, rate = (arrival(h) - arrival(-h)) / (2 * h);
  const double doppler = moved({velocity, {0, 0, 0}}, scatterers_at({target})).doppler[0];
  EXPECT_NEAR(frequency * (1 / rate - 1), doppler, 1e-4 * std::abs(doppler));
}

TEST(MoveEchoes, turns_directions_only_when_the_head_turns_only) {
  const double rate = 0.8;
  const Echoes rest = echoes_of(spread), e = moved({{0, 0, 0}, {0, 0, rate}}, spread);
  for (std::size_t i = 0; i < spread.size(); ++i) {
    EXPECT_EQ(e.delay[i], rest.delay[i]);
    EXPECT_EQ(e.amplitude[i], rest.amplitude[i]);
    EXPECT_EQ(e.doppler[i], 0);
    // Yaw to port by rate x delay: bearings fall by it.
    EXPECT_NEAR(e.u[i], std::cos(spread.elevation[i]) * std::sin(spread.azimuth[i] - rate * e.delay[i]), 1e-15);
    EXPECT_NEAR(e.v[i], std::sin(spread.elevation[i]), 1e-15);
  }
}

TEST(MoveEchoes, fills_directions_upwards_only_where_they_are_needed) {
  Echoes echoes = echoes_of(spread);
  echoes.v.clear();
  move_echoes({{1, 0, 0}, {0, 0, 0}}, Pose::Identity(), spread, frequency, c0, echoes);
  EXPECT_TRUE(echoes.v.empty());
}

TEST(MoveEchoes, does_not_change_when_world_and_motion_turn_together) {
  const Motion motion{{1, 2, -0.5}, {0.1, -0.2, 0.6}};
  const Echoes plain = moved(motion, spread);
  const Pose pose = pose_from_yaw_pitch_roll({1e6, -4e5, 30}, 2.1, 0.4, -1);
  const Echoes turned = moved({pose.linear() * motion.velocity, pose.linear() * motion.turn_rate}, spread, pose);
  for (std::size_t i = 0; i < spread.size(); ++i) {
    EXPECT_NEAR(plain.delay[i], turned.delay[i], 1e-16);
    EXPECT_NEAR(plain.u[i], turned.u[i], 1e-14);
    EXPECT_NEAR(plain.v[i], turned.v[i], 1e-14);
    EXPECT_NEAR(plain.doppler[i], turned.doppler[i], 1e-8);
    EXPECT_NEAR(std::abs(plain.amplitude[i] / turned.amplitude[i] - 1.0), 0, 1e-9);
  }
}

TEST(MoveEchoes, refuses_large_and_bad_values) {
  Echoes e = echoes_of(spread);
  const auto call = [&](const Motion& m, double f = frequency) {
    return error_of([&] { move_echoes(m, Pose::Identity(), spread, f, c0, e); });
  };
  EXPECT_EQ(call({{15, 0, 0}, {0, 0, 0}}),
            "move_echoes: motion.velocity = 15 m/s, must be below a hundredth of the sound speed, 15 m/s");
  EXPECT_EQ(call({{NAN, 0, 0}, {0, 0, 0}}), "move_echoes: motion.velocity = nan   0   0 m/s, must be finite");
  EXPECT_EQ(
      call({{0, 0, 0}, {0, 0, 101}}),
      "move_echoes: motion.turn_rate =   0   0 101 rad/s, must be finite and at most 100 rad/s (is it in degrees?)");
  EXPECT_NE(call({{0, 0, 0}, {0, INFINITY, 0}}), "no error");
  EXPECT_EQ(call({}, 0), "move_echoes: centre_frequency = 0 Hz, must be finite and > 0");
  e.delay.pop_back();
  EXPECT_EQ(call({{1, 0, 0}, {0, 0, 0}}), "move_echoes: 2 echoes, but 3 scatterers");
}

TEST(Trajectory, gives_its_poses_and_lines_between_them) {
  const Trajectory way = bent_track();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(pose_at(way, way.time[i]).isApprox(way.pose[i], 1e-14)) << i;
  EXPECT_TRUE(pose_at(way, 0.5).isApprox(pose_from_yaw_pitch_roll({1, 0, -0.25}, 0.125, 0, 0), 1e-14));
}

TEST(Trajectory, moves_as_its_poses_do) {
  const Trajectory way = bent_track();
  for (const double time : {0.3, 1.999, 2.0, 2.7, 3.0}) {
    const Motion motion = motion_at(way, time);
    const double from = time < 2 ? 0.1 : 2.2, h = 0.3;
    const Pose a = pose_at(way, from), b = pose_at(way, from + h);
    EXPECT_NEAR((a.translation() + h * motion.velocity - b.translation()).norm(), 0, 1e-14);
    const Eigen::AngleAxisd turn(h * motion.turn_rate.norm(), motion.turn_rate.normalized());
    EXPECT_NEAR((turn.toRotationMatrix() * a.linear() - b.linear()).norm(), 0, 1e-14);
  }
}

TEST(Trajectory, takes_the_shortest_turn) {
  const Trajectory way{{0, 1},
                       {pose_from_yaw_pitch_roll({0, 0, 0}, radians(170), 0, 0),
                        pose_from_yaw_pitch_roll({0, 0, 0}, radians(-170), 0, 0)}};
  EXPECT_NEAR(motion_at(way, 0.5).turn_rate.z(), radians(20), 1e-14);
  EXPECT_TRUE(pose_at(way, 0.5).isApprox(pose_from_yaw_pitch_roll({0, 0, 0}, pi, 0, 0), 1e-12));
}

TEST(Trajectory, is_refused_with_entry_value_and_rule) {
  const auto text = [](const Trajectory& t) { return error_of([&] { require_valid(t, "test"); }); };
  Trajectory t = bent_track();
  EXPECT_EQ(text(t), "no error");
  EXPECT_EQ(error_of([&] { pose_at(t, 3.5); }), "pose_at: time = 3.5 s, must be within the trajectory's 0 and 3 s");
  EXPECT_NE(error_of([&] { motion_at(t, NAN); }), "no error");
  t.time[1] = 0;
  EXPECT_EQ(text(t), "test: trajectory: time[1] = 0 s, must be later than the entry before it, 0 s");
  t = bent_track();
  t.pose[2].linear() *= 1.01;
  EXPECT_EQ(text(t), "test: trajectory: pose[2] must be finite, its rotation orthonormal");
  t.pose.pop_back();
  EXPECT_EQ(text(t), "test: trajectory has 3 times, but 2 poses");
  EXPECT_EQ(text({{0}, {Pose::Identity()}}), "test: trajectory has 1 entries, must have two at least");
}

}  // namespace insonify::motion_tests
