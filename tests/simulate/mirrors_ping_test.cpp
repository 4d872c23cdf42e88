// SPDX-License-Identifier: BSD-3-Clause
// Tests mirrors through the whole signal path: ghosts and glints in a ping, in its plan, layers and outputs.
#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Vector3d;

/// A post 20 m ahead, a little to starboard, and a wall behind it.
struct GhostCase {
  SceneCloud scene;
  Environment environment;
  SonarHead head = small_head({.beams = 32, .field_of_view_deg = 30, .min_range = 15, .max_range = 35}, 1500);
  PingEvent event;
  SimulationOptions options{.effects = {.mirrors = Choice::always}, .outputs = {.layers = true}};

  GhostCase() {
    scene.materials = {{"post", 0.1}};
    add_sphere(scene, {20, -2, 0}, 0.15, 800);
    environment.profile = SoundSpeedProfile{{0}, {1500}};
    environment.mirrors = {{"wall", {25, 0, 0}, {-1, 0, 0}, {}, 0.7}};
  }
  SimulatedPing ping() const { return simulate_event(scene, head, event, environment, options); }
  PlannedStage stage() const {
    SimulationOptions open = options;
    open.effects.mirrors = Choice::as_needed;
    for (const PlannedStage& s : plan_ping(scene, head, event, environment, open).stages)
      if (s.name == "mirrors") return s;
    return {};
  }
};

double range_of_peak(const ComplexGridF& pressure, const RangeGate& gate, double from, double to) {
  double most = 0, range = 0;
  for (Eigen::Index n = 0; n < pressure.cols(); ++n)
    if (const double r = gate.centre(static_cast<std::size_t>(n)), p = pressure.col(n).abs().maxCoeff();
        r > from && r < to && p > most)
      most = p, range = r;
  return range;
}

const ComplexGridF& layer_of(const SimulatedPing& p, const std::string& name) {
  for (const Layer& layer : p.ping.layers)
    if (layer.name == name) return layer.pressure;
  throw std::runtime_error("no layer " + name);
}

}  // namespace

// Figure 22 of the founding thesis: a bright spot at 30 m that mirrors the one at 20 m.
TEST(MirrorsPing, a_post_before_a_wall_has_a_ghost_at_the_range_of_its_image) {
  const SimulatedPing p = GhostCase{}.ping();
  const double near = std::hypot(20, 2) - 0.15, ghost = std::hypot(30, 2) - 0.15;
  EXPECT_NEAR(range_of_peak(layer_of(p, "direct"), p.ping.gate, 15, 35), near, 0.06);
  EXPECT_NEAR(range_of_peak(layer_of(p, "mirrors"), p.ping.gate, 28, 35), ghost, 0.06);
  EXPECT_NEAR(range_of_peak(layer_of(p, "mirrors"), p.ping.gate, 15, 35), 25, 0.02);  // the wall itself
}

TEST(MirrorsPing, the_walls_own_echo_has_the_level_of_the_heads_image) {
  GhostCase c;
  c.head = small_head({.beams = 31, .field_of_view_deg = 30, .min_range = 15, .max_range = 35}, 1500);
  const double position = c.head.gate.centre(c.head.gate.bins() / 2);  // where a beam and a bin are
  c.environment.mirrors[0].position.x() = position;
  const SimulatedPing p = c.ping();
  const double peak = layer_of(p, "mirrors").abs().maxCoeff();
  const double expected = c.head.pulse.source_level_db + db_from_amplitude(0.7 / (2 * position)) -
                          2 * position * p.report.medium.absorption.a0 / nepers_per_db;
  EXPECT_NEAR(pressure_level_db(peak), expected, 0.2);
}

TEST(MirrorsPing, is_planned_by_its_bound_and_forced_by_name) {
  GhostCase c;
  const PlannedStage stage = c.stage();
  EXPECT_TRUE(stage.included);
  EXPECT_EQ(stage.by, DecidedBy::budget);
  // The bound holds, and is sharp: what the layer has, against what is direct.
  const SimulatedPing p = c.ping();
  const double cost = std::sqrt(layer_of(p, "mirrors").abs2().sum() / layer_of(p, "direct").abs2().sum());
  EXPECT_GT(stage.bound_relative, cost);
  EXPECT_LT(stage.bound_relative, 5 * cost);

  c.environment.mirrors[0].reflection = 1e-6;
  EXPECT_FALSE(c.stage().included);
  c.environment.mirrors.clear();
  EXPECT_EQ(c.stage().bound_relative, 0);
  EXPECT_FALSE(c.stage().included);
}

// A scene without planes: the same plan, the same share of the budget, the same bytes as if there were no such effect.
TEST(MirrorsPing, costs_nothing_without_mirrors) {
  GhostCase c;
  const double share = plan_ping(c.scene, c.head, c.event, c.environment, c.options).share_relative;
  c.options.effects.mirrors = Choice::never;
  const SimulatedPing off = c.ping();
  EXPECT_EQ(off.ping.layers.size(), 1u);
  c.environment.mirrors.clear();
  c.options.effects.mirrors = Choice::as_needed;
  const SimulatedPing none = c.ping();
  EXPECT_TRUE((none.ping.pressure == off.ping.pressure).all());
  EXPECT_GT(plan_ping(c.scene, c.head, c.event, c.environment, c.options).share_relative, share * 1.01);
  c.options.effects.mirrors = Choice::always;
  expect_error(ErrorKind::argument, {"effects.mirrors = always", "[[mirror]]"}, [&] { c.ping(); });
}

TEST(MirrorsPing, fits_planes_of_materials_and_names_the_surfels_of_ghosts) {
  GhostCase c;
  c.environment.mirrors.clear();
  c.scene.materials.push_back({"quay", 1e-4});
  c.scene.materials[1].mirror = 1, c.scene.materials[1].reflection = 0.7;
  SceneCloud wall;
  add_rectangle(wall, {25, -6, -3}, {0, 12, 0}, {0, 0, 6}, {-1, 0, 0}, 0.1);
  for (std::size_t i = 0; i < wall.size(); ++i)
    add_surfel(c.scene, wall.origin + wall.point[i].cast<double>(), {-1, 0, 0}, wall.area[i], 1);
  c.options.outputs.contributors = 1;
  c.options.outputs.paths = 4;
  const SimulatedPing p = c.ping();
  const double ghost = std::hypot(30, 2) - 0.15;
  EXPECT_NEAR(range_of_peak(layer_of(p, "mirrors"), p.ping.gate, 28, 35), ghost, 0.06);
  EXPECT_TRUE(c.stage().included);
  const Contributors& found = p.outputs.contributors;
  const auto bin = static_cast<std::size_t>((ghost - p.ping.gate.min_range) / p.ping.gate.bin_size);
  bool named = false;
  for (std::size_t b = 0; b < found.beams; ++b) {
    const std::size_t at = b * found.bins + bin;
    named |= found.surfel[at] < 800 && found.path[at] == PathKind::two_bounces;
  }
  EXPECT_TRUE(named);
  EXPECT_GT(*std::max_element(p.outputs.paths.bounces.begin(), p.outputs.paths.bounces.end()), 1);
  // The region of a ping with mirrors reaches to all sides.
  const PingSimulator simulator(c.head, c.environment, c.options);
  const PreparedScene prepared(c.scene);
  EXPECT_TRUE(prepared.whole().smooth);
  EXPECT_TRUE(may_intersect(simulator.reach(prepared.whole(), c.event), {-20, 0, 0}, 0.1, 0.01f));
}

TEST(MirrorsPing, of_a_tank_takes_depth_from_its_surface_and_is_the_same_on_any_number_of_threads) {
  GhostCase c;
  c.environment.mirrors.clear();
  c.environment.tank = Tank{{40, 20, 6}, {-5, -10, -3}, 0.7};
  c.event.world_from_head.translation() = Vector3d(0, 0, -1);
  c.options.threads = 1;
  const SimulatedPing one = c.ping();
  c.options.threads = 4;
  const SimulatedPing four = c.ping();
  EXPECT_TRUE((one.ping.pressure == four.ping.pressure).all());
  EXPECT_GT(one.report.layers.back().echoes, 48u);
  c.event.world_from_head.translation() = Vector3d(0, 0, 4);
  EXPECT_THROW(c.ping(), Error);
}
