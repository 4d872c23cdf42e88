// SPDX-License-Identifier: BSD-3-Clause
// Tests pings of scenes that are made of parts.
#include <cmath>
#include <cstring>

#include "core/units.hpp"
#include "scene/posed_scene.hpp"
#include "support/heads.hpp"
#include "support/point_targets.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::parts_ping_tests {

using Eigen::Vector3d;

std::shared_ptr<const SceneCloud> shared(const SceneCloud& cloud) { return std::make_shared<const SceneCloud>(cloud); }

std::shared_ptr<const SceneCloud> ball(double radius, int count, double relief = 0) {
  SceneCloud cloud;
  cloud.materials = {{.name = "steel", .lambert_mu = 0.02, .relief_slope = relief}};
  add_sphere(cloud, {0, 0, 0}, radius, count);
  return shared(cloud);
}

/// Returns a box without bottom, 0.6 x 0.4 x 0.3 m, of surfels of 1 cm.
std::shared_ptr<const SceneCloud> box() {
  SceneCloud cloud;
  cloud.materials = {{.name = "concrete", .lambert_mu = 0.01, .relief_slope = 0.2}};
  const double x = 0.3, y = 0.2, z = 0.3;
  add_rectangle(cloud, {-x, -y, 0}, {0, 2 * y, 0}, {0, 0, z}, {-1, 0, 0}, 0.01, 0.3);
  add_rectangle(cloud, {x, -y, 0}, {0, 2 * y, 0}, {0, 0, z}, {1, 0, 0}, 0.01, 0.3);
  add_rectangle(cloud, {-x, -y, 0}, {2 * x, 0, 0}, {0, 0, z}, {0, -1, 0}, 0.01, 0.3);
  add_rectangle(cloud, {-x, y, 0}, {2 * x, 0, 0}, {0, 0, z}, {0, 1, 0}, 0.01, 0.3);
  add_rectangle(cloud, {-x, -y, z}, {2 * x, 0, 0}, {0, 2 * y, 0}, {0, 0, 1}, 0.01, 0.3);
  return shared(cloud);
}

PlacedPart bed() {
  static const auto cloud = [] {
    SceneCloud floor;
    floor.materials = {{.name = "sand", .relief_slope = 0.1}};
    add_floor(floor, {1, -5, -4}, 200, 0.05);
    return shared(floor);
  }();
  return {.name = "bed", .cloud = cloud, .captured = true};
}

PlacedPart placed(const std::string& name, std::shared_ptr<const SceneCloud> cloud, const Vector3d& at,
                  double yaw = 0) {
  PlacedPart part{.name = name, .cloud = std::move(cloud)};
  part.world_from_part = pose_from_yaw_pitch_roll(at, yaw, 0, 0);
  return part;
}

const double speed = sound_speed(Water{});

const SonarHead& head() {
  static const SonarHead small = small_head({.beams = 48, .field_of_view_deg = 60, .max_range = 12}, speed);
  return small;
}

const PingEvent from_above{pose_from_yaw_pitch_roll({0, 0, -1}, 0, radians(25), 0)};

SimulatedPing event_ping(const SceneCloud& scene, const PingEvent& event = from_above,
                         const SimulationOptions& o = {}) {
  return simulate_event(scene, head(), event, Environment{}, o);
}

bool same_bytes(const SimulatedPing& a, const SimulatedPing& b) {
  const auto &x = a.ping.pressure, &y = b.ping.pressure;
  return x.size() == y.size() &&
         std::memcmp(x.data(), y.data(), sizeof(x.data()[0]) * static_cast<std::size_t>(x.size())) == 0;
}

TEST(PingOfParts, is_that_of_the_same_surfels_merged_by_hand) {
  const SceneCloud parts = merge_parts(
      std::vector{bed(), placed("box", box(), {5, 0.5, -4}, 0.4), placed("ball", ball(0.3, 4000), {4, -1, -3.5})});
  SceneCloud by_hand = parts;
  by_hand.part.clear(), by_hand.parts.clear();
  for (std::uint32_t i = 0; i < by_hand.size(); ++i) by_hand.id[i] = i;
  SimulationOptions o;
  o.synthesis.method = SynthesisMethod::incoherent;
  o.sampling.scatterers_per_cell = 0;
  for (auto* scene : {&by_hand})
    for (Material& m : scene->materials) m.relief_slope = 0;
  SceneCloud smooth = parts;
  for (Material& m : smooth.materials) m.relief_slope = 0;
  const SimulatedPing a = event_ping(smooth, from_above, o), b = event_ping(by_hand, from_above, o);
  EXPECT_EQ(a.report.sampling.visible, b.report.sampling.visible);
  EXPECT_EQ(a.report.sampling.hidden, b.report.sampling.hidden);
  EXPECT_GT(a.report.sampling.hidden, 100U);
  const auto level = [](const SimulatedPing& p) { return p.ping.pressure.cast<std::complex<double>>().abs2().eval(); };
  const auto x = level(a), y = level(b);
  const double top = y.maxCoeff();
  EXPECT_NEAR(10 * std::log10(x.sum() / y.sum()), 0, 1e-5);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (y.data()[i] > 1e-4 * top) {
      EXPECT_NEAR(10 * std::log10(x.data()[i] / y.data()[i]), 0, 0.01);
    }
}

TEST(PingOfParts, has_the_same_bytes_in_any_order_and_with_one_more_part_out_of_view) {
  const PlacedPart a = bed(), b = placed("box", box(), {5, 0.5, -4}, 0.4),
                   c = placed("ball", ball(0.3, 4000), {4, -1, -3.5});
  const PlacedPart beyond = placed("far", ball(0.3, 4000), {40, 0, -2});
  const SimulatedPing one = event_ping(merge_parts(std::vector{a, b, c}));
  EXPECT_TRUE(same_bytes(one, event_ping(merge_parts(std::vector{c, a, b}))));
  EXPECT_TRUE(same_bytes(one, event_ping(merge_parts(std::vector{c, beyond, a, b}))));
  EXPECT_FALSE(same_bytes(one, event_ping(merge_parts(std::vector{a, b}))));

  // Place all parts but the bed anew for the ping.
  PosedScene posed(std::vector{a},
                   std::vector{b.cloud->materials[0], c.cloud->materials[0], beyond.cloud->materials[0]});
  const PingSimulator simulator(head(), Environment{});
  posed.pose(std::vector{placed("box", box(), {3, 1, -4})});
  EXPECT_TRUE(same_bytes(one, simulator.ping(*posed.pose(std::vector{beyond, c, b}), from_above)));
}

/// Returns the relative change of a ping by a rigid motion of part and head together.
double change_by_moving_all(const Pose& motion, const PlacedPart& part, const SimulationOptions& o = {}) {
  const PingEvent at{pose_from_yaw_pitch_roll({0.2, 0.1, 0.4}, 0.1, radians(5), 0.1), {{0.5, -0.2, 0}, {0, 0, 0.1}}};
  PingEvent moved = at;
  moved.world_from_head = motion * at.world_from_head;
  moved.motion = {motion.linear() * at.motion.velocity, motion.linear() * at.motion.turn_rate};
  PlacedPart there = part;
  there.world_from_part = motion * part.world_from_part;
  there.velocity = motion.linear() * part.velocity, there.turn_rate = motion.linear() * part.turn_rate;
  return relative_l2(event_ping(merge_parts(std::vector{there}), moved, o).ping.pressure,
                     event_ping(merge_parts(std::vector{part}), at, o).ping.pressure);
}

TEST(PingOfParts, hears_the_same_of_a_part_that_moves_together_with_the_head) {
  PlacedPart part = placed("box", box(), {6, 0.4, -0.2}, 0.7);
  part.velocity = {-1, 0.5, 0.2}, part.turn_rate = {0.1, 0.2, -0.4};
  EXPECT_LT(change_by_moving_all(pose_from_yaw_pitch_roll({3, -70, 12}, 0, 0, 0), part), 1e-5);
  EXPECT_LT(change_by_moving_all(pose_from_yaw_pitch_roll({400, -70, -900}, 2.1, 0.9, -0.6), part), 1e-5);
}

// Wide surfels are drawn as points of discs, which stand with their part (E228).
TEST(PingOfParts, draws_the_same_cells_of_a_part_that_moves_together_with_the_head) {
  SimulationOptions image;
  image.outputs.display_bins = 24;
  const PlacedPart coarse = placed("ball", ball(0.3, 60), {5, 0.4, -0.2}, 0.7);
  EXPECT_LT(change_by_moving_all(pose_from_yaw_pitch_roll({40, -70, -9}, 2.1, 0.9, -0.6), coarse, image), 1e-3);
}

TEST(PingOfParts, keeps_the_speckle_of_a_part_that_others_join) {
  const PlacedPart tyre = placed("tyre", ball(0.3, 4000, 0.1), {5, 0, -3.6});
  SimulationOptions o;
  o.outputs.scatterers = true;
  const auto of = [&](const std::vector<PlacedPart>& parts) {
    const SceneCloud scene = merge_parts(parts);
    std::map<std::uint64_t, float> area;
    const Scatterers s = event_ping(scene, from_above, o).outputs.scatterers;
    for (std::size_t i = 0; i < s.size(); ++i)
      if (scene.part_of_surfel(s.surfel[i])->name == "tyre") area[s.id[i]] = s.projected_area[i];
    return area;
  };
  const auto alone = of({tyre});
  EXPECT_GT(alone.size(), 1000U);
  EXPECT_EQ(alone, of({tyre, placed("other", ball(0.3, 4000), {5, 3, -3})}));
}

TEST(PingOfParts, shifts_the_carrier_by_the_motion_of_a_sphere) {
  SonarHead tone = single_beam({100e3, 200, 220}, 4, 16);
  tone.gate.bin_size = 0.02;
  const auto doppler = [&](const Vector3d& sphere, const Vector3d& moving_head) {
    PlacedPart part = placed("sphere", ball(0.05, 3000), {10, 0, 0});
    part.velocity = sphere;
    const auto p = simulate_event(merge_parts(std::vector{part}), tone, {Pose::Identity(), {moving_head, {0, 0, 0}}},
                                  Environment{}, {.amplitude = SurfaceAmplitude::coherent})
                       .ping.pressure;
    std::complex<double> turn = 0;
    for (Eigen::Index n = 1; n < p.cols(); ++n)
      turn += std::conj(std::complex<double>(p(0, n - 1))) * std::complex<double>(p(0, n));
    return -std::arg(turn) / (2 * pi) * speed / (2 * tone.gate.bin_size);
  };
  const double f = 100e3;
  // A pulse that fades over the sphere turns a little by itself.
  const double still = doppler({0, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(still, 0, 0.2);
  EXPECT_NEAR(doppler({-2, 0, 0}, {0, 0, 0}) - still, f * ((speed + 2) / (speed - 2) - 1), 0.01);
  EXPECT_NEAR(doppler({2, 0, 0}, {0, 0, 0}) - still, f * ((speed - 2) / (speed + 2) - 1), 0.01);
  EXPECT_NEAR(doppler({2, 0, 0}, {2, 0, 0}) - still, 0, 0.01);
  // Across, sound meets it after t = 10 m / c, and it has begun to go: 2 m/s x 2 t / 10 m.
  EXPECT_NEAR(doppler({0, 2, 0}, {0, 0, 0}) - still, -2 * f / speed * 4 / speed, 0.01);
}

TEST(PingOfParts, has_the_level_of_a_sphere_at_rest_where_sound_meets_the_moving_one) {
  SimulationOptions o;
  o.synthesis.method = SynthesisMethod::incoherent;
  const auto level = [&](const Vector3d& at, const Vector3d& velocity) {
    PlacedPart part = placed("sphere", ball(0.05, 2000), at);
    part.velocity = velocity;
    const auto ping = event_ping(merge_parts(std::vector{part}), {}, o).ping;
    return 10 * std::log10(ping.pressure.cast<std::complex<double>>().abs2().sum());
  };
  for (const Vector3d& v : {Vector3d(-2, 0, 0), Vector3d(2, 0, 0), Vector3d(0, 2, 0)})
    EXPECT_NEAR(level({6, 0, 0}, v), level(Vector3d(6, 0, 0) + v * 6 / speed, {0, 0, 0}), 0.02);
}

TEST(PingOfParts, leaves_motion_out_if_asked_to) {
  PlacedPart moving = placed("sphere", ball(0.05, 2000), {6, 0, 0}), still = moving;
  moving.velocity = {-2, 0, 0};
  SimulationOptions o;
  o.effects.moving = Choice::never;
  EXPECT_TRUE(same_bytes(event_ping(merge_parts(std::vector{moving}), {}, o),
                         event_ping(merge_parts(std::vector{still}), {}, o)));
  o.effects.moving = Choice::always;
  EXPECT_FALSE(same_bytes(event_ping(merge_parts(std::vector{moving}), {}, o),
                          event_ping(merge_parts(std::vector{still}), {}, o)));
}

TEST(PingOfParts, is_the_same_for_stored_and_streamed_echoes_and_any_threads) {
  PlacedPart moving = placed("ball", ball(0.3, 4000), {5, 0, -3.6}, 1);
  moving.velocity = {-2, 1, 0}, moving.turn_rate = {0, 0, 3};
  const SceneCloud scene = merge_parts(std::vector{bed(), moving});
  SimulationOptions stored, one_thread;
  stored.outputs.scatterers = true, one_thread.threads = 1;
  const SimulatedPing usual = event_ping(scene);
  EXPECT_TRUE(same_bytes(usual, event_ping(scene, from_above, one_thread)));
  EXPECT_LT(relative_l2(event_ping(scene, from_above, stored).ping.pressure, usual.ping.pressure), 1e-4);
}

}  // namespace insonify::parts_ping_tests
