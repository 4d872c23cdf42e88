// SPDX-License-Identifier: BSD-3-Clause
// Parts of scenes at any time, and those that are drawn.
#include "survey/scene_parts.hpp"

#include <set>
#include <thread>

#include "support/heads.hpp"
#include "support/rough_field.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"
#include "survey/parts_source.hpp"

namespace {

using Eigen::Vector2d, Eigen::Vector3d;

SceneBody body_of(const std::string& name, SceneCloud cloud) {
  return {name, name, std::make_shared<const SceneCloud>(std::move(cloud))};
}

SceneBody ball_named(const std::string& name, double radius) {
  SceneCloud cloud;
  add_sphere(cloud, Vector3d::Zero(), radius, 300);
  return body_of(name, std::move(cloud));
}

/// Returns a rough bed over [-3, 3]^2 of surfels 5 cm apart.
PartDefinition rough_bed() {
  SceneCloud cloud;
  const HeightField field = rough_field({.half = 3, .spacing = 0.05, .shortest = 0.4});
  for (const Vector3d& p : draw_points(field, {.spacing = 0.05})) {
    const auto z = [&](double x, double y) { return field.at({x, y}); };
    const Vector3d normal(z(p.x() - 0.02, p.y()) - z(p.x() + 0.02, p.y()),
                          z(p.x(), p.y() - 0.02) - z(p.x(), p.y() + 0.02), 0.04);
    if (normal.allFinite()) add_surfel(cloud, p, normal.normalized(), 0.0025 * normal.norm() / normal.z());
  }
  return {body_of("bed", std::move(cloud)), {}};
}

PartDefinition level_bed() {
  SceneCloud cloud;
  add_floor(cloud, {-3, -3, -2}, 60, 0.1);
  return {body_of("bed", std::move(cloud)), {}};
}

ScatterRule scatter_rule(int least, int most) {
  ScatterRule rule;
  rule.least = least, rule.most = most;
  rule.area = {{-2, -2}, {2, -2}, {2.5, 0}, {2, 2}, {0, 0.5}, {-2, 2}};  // with a re-entrant corner
  rule.yaw = pi, rule.tilt = radians(20);
  return rule;
}

PartPlacement placed_where(const Vector3d& position, PartRest rest = PartRest::none) {
  PartPlacement p;
  p.captured = false, p.position = position, p.rest = rest;
  return p;
}

/// Returns the parts that are present.
std::vector<PlacedPart> present(std::vector<PlacedPart> parts) {
  std::erase_if(parts, [](const PlacedPart& part) { return part.absent; });
  return parts;
}

bool same(const std::vector<PlacedPart>& a, const std::vector<PlacedPart>& b) {
  const auto alike = [](const PlacedPart& p, const PlacedPart& q) {
    return p.name == q.name && p.world_from_part.matrix() == q.world_from_part.matrix() && p.surfels == q.surfels;
  };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), alike);
}

}  // namespace

// The file's order, not that of names; what one draw does not have keeps its number.
TEST(SceneParts, number_classes_alike_at_all_times_and_in_all_draws) {
  PartDefinition bed = level_bed();
  auto sand = std::make_shared<SceneCloud>(*bed.body.cloud);
  sand->materials = {Material{.name = "sand"}, Material{.name = "gravel"}};
  bed.body.cloud = sand, bed.body.label.clear();
  ScatterRule one = scatter_rule(1, 1);
  const auto named = [](const char* name) {
    SceneBody body = ball_named(name, 0.2);
    auto steel = std::make_shared<SceneCloud>(*body.cloud);
    steel->materials = {Material{.name = "steel", .lambert_mu = 0.01}};
    body.cloud = steel;
    return body;
  };
  const auto parts = std::make_shared<const SceneParts>(
      std::vector{bed}, std::vector<SceneScatter>{{{named("tyre"), named("mine"), named("anchor")}, one}}, 3, true);
  const std::vector<std::string> expected{"sand", "gravel", "tyre", "mine", "anchor", "steel"};
  const PartsSource source(parts);
  std::set<std::string> drawn;
  for (std::uint64_t draw = 0; draw < 12; ++draw) {
    const auto scene = source.scene_at({0, draw});
    std::vector<std::string> names, part_names;
    for (const Material& material : scene->scene().materials) names.push_back(material.name);
    EXPECT_EQ(names, expected);
    for (const ScenePart& part : scene->scene().parts) part_names.push_back(part.name);
    EXPECT_EQ(part_names, (std::vector<std::string>{"bed", "anchor-1", "mine-1", "tyre-1"}));
    drawn.insert(present(parts->others_at(0, draw)).front().name);
  }
  EXPECT_EQ(drawn.size(), 3U);
}

TEST(SceneParts, draws_a_thousand_bodies_that_rest_in_their_area_apart) {
  ScatterRule rule = scatter_rule(15, 25);
  rule.min_distance = 0.3;
  const PartDefinition bed = rough_bed();
  const SceneParts parts({bed}, {{{ball_named("pot", 0.08), ball_named("mine", 0.12)}, rule}}, 7, true);
  Ground ground;
  ground.add({"bed", "", bed.body.cloud, true});
  EXPECT_FALSE(parts.still());
  std::size_t drawn = 0, pots = 0;
  std::set<std::size_t> counts;
  const std::set<std::string> names(parts.names().begin(), parts.names().end());
  for (std::uint64_t draw = 0; drawn < 1000; ++draw) {
    const std::vector<PlacedPart> others = present(parts.others_at(0, draw));
    counts.insert(others.size());
    for (const PlacedPart& part : others) {
      ++drawn, pots += part.label == "pot";
      EXPECT_TRUE(names.contains(part.name)) << part.name;
      const Vector3d centre = part.world_from_part.translation();
      EXPECT_TRUE(is_within(rule.area, centre.head<2>())) << centre.transpose();
      for (const PlacedPart& other : others) {
        if (&other == &part) continue;
        EXPECT_GE((other.world_from_part.translation() - centre).head<2>().norm(), 0.3) << part.name;
      }
      // The least height of its surfels above the ground is none: it neither floats nor sinks.
      double gap = 1e9;
      for (std::size_t i = 0; i < part.cloud->size(); ++i) {
        const Vector3d p = part.world_from_part * world(*part.cloud, i);
        gap = std::min(gap, p.z() - ground.at(p.head<2>()).value().height);
      }
      EXPECT_NEAR(gap, 0, 1e-5);
    }
  }
  EXPECT_EQ(*counts.begin(), 15U);
  EXPECT_EQ(*counts.rbegin(), 25U);
  EXPECT_NEAR(static_cast<double>(pots) / static_cast<double>(drawn), 0.5, 0.05) << "each file as likely";
}

TEST(SceneParts, draws_are_of_seed_and_number_alone) {
  ScatterRule rule = scatter_rule(2, 6);
  rule.most_bury = 0.5, rule.least_scale = 0.5, rule.most_scale = 2, rule.rest = PartRest::bed;
  const std::vector<SceneScatter> scatters{{{ball_named("pot", 0.1)}, rule}};
  const SceneParts parts({level_bed()}, scatters, 7, true), again({level_bed()}, scatters, 7, true);
  const auto fifth = parts.others_at(0, 5);
  for (std::uint64_t draw = 20; draw > 0; --draw) EXPECT_TRUE(same(parts.others_at(3, draw), again.others_at(3, draw)));
  EXPECT_TRUE(same(again.others_at(0, 5), fifth));
  EXPECT_FALSE(same(parts.others_at(0, 6), fifth));
  EXPECT_FALSE(same(SceneParts({level_bed()}, scatters, 8, true).others_at(0, 5), fifth));
  // Without a new draw each ping they rest, as they are drawn first.
  const SceneParts once({level_bed()}, scatters, 7);
  EXPECT_TRUE(once.still());
  const std::vector<PlacedPart> resting(once.resting().begin() + 1, once.resting().end());
  EXPECT_TRUE(same(resting, present(parts.others_at(0, 0))));
}

TEST(SceneParts, list_what_a_draw_does_not_have) {
  ScatterRule rule = scatter_rule(1, 3);
  rule.empty_share = 0.4;
  const SceneParts parts({level_bed()}, {{{ball_named("pot", 0.05), ball_named("net", 0.05)}, rule}}, 1, true);
  std::set<std::string> all(parts.names().begin(), parts.names().end());
  all.erase("bed");
  std::size_t empty = 0;
  for (std::uint64_t draw = 0; draw < 200; ++draw) {
    const std::vector<PlacedPart> others = parts.others_at(0, draw);
    std::set<std::string> names;
    for (const PlacedPart& part : others) names.insert(part.name);
    EXPECT_EQ(names, all);
    EXPECT_EQ(others.size(), 6U);
    empty += present(others).empty();
  }
  EXPECT_NEAR(static_cast<double>(empty) / 200, 0.4, 0.1);  // three standard deviations
}

TEST(SceneParts, buries_and_scales_as_asked) {
  ScatterRule rule = scatter_rule(20, 20);
  rule.least_bury = 0.1, rule.most_bury = 0.4, rule.least_scale = 0.5, rule.most_scale = 1.5, rule.tilt = 0;
  const SceneParts parts({level_bed()}, {{{ball_named("pot", 0.1)}, rule}}, 3, true);
  double least = 1, most = 0, small = 9, large = 0;
  for (std::uint64_t draw = 0; draw < 10; ++draw)
    for (const PlacedPart& part : present(parts.others_at(0, draw))) {
      const double radius = part.cloud->point.front().norm();
      const double depth = (-2 - (part.world_from_part.translation().z() - height_of({part.name, "", part.cloud}) / 2));
      const double buried = depth / (2 * radius);
      least = std::min(least, buried), most = std::max(most, buried);
      small = std::min(small, radius), large = std::max(large, radius);
      EXPECT_FALSE(part.surfels.empty()) << "what is buried is not there";
      EXPECT_NEAR(total_area(*part.cloud), 4 * pi * radius * radius, 1e-4);
    }
  EXPECT_GT(least, 0.09);
  EXPECT_LT(most, 0.41);
  EXPECT_LT(least, 0.13);
  EXPECT_GT(most, 0.37);
  EXPECT_LT(small, 0.055);
  EXPECT_GT(large, 0.145);
}

TEST(SceneParts, move_along_trajectories_and_with_constant_velocity) {
  PartPlacement swims;
  swims.captured = false;
  swims.trajectory = Trajectory{
      {2, 4}, {pose_from_yaw_pitch_roll({0, 0, 1}, 0, 0, 0), pose_from_yaw_pitch_roll({4, 0, 1}, pi / 2, 0, 0)}};
  PartPlacement turns = placed_where({1, 0, 0});
  turns.velocity = {0, 2, 0}, turns.turn_rate = {0, 0, pi / 2};
  SceneBody off_centre = ball_named("off", 0.1);
  off_centre.centre = {1, 0, 0};
  const SceneParts parts({level_bed(), {ball_named("diver", 0.3), swims}, {off_centre, turns}}, {}, 1);
  EXPECT_EQ(parts.resting().size(), 1U);
  const std::vector<PlacedPart> at_3 = parts.others_at(3, 0);
  ASSERT_EQ(at_3.size(), 2U);
  EXPECT_TRUE(at_3[0].world_from_part.isApprox(pose_from_yaw_pitch_roll({2, 0, 1}, pi / 4, 0, 0)));
  EXPECT_TRUE(at_3[0].velocity.isApprox(Vector3d(2, 0, 0)));
  EXPECT_TRUE(at_3[0].turn_rate.isApprox(Vector3d(0, 0, pi / 4)));
  // After 3 s its axes are turned by 270 degrees, so that the body 1 m before them is at -y of them and moves to +x.
  EXPECT_TRUE(at_3[1].world_from_part.translation().isApprox(Vector3d(1, 6 - 1, 0)));
  EXPECT_TRUE(at_3[1].world_from_file().isApprox(pose_from_yaw_pitch_roll({1, 6, 0}, 1.5 * pi, 0, 0)))
      << "the axes of its file";
  EXPECT_TRUE(at_3[1].velocity.isApprox(Vector3d(pi / 2, 2, 0)));
  // Velocities are the derivatives of the poses.
  const auto before = parts.others_at(3 - 1e-4, 0), after = parts.others_at(3 + 1e-4, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3d by = after[i].world_from_part.translation() - before[i].world_from_part.translation();
    EXPECT_LT((by / 2e-4 - at_3[i].velocity).norm(), 1e-6);
  }
  EXPECT_EQ(parts.begin(), 2);
  EXPECT_NO_THROW(parts.require_times(2, 4));
  expect_error(ErrorKind::content, {"part 'diver'", "from 2 to 4 s", "asked for at 5 s"},
               [&] { parts.others_at(5, 0); });
  expect_error(ErrorKind::content, {"part 'diver'", "asked for at 1 s"}, [&] { parts.require_times(1, 3); });
}

TEST(SceneParts, that_move_from_where_they_rest_do_so_as_rigid_bodies) {
  PartPlacement crawls = placed_where({0, 0, 0}, PartRest::ground);
  crawls.velocity = {0.5, 0, 0};
  const SceneParts parts({level_bed(), {ball_named("crab", 0.2), crawls}}, {}, 1);
  EXPECT_LT((parts.others_at(2, 0)[0].world_from_part.translation() - Vector3d(1, 0, -1.8)).norm(), 2e-3);
  EXPECT_TRUE(parts.others_at(2, 0)[0].surfels.empty());
}

TEST(SceneParts, rest_on_what_rests_before_them) {
  const SceneParts parts({level_bed(),
                          {ball_named("lower", 0.5), placed_where({0, 0, 0}, PartRest::ground)},
                          {ball_named("upper", 0.5), placed_where({0, 0, 0}, PartRest::ground)}},
                         {}, 1);
  ASSERT_EQ(parts.resting().size(), 3U);
  EXPECT_NEAR(parts.resting()[1].world_from_part.translation().z(), -1.5, 2e-3);
  EXPECT_NEAR(parts.resting()[2].world_from_part.translation().z(), -0.5, 0.06) << "to the spacing of the lower ball";
  EXPECT_TRUE(parts.still());
}

TEST(SceneParts, refuse_what_cannot_be) {
  const auto refused = [](std::vector<PartDefinition> parts, std::vector<SceneScatter> scatters,
                          const std::vector<std::string>& words) {
    expect_error(ErrorKind::content, words, [&] { SceneParts(std::move(parts), std::move(scatters), 1); });
  };
  const PartDefinition ball{ball_named("ball", 0.1), placed_where({0, 0, 0})};
  refused({level_bed(), ball, ball}, {}, {"two parts are called 'ball'"});
  SceneCloud flat;
  add_surfel(flat, {0, 0, 0}, Vector3d::UnitZ(), 0);
  refused({{body_of("flat", flat), {}}}, {}, {"part 'flat' has no area"});
  refused({level_bed(), {ball_named("far", 0.1), placed_where({9, 0, 0}, PartRest::ground)}}, {},
          {"part 'far' at x = 9", "no ground"});
  ScatterRule outside = scatter_rule(1, 1);
  outside.area[2].x() = 3.5;
  refused({level_bed()}, {{{ball_named("pot", 0.1)}, outside}}, {"corner (3.5, 0) of area_m is outside the bed"});
  refused({ball}, {{{ball_named("pot", 0.1)}, scatter_rule(1, 1)}}, {"scatter of 'pot'", "no captured part"});
  refused({level_bed()}, {{{ball_named("rock", 0.9)}, scatter_rule(9, 9)}}, {"no place for body", "of 9"});
  refused({level_bed(), {ball_named("pot-2", 0.1), placed_where({0, 0, 0})}},
          {{{ball_named("pot", 0.1)}, scatter_rule(1, 2)}}, {"two parts are called 'pot-2'"});
}

TEST(SceneParts, names_of_scatters_go_on_counting) {
  const SceneParts parts({level_bed()},
                         {{{ball_named("pot", 0.05)}, scatter_rule(2, 2)},
                          {{ball_named("pot", 0.05), ball_named("net", 0.05)}, scatter_rule(1, 1)}},
                         1);
  EXPECT_EQ(parts.names(), (std::vector<std::string>{"bed", "pot-1", "pot-2", "pot-3", "net-1"}));
  EXPECT_EQ(parts.resting().size(), 4U);
}

TEST(PartsSource, poses_each_ping_by_its_time_and_number) {
  PartPlacement falls = placed_where({0, 0, 0});
  falls.velocity = {0, 0, -1};
  ScatterRule rule = scatter_rule(3, 3);
  const auto parts =
      std::make_shared<const SceneParts>(std::vector<PartDefinition>{level_bed(), {ball_named("stone", 0.2), falls}},
                                         std::vector<SceneScatter>{{{ball_named("pot", 0.05)}, rule}}, 1, true);
  const PartsSource source(parts, {10});
  const PingSimulator simulator(small_head({}), {}, {});
  EXPECT_EQ(source.moment_for({.number = 9}).draw, 0U);
  EXPECT_EQ(source.moment_for({.number = 10}).draw, 1U);
  EXPECT_EQ(source.moment_for({.number = (std::int64_t{3} << 40) + 25}).draw, 2U) << "of each head its own number";
  EXPECT_EQ(PartsSource(parts).moment_for({.number = 25}).draw, 0U);

  const auto low_of = [](const SceneCloud& scene) {
    double low = 9;
    for (std::size_t i = 0; i < scene.size(); ++i) low = std::min(low, world(scene, i).z());
    return low;
  };
  const PingEvent early{.time = 0, .number = 3}, late{.time = 5, .number = 33};
  const auto first = source.scene_for(simulator, early), second = source.scene_for(simulator, late);
  EXPECT_NEAR(low_of(second->scene()), -5.2, 1e-3);
  EXPECT_NEAR(low_of(first->scene()), -2, 1e-3) << "of two pings under way each has its own scene";
  EXPECT_EQ(first->scene().size(), second->scene().size());
  EXPECT_NE(first->scene().point, second->scene().point);
}

TEST(PartsSource, gives_several_threads_the_scenes_of_one) {
  PartPlacement drifts = placed_where({0, 0, 0});
  drifts.velocity = {0.1, 0, 0.2};
  const auto parts = std::make_shared<const SceneParts>(
      std::vector<PartDefinition>{level_bed(), {ball_named("buoy", 0.2), drifts}},
      std::vector<SceneScatter>{{{ball_named("pot", 0.05)}, scatter_rule(1, 4)}}, 1, true);
  const PingSimulator simulator(small_head({}), {}, {});
  constexpr int pings = 40;
  const auto points_of = [&](const PartsSource& source, int ping) {
    const auto scene = source.scene_for(simulator, {.time = 0.5 * ping, .number = ping});
    std::this_thread::yield();
    return scene->scene().point;
  };
  const PartsSource alone(parts, {2}), shared(parts, {2});
  std::vector<std::vector<Eigen::Vector3f>> made(pings);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int ping = t; ping < pings; ping += 4) made[static_cast<std::size_t>(ping)] = points_of(shared, ping);
    });
  for (std::thread& thread : threads) thread.join();
  for (int ping = pings - 1; ping >= 0; --ping)
    EXPECT_EQ(made[static_cast<std::size_t>(ping)], points_of(alone, ping)) << ping;
}
