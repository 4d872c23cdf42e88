// SPDX-License-Identifier: BSD-3-Clause
// Explanation of a sample, and the surfels highlighted for it.
#include "viewer/viewer_explain.hpp"

#include "support/test.hpp"
#include "viewer/three_targets.hpp"

using testing::Not;

TEST(ExplainPixel, says_range_bearing_and_levels) {
  const auto made = three_targets();
  const PixelFacts facts = find_pixel_facts(made.data, 0, made.starboard.pixel);
  EXPECT_NEAR(facts.range, 2 + 40.5 * 0.1, 1e-12);  // centre of bin 40
  // 10 Pa peak: 20 log10(10 / sqrt 2 / 1e-6) = 136.99 dB; TVG: 40 log10(6.05) + 2 x 0.25 x 6.05 = 34.30 dB.
  EXPECT_NEAR(facts.level_db, 136.99, 0.005);
  EXPECT_NEAR(facts.compensated_level_db - facts.level_db, 40 * std::log10(6.05) + 0.5 * 6.05, 1e-9);
  const std::string text = explain_pixel(facts);
  EXPECT_THAT(text, HasSubstr("Ping 7, beam "));
  EXPECT_THAT(text, HasSubstr("Range 6.050 m"));
  EXPECT_THAT(text, HasSubstr("+26.00° (starboard)"));
  EXPECT_THAT(text, HasSubstr("137.0 dB re 1 µPa"));
}

TEST(ExplainPixel, gives_back_the_absorption_of_the_water_of_its_ping) {
  auto made = three_targets(2);
  made.pings[1].absorption_db_per_m = 0.5;
  made.data.pings = reel_in_memory(made.pings);
  const auto gain = [&](std::size_t ping) {
    const PixelFacts facts = find_pixel_facts(made.data, ping, made.starboard.pixel);
    return facts.compensated_level_db - facts.level_db;
  };
  EXPECT_NEAR(gain(1) - gain(0), 2 * (0.5 - 0.25) * 6.05, 1e-9);
}

TEST(ExplainPixel, port_is_negative_and_starboard_positive) {
  const auto made = three_targets();
  EXPECT_GT(made.port.azimuth, 0);
  EXPECT_THAT(explain_pixel(find_pixel_facts(made.data, 0, made.port.pixel)), HasSubstr("-26.00° (port)"));
  EXPECT_THAT(explain_pixel(find_pixel_facts(made.data, 0, made.far.pixel)), HasSubstr("0.00° (ahead)"));
}

TEST(ExplainPixel, names_the_material_at_the_sample) {
  const auto made = three_targets();
  for (const auto* target : {&made.port, &made.starboard, &made.far}) {
    const PixelFacts facts = find_pixel_facts(made.data, 0, target->pixel);
    EXPECT_EQ(facts.seen_material, target->name);
    EXPECT_EQ(facts.visibility->seen.size(), 25U);
    EXPECT_THAT(explain_pixel(facts), HasSubstr(std::string("25 seen (") + target->name));
  }
}

TEST(ExplainPixel, contributors_come_strongest_first_with_share_and_path) {
  const auto made = three_targets(1, true);
  const PixelFacts facts = find_pixel_facts(made.data, 0, made.port.pixel);
  ASSERT_EQ(facts.contributions.size(), 2U);
  EXPECT_EQ(facts.contributions[0].surfel, 12U);
  EXPECT_EQ(facts.contributions[0].material, "iron");
  EXPECT_EQ(facts.contributions[1].path, PathKind::one_bounce);
  const std::string text = explain_pixel(facts);
  EXPECT_THAT(text, HasSubstr("iron, surfel 12"));
  EXPECT_THAT(text, HasSubstr("75 % of the energy, direct"));
  EXPECT_THAT(text, HasSubstr("20 % of the energy, by one bounce, elevation -1.50°"));
  EXPECT_THAT(surfels_behind(facts), testing::ElementsAre(12, 7));
}

TEST(ExplainPixel, distinguishes_no_contributors_from_unknown_ones) {
  const auto known = three_targets(1, true);
  EXPECT_THAT(explain_pixel(find_pixel_facts(known.data, 0, {0, 0})), HasSubstr("No surfel contributes"));
  const auto not_known = three_targets();
  EXPECT_THAT(explain_pixel(find_pixel_facts(not_known.data, 0, {0, 0})), Not(HasSubstr("contribut")));
}

TEST(ExplainPixel, without_contributors_what_is_seen_there_is_highlighted) {
  const auto made = three_targets();
  EXPECT_EQ(surfels_behind(find_pixel_facts(made.data, 0, made.port.pixel)).size(), 25U);
  EXPECT_TRUE(surfels_behind(find_pixel_facts(made.data, 0, {0, 0})).empty());
}

TEST(ExplainPixel, names_the_occluder_and_its_range) {
  auto made = three_targets();
  // A screen of 40 x 40 surfels in front of the far target, at half its range.
  const Pose& pose = made.pings[0].world_from_head;
  const double range = 6;
  for (int i = -20; i < 20; ++i)
    for (int j = -20; j < 20; ++j)
      add_surfel(made.data.scene, pose * Eigen::Vector3d(range, 0.02 * i + 0.01, 0.02 * j + 0.01),
                 pose.linear() * Eigen::Vector3d(-1, 0, 0), 4e-4, 1);
  const PixelFacts facts = find_pixel_facts(made.data, 0, made.far.pixel);
  EXPECT_EQ(facts.visibility->hidden.size(), 25U);
  EXPECT_TRUE(facts.visibility->seen.empty());
  ASSERT_TRUE(facts.visibility->occluder_range);
  EXPECT_NEAR(*facts.visibility->occluder_range, range, 0.01);
  EXPECT_EQ(made.data.scene.material[*facts.visibility->occluder_surfel], 1);
  EXPECT_THAT(explain_pixel(facts), HasSubstr("Shadow of a surfel at 6.0"));
}

TEST(ExplainPixel, reports_a_hole_of_the_scan) {
  auto made = three_targets();
  Ping& ping = made.pings[0];
  EXPECT_THAT(explain_pixel(find_pixel_facts(made.data, 0, {3, 4})), Not(HasSubstr("Hole")));
  ping.unknown.setZero(ping.pressure.rows(), ping.pressure.cols());
  ping.unknown(3, 4) = 1;
  made.data.pings = reel_in_memory(made.pings);
  EXPECT_THAT(explain_pixel(find_pixel_facts(made.data, 0, {3, 4})), HasSubstr("Hole"));
  EXPECT_THAT(explain_pixel(find_pixel_facts(made.data, 0, {3, 5})), Not(HasSubstr("Hole")));
}

TEST(ExplainPixel, silence_has_no_level) {
  auto made = three_targets();
  made.pings[0].pressure(2, 2) = 0;
  made.data.pings = reel_in_memory(made.pings);
  const std::string text = explain_pixel(find_pixel_facts(made.data, 0, {2, 2}));
  EXPECT_THAT(text, HasSubstr("no sound in this sample"));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

TEST(ExplainPixel, refuses_a_sample_that_is_not_there) {
  const auto made = three_targets();
  EXPECT_THROW(find_pixel_facts(made.data, 1, {0, 0}), Error);
  EXPECT_THROW(find_pixel_facts(made.data, 0, {41, 0}), Error);
  EXPECT_THROW(find_pixel_facts(made.data, 0, {0, 120}), Error);
}

// --- from the world to a sample

TEST(PlaceOf, finds_the_sample_of_a_target) {
  const auto made = three_targets();
  for (const auto* target : {&made.port, &made.starboard, &made.far})
    EXPECT_EQ(position_of(made.pings[0], target->position), target->pixel) << target->name;
}

TEST(PlaceOf, is_empty_outside_fan_and_gate) {
  const auto made = three_targets();
  const Ping& ping = made.pings[0];
  EXPECT_FALSE(position_of(ping, ping.world_from_head * Eigen::Vector3d(1.9, 0, 0)));
  EXPECT_FALSE(position_of(ping, ping.world_from_head * Eigen::Vector3d(14.1, 0, 0)));
  EXPECT_FALSE(position_of(ping, ping.world_from_head * Eigen::Vector3d(-5, 0, 0)));
  EXPECT_FALSE(position_of(ping, ping.world_from_head * Eigen::Vector3d(1, 5, 0)));
}

// --- a scene before any ping

TEST(HeadView, counts_what_a_head_sees) {
  const auto made = three_targets();
  const Ping& ping = made.pings[0];
  const HeadView view = look_from(made.data.scene, view_at(made.data, ping.world_from_head, ping.fan, ping.gate));
  EXPECT_EQ(view.seen, 75U);
  EXPECT_EQ(view.seen + view.hidden + view.turned_away + view.outside, made.data.scene.size());
  EXPECT_NEAR(view.nearest, 6.05, 0.01);
  EXPECT_NEAR(view.farthest, 12.05, 0.01);
  PoseAngles head = pose_angles(ping.world_from_head);
  head.yaw += pi;  // looks away
  const HeadView away = look_from(made.data.scene, view_at(made.data, pose_of(head), ping.fan, ping.gate));
  EXPECT_EQ(away.seen, 0U);
  ViewerState state;
  state.head = head;
  EXPECT_THAT(explain_view(away, state), HasSubstr("Nothing is seen"));
}

// A ping samples more than the elevation width and the gate: so does the inspection, once it knows the ping.
TEST(HeadView, is_that_of_the_ping_where_it_is_known) {
  auto made = three_targets();
  const Ping& ping = made.pings[0];
  const PixelFacts facts = find_pixel_facts(made.data, 0, made.far.pixel);
  EXPECT_EQ(facts.visibility->seen.size(), 25U);
  made.data.view = View{Pose::Identity(), {}, {2, 9, 0.1}, {}};  // the far target stands at 12 m
  EXPECT_EQ(look_from(made.data.scene, view_at(made.data, ping.world_from_head, ping.fan, ping.gate)).seen, 50U);
  EXPECT_TRUE(find_pixel_facts(made.data, 0, made.far.pixel).visibility->seen.empty());
}

TEST(HeadView, explains_a_surfel) {
  const auto made = three_targets();
  const Ping& ping = made.pings[0];
  const PoseAngles head = pose_angles(ping.world_from_head);
  const HeadView view = look_from(made.data.scene, view_at(made.data, ping.world_from_head, ping.fan, ping.gate));
  const std::string text = explain_surfel(made.data.scene, view, head, 12);  // middle of the port target
  EXPECT_THAT(text, HasSubstr("Material iron"));
  EXPECT_THAT(text, HasSubstr("Range 6.050 m"));
  EXPECT_THAT(text, HasSubstr("Bearing -26.00°"));
  EXPECT_THAT(text, HasSubstr("Incidence 0."));
  EXPECT_THAT(text, HasSubstr("This surfel is seen"));
  EXPECT_THROW(explain_surfel(made.data.scene, view, head, 75), Error);
}
