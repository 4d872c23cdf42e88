// SPDX-License-Identifier: BSD-3-Clause
// Installations that the processing believes to be others than they are, and the water level of a tide.
#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "survey/simulate_survey.hpp"
#include "survey/waypoint_trajectory.hpp"

namespace {

using Eigen::Vector3d;

/// A vehicle at 2 m/s that turns to port at 0.2 rad/s, with a head 1 m ahead of it.
Mission turning_vehicle() {
  Mission mission;
  for (int k = 0; k <= 8; ++k) {
    mission.trajectory.time.push_back(k);
    mission.trajectory.pose.push_back(pose_from_yaw_pitch_roll({2.0 * k, 0, -3}, 0.2 * k, 0, 0));
  }
  mission.heads = {{.name = "a", .vehicle_from_head = pose_from_yaw_pitch_roll({1, 0, 0}, 0, 0, 0), .interval = 1}};
  return mission;
}

/// Returns what is believed of the ping at 4 s.
PingEvent believed_at_4_s(const Mission& mission) { return believed_event_of(mission, survey_pings(mission).at(4)); }

/// A tide that rises by 2 m in 4 s, and then falls by half a metre.
const TideSeries spring{{0, 4, 8}, {-1, 1, 0.5}};

}  // namespace

TEST(Installation, is_as_in_truth_without_assumptions) {
  Mission mission = turning_vehicle();
  mission.heads[0].latency = 0.4, mission.heads[0].draught = 2;
  for (const SurveyPing& ping : survey_pings(mission)) {
    const PingEvent truth = event_of(mission, ping), believed = believed_event_of(mission, ping);
    EXPECT_EQ(truth.world_from_head.matrix(), believed.world_from_head.matrix());
    EXPECT_EQ(truth.motion.velocity, believed.motion.velocity);
  }
}

TEST(Installation, latency_takes_the_pose_of_an_earlier_time) {
  Mission mission = turning_vehicle();
  mission.heads[0].latency = 0.5, mission.heads[0].assumed.latency = 0.2;
  const double then = 4 - 0.3;
  const Pose expected =
      pose_from_yaw_pitch_roll({2 * then, 0, -3}, 0.2 * then, 0, 0) * pose_from_yaw_pitch_roll({1, 0, 0}, 0, 0, 0);
  EXPECT_TRUE(believed_at_4_s(mission).world_from_head.isApprox(expected, 1e-12));
  EXPECT_EQ(believed_at_4_s(mission).time, 4) << "the ping keeps its time";
  // Before the first entry the vehicle goes on backwards, and behind the last ahead.
  EXPECT_NEAR(believed_event_of(mission, survey_pings(mission).at(0)).world_from_head.translation().x(),
              -0.6 + std::cos(0.06), 1e-12);
  mission.heads[0].assumed.latency = 0.8;
  SurveyPing last = survey_pings(mission).at(7);
  last.time = 8;
  EXPECT_NEAR(pose_angles(believed_event_of(mission, last).world_from_head).yaw, 0.2 * 8.3, 1e-12);
}

TEST(Installation, mounting_lever_arm_and_draught_move_the_head_on_its_vehicle) {
  Mission mission = turning_vehicle();
  MissionHead& head = mission.heads[0];
  head.draught = 1.2, head.assumed.draught = 1.5;
  head.assumed.vehicle_from_head = pose_from_yaw_pitch_roll({1.5, 0.2, 0}, 0.03, 0, -0.01);
  Pose expected = pose_from_yaw_pitch_roll({8, 0, -3}, 0.8, 0, 0) * *head.assumed.vehicle_from_head;
  expected.translation().z() -= 0.3;  // deeper by the error of the draught
  const PingEvent believed = believed_at_4_s(mission);
  EXPECT_TRUE(believed.world_from_head.isApprox(expected, 1e-12));
  const Vector3d arm = expected.translation() - Vector3d(8, 0, -3.3);
  EXPECT_TRUE(believed.motion.velocity.isApprox(Vector3d(2, 0, 0) + Vector3d(0, 0, 0.2).cross(arm), 1e-12));
  SimulatedPing made;
  made.ping.world_from_head = event_of(mission, survey_pings(mission).at(4)).world_from_head;
  made.soundings.position = {made.ping.world_from_head * Vector3d(5, 1, 0)};
  const PingOutcome outcome = outcome_of(std::move(made), mission, survey_pings(mission).at(4));
  EXPECT_TRUE(outcome.soundings.position[0].isApprox(expected * Vector3d(5, 1, 0), 1e-12));
  EXPECT_TRUE(outcome.ping.world_from_head.isApprox(expected, 1e-12));
}

// Echoes of a level bed: an array that delays its elements for u' = sin(angle) in water of c' hears from u' c / c'.
TEST(Installation, another_sound_speed_steers_the_beams_and_stretches_ranges) {
  const double c_true = 1500, c_set = 1440;
  Mission mission;
  mission.trajectory = waypoint_trajectory({.points = {{0, 0, 5}, {2, 0, 5}}, .speed = 2});
  mission.heads = {
      {.name = "a", .vehicle_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0), .interval = 1}};
  mission.heads[0].assumed.sound_speed = c_set;
  const SonarHead head = small_head({.beams = 31, .field_of_view_deg = 100, .max_range = 12}, c_true);
  Environment water;
  water.profile = SoundSpeedProfile{{0}, {c_true}};
  const Survey survey(mission, {{head, water, {.synthesis = {.tolerance = 1e-2}}}});
  EXPECT_DOUBLE_EQ(survey.mission().heads[0].listening_time, 2 * 12 / c_set);
  const SurveyPing ping = survey.pings().at(0);
  const SonarHead steered = survey.simulator_of(ping).head();
  ASSERT_EQ(steered.gate.bins(), head.gate.bins());
  EXPECT_DOUBLE_EQ(steered.gate.bin_size, head.gate.bin_size * c_true / c_set);
  for (std::size_t b = 0; b < head.fan.beams(); ++b)
    EXPECT_NEAR(std::sin(steered.fan.azimuth[b]) / c_true, std::sin(head.fan.azimuth[b]) / c_set, 1e-15);

  const SceneCloud bed = make_built_in_scene("plane", {.points = 60000, .size = {30, 30}});
  const PingOutcome outcome = survey.simulate(ping, SceneInMemory(bed));
  EXPECT_EQ(outcome.ping.fan, head.fan);
  EXPECT_EQ(outcome.ping.gate, head.gate);
  EXPECT_EQ(outcome.ping.sound_speed, c_set);
  std::size_t found = 0;
  for (std::size_t i = 0; i < outcome.soundings.size(); ++i) {
    const Vector3d away = outcome.ping.world_from_head.inverse() * outcome.soundings.position[i];
    if (outcome.soundings.true_surfel[i] == Soundings::none) continue;  // a side lobe
    // Back where the echo came from: the sine along the array and the range are smaller by c_set, the turn stays.
    const double sine = away.y() / away.norm() * c_true / c_set, range = away.norm() * c_true / c_set;
    const double down = range * std::sqrt(1 - sine * sine) * away.x() / std::hypot(away.x(), away.z());
    ++found;
    EXPECT_NEAR(down, 5, 0.12) << i;
  }
  EXPECT_GT(found, 10U);
  mission.heads[0].assumed.sound_speed = 1300;
  const SonarHead wide = small_head({.beams = 31, .field_of_view_deg = 150, .max_range = 12}, c_true);
  const Survey beyond(mission, {{wide, water}});
  EXPECT_THAT(error_of([&] { beyond.simulator_of(ping); }),
              HasSubstr("must lie within the reach of the array in water of 1500 m/s"));
}

TEST(Tide, is_linear_between_its_entries_and_ends_with_them) {
  EXPECT_EQ(water_height_at(spring, 0), -1);
  EXPECT_DOUBLE_EQ(water_height_at(spring, 1), -0.5);
  EXPECT_EQ(water_height_at(spring, 4), 1);
  EXPECT_EQ(water_height_at(spring, 8), 0.5);
  EXPECT_THAT(error_of([] { water_height_at(spring, 8.1); }),
              HasSubstr("there is no water level at 8.1 s; its entries from 0 to 8 s must reach there"));
  Mission mission = turning_vehicle();
  mission.tide = {{0, 7}, {0, 1}};
  EXPECT_THAT(error_of([&] { survey_pings(mission); }), HasSubstr("no water level at 8 s"));
  mission.tide = {{0, 9, 8}, {0, 1, 1}};
  EXPECT_THAT(error_of([&] { survey_pings(mission); }), HasSubstr("tide[2] = 1 m at 8 s, must be finite and later"));
  mission.tide = {{0, 9}, {0}};
  EXPECT_THAT(error_of([&] { survey_pings(mission); }), HasSubstr("2 times and 1 heights"));
}

TEST(Tide, raises_a_vehicle_on_the_water_exactly) {
  const Trajectory level = waypoint_trajectory({.points = {{0, 0, -2}, {8, 0, -2}}, .speed = 1});
  const Trajectory afloat = on_the_water(level, spring);
  EXPECT_THAT(afloat.time, testing::ElementsAre(0, 4, 8));
  for (const double time : {0.0, 1.0, 3.9, 4.0, 6.5, 8.0})
    EXPECT_NEAR(pose_at(afloat, time).translation().z(), -2 + water_height_at(spring, time), 1e-12) << time;
}

TEST(Tide, is_the_water_level_of_every_ping) {
  Mission mission = turning_vehicle();
  mission.tide = spring;
  Environment sea;
  sea.surface.emplace();
  const Survey survey(mission, {{small_head({}), sea}});
  const SurveyPing& ping = survey.pings().at(2);
  const Environment there = survey.simulator_of(ping).environment();
  EXPECT_EQ(there.surface->height, 0);
  EXPECT_EQ(survey.environment_of(survey.pings().at(3)).surface->height, 0.5);
  EXPECT_EQ(head_depth(survey.environment_of(survey.pings().at(4)), -3), 4);
  EXPECT_EQ(survey.environment_of(survey.pings().at(6)).water_level, 0.75);
}

// Pings share the tables of their head, and the head that is set to another sound speed, as far as their water is the
// same. They have the bytes of a survey that makes nothing but this ping.
TEST(Tide, pings_of_other_waters_have_the_bytes_of_a_survey_of_their_own) {
  const SceneCloud bed = make_built_in_scene("plane", {.points = 2000, .size = {30, 30}});
  for (const std::optional<double> assumed : {std::optional<double>(), std::optional(1480.0)})
    for (const bool layered : {false, true}) {
      Mission mission = turning_vehicle();
      for (Pose& pose : mission.trajectory.pose) pose.translation().z() = 5;
      mission.heads[0].vehicle_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0);
      mission.heads[0].assumed.sound_speed = assumed;
      mission.tide = {{0, 8}, {9, 6}};
      Environment sea;
      sea.surface.emplace();
      if (layered) sea.profile = SoundSpeedProfile{{0, 20}, {1450, 1550}};
      const SonarHead head = small_head({.beams = 7, .max_range = 12}, 1500);
      const Survey together(mission, {{head, sea}});
      for (const std::size_t number : {1U, 4U, 1U}) {
        const Survey alone(mission, {{head, sea}});
        const PingOutcome shared = together.simulate(together.pings().at(number), SceneInMemory(bed));
        const PingOutcome own = alone.simulate(alone.pings().at(number), SceneInMemory(bed));
        EXPECT_GT(own.ping.pressure.abs().maxCoeff(), 0);
        EXPECT_TRUE((shared.ping.pressure == own.ping.pressure).all()) << number << layered << assumed.has_value();
        EXPECT_EQ(shared.ping.sound_speed, own.ping.sound_speed);
      }
    }
}
