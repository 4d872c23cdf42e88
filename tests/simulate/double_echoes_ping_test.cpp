// SPDX-License-Identifier: BSD-3-Clause
// Tests echoes by way of two surfaces in a ping: layer, plan, contributors, returns.
#include "core/random.hpp"
#include "scene/surface_rays.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

const SmallSonar corner_sonar{
    .beams = 32, .field_of_view_deg = 40, .elevation_width_deg = 40, .max_range = 9, .source_level_db = 200};

/// Returns a bed of 3 m, and a wall that stands on its far end, 6 m ahead of a head 1 m above the bed.
SceneCloud bed_and_wall(double mu) {
  constexpr int per_side = 60;
  SceneCloud scene;
  scene.materials = {{"bed", mu}, {"wall", mu}};
  for (const bool wall : {false, true})
    for (int i = 0; i < per_side * per_side; ++i) {
      const auto u = random_uniform(3, RandomStage::scene_points, {scene.size(), 0, 0});
      const double a = 3 * (i % per_side + u[0]) / per_side, b = 3 * (i / per_side + u[1]) / per_side - 1.5;
      add_surfel(scene, wall ? Eigen::Vector3d(6, b, a - 1) : Eigen::Vector3d(6 - a, b, -1),
                 Eigen::Vector3d(wall ? -1 : 0, 0, wall ? 0 : 1), 9.0 / (per_side * per_side), wall);
    }
  return scene;
}

SimulatedPing corner_ping(const SimulationOptions& options, double mu = 0.1) {
  return simulate_event(bed_and_wall(mu), small_head(corner_sonar), {}, {}, options);
}

class DoubleEchoesInAPing : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
    with_.effects.double_echoes = 16;
    with_.outputs.layers = true;
  }
  SimulationOptions with_;
};

}  // namespace

TEST_F(DoubleEchoesInAPing, are_a_layer_that_leaves_the_others_as_they_are) {
  SimulationOptions without = with_;
  without.effects.double_echoes = 0;
  const SimulatedPing both = corner_ping(with_), direct = corner_ping(without);
  ASSERT_EQ(both.ping.layers.size(), 2u);
  EXPECT_EQ(both.ping.layers[1].name, "double-echoes");
  ASSERT_EQ(direct.ping.layers.size(), 1u);
  EXPECT_TRUE((both.ping.layers[0].pressure == direct.ping.layers[0].pressure).all());
  EXPECT_TRUE(direct.soundings.true_order.empty());

  with_.threads = 3;
  const SimulatedPing three = corner_ping(with_);
  EXPECT_TRUE((three.ping.pressure == both.ping.pressure).all());
  EXPECT_EQ(three.soundings.true_order, both.soundings.true_order);
}

TEST_F(DoubleEchoesInAPing, are_within_what_the_plan_says) {
  const SceneCloud scene = bed_and_wall(0.1);
  const PingPlan plan = plan_ping(scene, small_head(corner_sonar), {}, {}, {});
  const auto row = std::find_if(plan.stages.begin(), plan.stages.end(),
                                [](const PlannedStage& s) { return s.name == "double-echoes"; });
  ASSERT_NE(row, plan.stages.end());
  EXPECT_FALSE(row->included);
  const SimulatedPing ping = corner_ping(with_);
  const double effect =
      std::sqrt(ping.ping.layers[1].pressure.abs2().sum() / ping.ping.layers[0].pressure.abs2().sum());
  EXPECT_LT(effect, row->bound_relative);
  EXPECT_GT(effect, row->bound_relative / 5);

  Environment none;
  SimulationOptions forced;
  force_stage("double-echoes", true, {}, none, forced);
  EXPECT_EQ(forced.effects.double_echoes, usual_double_echoes);
}

// Two Lambert plates: as mu grows tenfold, so do double echoes over direct ones, in power.
TEST_F(DoubleEchoesInAPing, grow_with_the_square_of_the_cross_section) {
  const auto ratio = [&](double mu) {
    const SimulatedPing ping = corner_ping(with_, mu);
    return ping.ping.layers[1].pressure.abs2().sum() / ping.ping.layers[0].pressure.abs2().sum();
  };
  EXPECT_NEAR(ratio(0.1) / ratio(0.01), 10, 0.01);
}

TEST_F(DoubleEchoesInAPing, are_named_by_contributors_and_returns) {
  with_.outputs.contributors = 3;
  const SimulatedPing ping = corner_ping(with_, 0.3);
  const Contributors& c = ping.outputs.contributors;
  ASSERT_EQ(c.surfel_before.size(), c.surfel.size());
  int doubles = 0;
  for (std::size_t i = 0; i < c.surfel.size(); ++i) {
    ASSERT_EQ(c.path[i] == PathKind::two_surfaces, c.surfel_before[i] != Contributors::none);
    if (c.path[i] != PathKind::two_surfaces) continue;
    ++doubles;
    EXPECT_NE(c.surfel[i] < 3600, c.surfel_before[i] < 3600) << "one on the bed, one on the wall";
  }
  EXPECT_GT(doubles, 100);

  ASSERT_EQ(ping.soundings.true_order.size(), ping.soundings.size());
  EXPECT_GT(std::count(ping.soundings.true_order.begin(), ping.soundings.true_order.end(), 1u), 10);
  SimulationOptions behind = with_;
  behind.detection.all_bins = true, behind.detection.above_db = -100;
  const Soundings all = corner_ping(behind, 0.3).soundings;
  int ghosts = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all.true_order[i] == 2 && all.position[i].x() > 6.1) ++ghosts;  // behind the wall
  EXPECT_GT(ghosts, 20);
}

namespace {

/// Returns water whose sound is slower below the head, by so much over the 1.5 m down to the bed.
Environment slower_below(double by) {
  Environment water;
  water.water_level = 5;
  water.profile = SoundSpeedProfile{{0, 4.5, 6, 20}, {1500, 1500, 1500 - by, 1500 - by}};
  return water;
}

}  // namespace

// Centimetres of the path turn the phases of all of them.
TEST_F(DoubleEchoesInAPing, run_through_the_profile_where_rays_are_bent) {
  const auto changed = [&](double slower) {
    SimulatedPing pings[2];
    for (const bool bent : {false, true}) {
      with_.effects.refraction = bent ? Choice::always : Choice::never;
      pings[bent] = simulate_event(bed_and_wall(0.1), small_head(corner_sonar), {}, slower_below(slower), with_);
      EXPECT_EQ(pings[bent].report.refraction.unreached, 0u);
    }
    const auto &straight = pings[0].ping.layers[1].pressure, &bent = pings[1].ping.layers[1].pressure;
    return std::sqrt((bent - straight).abs2().sum() / straight.abs2().sum());
  };
  EXPECT_GT(changed(15), 0.5);
  EXPECT_LT(changed(0), 1e-3);
}

TEST_F(DoubleEchoesInAPing, have_straight_legs_only_within_a_centimetre_and_the_budget) {
  const auto bends = [&](double slower, bool with_doubles) {
    SimulationOptions options;
    options.accuracy_db = 20;
    options.effects.double_echoes = with_doubles ? 1 : 0;
    const PingPlan plan = plan_ping(bed_and_wall(0.1), small_head(corner_sonar), {}, slower_below(slower), options);
    return std::find_if(plan.stages.begin(), plan.stages.end(),
                        [](const PlannedStage& s) { return s.name == "refraction"; })
        ->included;
  };
  EXPECT_FALSE(bends(15, false));
  EXPECT_TRUE(bends(15, true));
  EXPECT_FALSE(bends(0.5, true));
}
