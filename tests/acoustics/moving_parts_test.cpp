// SPDX-License-Identifier: BSD-3-Clause
// Compares moving parts with closed forms and with a referee that solves the two ways of sound by iteration, in long
// double, from positions alone.
#include "acoustics/moving_parts.hpp"

#include <cmath>

#include "acoustics/direct_stream.hpp"
#include "core/units.hpp"
#include "scene/posed_scene.hpp"
#include "support/errors.hpp"
#include "support/point_targets.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify::moving_parts_tests {

using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

constexpr double frequency = 900e3;
const Transmission sent{pulse_900k, clear_water(), {.amplitude = SurfaceAmplitude::coherent}};

/// Head and scatterer on straight ways from time 0.
struct Ways {
  LongVector head_speed, scatterer, scatterer_speed;

  /// Returns the time at which sound sent at `time` meets the scatterer, and the time of its return.
  std::pair<long double, long double> times(long double time) const {
    const LongVector from = head_speed * time;
    long double met = time, back = time;
    for (int i = 0; i < 60; ++i) met = time + (scatterer + scatterer_speed * met - from).norm() / c0;
    const LongVector there = scatterer + scatterer_speed * met;
    for (int i = 0; i < 60; ++i) back = met + (there - head_speed * back).norm() / c0;
    return {met, back};
  }
  /// Returns the shift of the carrier by the rate at which times of reception follow those of transmission.
  double doppler() const {
    const long double step = 1e-4L, rate = (times(step).second - times(-step).second) / (2 * step);
    return static_cast<double>(frequency * (1 / rate - 1));
  }
};

/// Returns a sphere of 5 cm about `at`.
PlacedPart sphere_at(const Vector3d& at, const Vector3d& velocity, const Vector3d& turn_rate = Vector3d::Zero()) {
  static const auto cloud = [] {
    SceneCloud ball;
    add_sphere(ball, {0, 0, 0}, 0.05, 200);
    return std::make_shared<const SceneCloud>(ball);
  }();
  PlacedPart part{.name = "sphere", .cloud = cloud};
  part.world_from_part = pose_from_yaw_pitch_roll(at, 0.4, 0.1, 0);
  part.velocity = velocity, part.turn_rate = turn_rate;
  return part;
}

/// Returns all surfels of a scene as scatterers of a head.
Scatterers patches_of(const SceneCloud& scene, const Pose& pose) {
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const ScenePart& part = *scene.part_of_surfel(i);
    positions.push_back(pose.inverse() * (part.world_from_part * world(*part.own, scene.id[i])));
  }
  Scatterers s = scatterers_at(positions);
  for (std::uint32_t i = 0; i < s.size(); ++i) s.surfel[i] = i;
  return s;
}

struct Case {
  const char* name;
  Vector3d part, head, turn_rate{0, 0, 0}, head_turn{0, 0, 0};
};
const Case cases[] = {{"towards", {-2, 0, 0}, {0, 0, 0}},
                      {"away", {2, 0, 0}, {0, 0, 0}},
                      {"across", {0, 2, 0}, {0, 0, 0}},
                      {"together", {1.2, 1.5, -0.3}, {1.2, 1.5, -0.3}},
                      {"head_alone", {0, 0, 0}, {1, -1, 0.2}},
                      {"against", {-2, 1, 0}, {3, 0, 0.5}, {0, 0, 0}, {0, 0, 0.5}},
                      {"tumbling", {-1, 0, 0.5}, {1, 0, 0}, {3, -8, 2}}};

TEST(MovingParts, arrive_when_and_with_the_pitch_that_the_ways_of_sound_have) {
  const Pose pose = pose_from_yaw_pitch_roll({100, -40, -7}, 0.7, 0.2, 0.1);
  for (const Case& c : cases) {
    const SceneCloud scene = merge_parts(std::vector{sphere_at({112, -33, -9}, c.part, c.turn_rate)});
    const Scatterers still = patches_of(scene, pose);
    Scatterers met = still;
    const Echoes echoes = echoes_in_motion(scene, met, pose, {{c.head, c.head_turn}, moves(scene)}, sent);
    for (std::size_t i = 0; i < scene.size(); i += 7) {
      const ScenePart& part = scene.parts.front();
      const Vector3d position = part.world_from_part * world(*part.own, scene.id[i]);
      const Vector3d speed = c.part + c.turn_rate.cross(Vector3d(position - part.world_from_part.translation()));
      const Ways ways{c.head.cast<long double>(), (position - pose.translation()).cast<long double>(),
                      speed.cast<long double>()};
      const auto [there, back] = ways.times(0);
      EXPECT_NEAR(0.5 * c0 * (echoes.delay[i] - static_cast<double>(back)), 0, 1e-8) << c.name;  // 0.01 mm asked
      EXPECT_NEAR(echoes.doppler_of(i), ways.doppler(), 1e-4) << c.name;                         // 0.01 Hz asked
      EXPECT_NEAR(met.range[i], c0 * static_cast<double>(there), 1e-8) << c.name;

      // Spreading and carrier phase over both ways.
      const double out = c0 * static_cast<double>(there), in = c0 * static_cast<double>(back - there);
      const std::complex<double> expected = std::polar(
          source_pressure(pulse_900k) * std::sqrt(scene.materials[0].lambert_mu * still.projected_area[i]) / (out * in),
          2 * pi * std::remainder(frequency / c0 * (out + in), 1.0));
      EXPECT_LT(std::abs(echoes.amplitude[i] / expected - 1.0), 1e-4) << c.name;
    }
  }
}

TEST(MovingParts, have_the_closed_forms_of_a_target_straight_ahead) {
  for (const double v : {2.0, -2.0}) {
    SceneCloud one;
    add_surfel(one, {0, 0, 0}, {-1, 0, 0}, 1e-4);
    PlacedPart part{.name = "one", .cloud = std::make_shared<SceneCloud>(one)};
    part.world_from_part.translation() = Vector3d(30, 0, 0), part.velocity = {-v, 0, 0};
    const SceneCloud scene = merge_parts(std::vector{part});
    Scatterers s = patches_of(scene, Pose::Identity());
    const Echoes e = echoes_in_motion(scene, s, Pose::Identity(), {{}, true}, sent);
    EXPECT_NEAR(e.delay[0], 2 * 30 / (c0 + v), 1e-15);
    EXPECT_NEAR(e.doppler[0], frequency * ((c0 + v) / (c0 - v) - 1), 1e-8);
  }
}

TEST(MovingParts, have_edges_that_come_and_go_when_a_plate_turns) {
  SceneCloud plate_cloud = plate(0, 1, 21);
  PlacedPart part{.name = "plate", .cloud = std::make_shared<SceneCloud>(plate_cloud)};
  part.world_from_part.translation() = Vector3d(20, 0, 0);
  part.turn_rate = {0, 0, 2};
  const SceneCloud scene = merge_parts(std::vector{part});
  Scatterers s = patches_of(scene, Pose::Identity());
  const Echoes e = echoes_in_motion(scene, s, Pose::Identity(), {{}, true}, sent);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    // The surfel at y comes at 2 y [m/s] on the port side, and goes on the other.
    const Vector3d position = world(scene, i);
    const double closing = 2 * position.y() * 20 / position.norm();
    EXPECT_NEAR(e.doppler[i], 2 * frequency / c0 * closing, 2.5);  // of (v/c)^2 f: 0.4 Hz, and what it moves meanwhile
    EXPECT_GE(std::abs(e.doppler[i]), 2200 * std::abs(position.y()));
  }
}

TEST(MovingParts, rest_where_nothing_moves) {
  const SceneCloud scene = merge_parts(std::vector{sphere_at({12, 1, -1}, {0, 0, 0})});
  Scatterers s = patches_of(scene, Pose::Identity());
  const std::vector<double> range = s.range;
  EXPECT_TRUE(meet_moving_parts(scene, Pose::Identity(), c0, s).empty());
  EXPECT_EQ(s.range, range);
}

TEST(MovingParts, are_refused_at_a_hundredth_of_the_speed_of_sound) {
  const SceneCloud scene = merge_parts(std::vector{sphere_at({12, 1, -1}, {15.5, 0, 0})});
  Scatterers s = patches_of(scene, Pose::Identity());
  EXPECT_EQ(error_of([&] { meet_moving_parts(scene, Pose::Identity(), c0, s); }),
            "part 'sphere': a surfel moves at 15.5 m/s, must be below a hundredth of the sound speed, 15 m/s");
}

}  // namespace insonify::moving_parts_tests
