// SPDX-License-Identifier: BSD-3-Clause
// A mission becomes a list of pings, and each ping a position.
#include "survey/survey_pings.hpp"

#include "core/pose.hpp"
#include "support/test.hpp"
#include "survey/waypoint_trajectory.hpp"

using testing::ElementsAre;

namespace {

/// Returns a track along x at 2 m/s for 10 s, three metres down, with one head that pings once a second.
Mission straight() {
  Mission m;
  m.trajectory = waypoint_trajectory({.points = {{0, 0, -3}, {20, 0, -3}}, .speed = 2});
  m.heads = {{.name = "fls", .interval = 1, .listening_time = 0.1}};
  return m;
}

template <typename Value>
std::vector<double> each(const Mission& m, Value value) {
  std::vector<double> values;
  for (const SurveyPing& ping : survey_pings(m)) values.push_back(static_cast<double>(std::invoke(value, ping)));
  return values;
}
std::vector<double> times(const Mission& m) { return each(m, &SurveyPing::time); }
std::vector<double> angles(const Mission& m) {
  return each(m, [](const SurveyPing& ping) { return std::round(degrees(ping.scan_angle) * 1e6) / 1e6; });
}
std::vector<double> sweeps(const Mission& m) { return each(m, &SurveyPing::sweep); }

Mission scanning(ScanMode mode, double stop_deg, double seconds) {
  Mission m = straight();
  m.heads[0].interval = 1;
  m.heads[0].scan = HeadScan{0, radians(stop_deg), radians(90), mode};
  m.legs = {{"sweep", 0, seconds}};
  return m;
}

std::string refusal(const std::function<void(Mission&)>& change) {
  Mission m = straight();
  change(m);
  return error_of([&] { survey_pings(m); });
}

}  // namespace

TEST(SurveyPings, are_sent_by_rate_distance_or_list_and_only_on_active_legs) {
  Mission m = straight();
  EXPECT_THAT(times(m), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  m.heads[0].interval = 0, m.heads[0].distance = 7;
  EXPECT_THAT(times(m), ElementsAre(0, 3.5, 7));
  m.legs = {{"out", 1, 3}, {"transit", 3, 8, false}, {"back", 8, 10, true, {}, 0.5}};
  EXPECT_THAT(times(m), ElementsAre(1, 8, 8.5, 9, 9.5)) << "each leg begins with a ping, the last has its own rate";
  m.heads[0].distance = 0, m.heads[0].times = {0, 1, 3, 9, 10};
  m.legs.back().interval = 0;
  EXPECT_THAT(times(m), ElementsAre(1, 9, 10)) << "a leg ends before its end, the trajectory at it";
  m.legs.back().heads = {"fls"};
  EXPECT_EQ(times(m).size(), 3U);
}

TEST(SurveyPings, by_distance_count_the_way_round_corners) {
  Mission m = straight();
  m.trajectory = {{0, 1, 2, 5, 6}, std::vector<Pose>(5, Pose::Identity())};
  m.trajectory.pose[1].translation().x() = 3;
  m.trajectory.pose[2].translation() = Eigen::Vector3d(3, 3, 0);
  m.trajectory.pose[3].translation() = Eigen::Vector3d(3, 3, 0);  // at rest
  m.trajectory.pose[4].translation() = Eigen::Vector3d(3, 6, 0);
  m.heads[0].interval = 0, m.heads[0].distance = 2;
  const std::vector<double> t = times(m);
  ASSERT_EQ(t.size(), 5U);
  for (std::size_t k = 0; k < t.size(); ++k)
    EXPECT_NEAR(t[k], (std::vector<double>{0, 2.0 / 3, 4.0 / 3, 2, 17.0 / 3})[k], 1e-12) << k;
}

TEST(SurveyPings, of_a_scanning_head_turn_it_on_or_to_and_fro_or_once) {
  EXPECT_THAT(angles(scanning(ScanMode::continuous, 360, 6)), ElementsAre(0, 90, 180, 270, 0, 90));
  EXPECT_THAT(sweeps(scanning(ScanMode::continuous, 360, 6)), ElementsAre(0, 0, 0, 0, 1, 1));
  EXPECT_THAT(angles(scanning(ScanMode::continuous, -180, 4)), ElementsAre(0, -90, -180, 0));
  EXPECT_THAT(angles(scanning(ScanMode::sector, 180, 6)), ElementsAre(0, 90, 180, 90, 0, 90));
  EXPECT_THAT(sweeps(scanning(ScanMode::sector, 180, 6)), ElementsAre(0, 0, 1, 1, 2, 2));
  EXPECT_THAT(angles(scanning(ScanMode::single, 180, 6)), ElementsAre(0, 90, 180));
  // A new leg begins a new sweep; without a rate the head pings as soon as it has listened.
  Mission m = scanning(ScanMode::continuous, 360, 0);
  m.heads[0].interval = 0, m.heads[0].listening_time = 1.5;
  m.legs = {{"a", 0, 3}, {"b", 3, 6}};
  EXPECT_THAT(times(m), ElementsAre(0, 1.5, 3, 4.5));
  EXPECT_THAT(angles(m), ElementsAre(0, 90, 0, 90));
  EXPECT_THAT(sweeps(m), ElementsAre(0, 0, 1, 1));
}

TEST(SurveyPings, stand_where_the_mounting_is_and_move_with_its_lever_arm) {
  // A vehicle at rest in (1, 2, 3) turns to port at 90 degrees in 2 s; the head is 2 m ahead, looks to starboard and
  // has turned by 30 degrees to port.
  Mission m = straight();
  m.trajectory = {{0, 2},
                  {pose_from_yaw_pitch_roll({1, 2, 3}, 0, 0, 0), pose_from_yaw_pitch_roll({1, 2, 3}, pi / 2, 0, 0)}};
  m.heads[0].vehicle_from_head = pose_from_yaw_pitch_roll({2, 0, 0}, -pi / 2, 0, 0);
  const PingEvent position = event_of(m, {0, 0, 1, 0, radians(30)});
  const PoseAngles at = pose_angles(position.world_from_head);
  const double r = 2 * std::sqrt(0.5);
  EXPECT_TRUE(at.position.isApprox(Eigen::Vector3d(1 + r, 2 + r, 3), 1e-12)) << at.position.transpose();
  EXPECT_NEAR(at.yaw, radians(45 - 90 + 30), 1e-12);
  EXPECT_TRUE(position.motion.turn_rate.isApprox(Eigen::Vector3d(0, 0, pi / 4), 1e-12));
  EXPECT_TRUE(position.motion.velocity.isApprox(pi / 4 * Eigen::Vector3d(-r, r, 0), 1e-12));
}

TEST(SurveyPings, have_random_numbers_of_their_own) {
  Mission m = straight();
  m.heads.push_back(m.heads[0]);
  m.heads[1].name = "other";
  std::set<std::int64_t> numbers;
  for (const SurveyPing& ping : survey_pings(m)) numbers.insert(random_stream_of(ping));
  EXPECT_EQ(numbers.size(), 20U);
  m.legs = {{"one", 0, 1}, {"two", 4, 5}};
  for (const SurveyPing& ping : survey_pings(m)) EXPECT_TRUE(numbers.contains(random_stream_of(ping)));
}

TEST(SurveyPings, are_divided_into_blocks_of_one_head_each) {
  Mission m = straight();
  m.heads.push_back(m.heads[0]);
  m.heads[1].name = "other", m.heads[1].interval = 3;
  const auto blocks = survey_blocks(survey_pings(m), {4, 100});
  std::vector<std::vector<std::size_t>> seen;
  for (const SurveyBlock& b : blocks) seen.push_back({b.head, static_cast<std::size_t>(b.number), b.begin, b.end});
  EXPECT_THAT(seen, ElementsAre(ElementsAre(0, 0, 0, 4), ElementsAre(0, 1, 4, 8), ElementsAre(0, 2, 8, 10),
                                ElementsAre(1, 0, 10, 14)));
}

TEST(SurveyPings, are_not_sent_within_a_gap_of_the_trajectory) {
  Mission m = straight();
  for (double x = 22; x <= 26; x += 2) {  // entries at 20.5, 21.5 and 22.5 s, behind one at 10 s
    m.trajectory.time.push_back(9.5 + x / 2);
    m.trajectory.pose.push_back(Pose(Eigen::Translation3d(x, 0, -3)));
  }
  EXPECT_EQ(times(m).size(), 23U);
  m.max_gap = 10.4;
  EXPECT_THAT(times(m), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 21, 22));
  EXPECT_EQ(survey_pings(m)[11].number, 11);
  m.max_gap = 10.5;
  EXPECT_EQ(times(m).size(), 23U);
  EXPECT_THAT(refusal([](Mission& mission) { mission.max_gap = 0; }), HasSubstr("max_gap = 0 s, must be > 0"));
}

TEST(SurveyPings, gaps_are_ten_times_the_usual_distance_and_five_seconds) {
  const auto gap = [](const std::vector<double>& time) {
    return gap_of({time, std::vector<Pose>(time.size(), Pose::Identity())});
  };
  EXPECT_EQ(gap({0, 1, 2, 3, 63, 64}), 10);
  EXPECT_EQ(gap({0, 0.1, 0.2, 0.3, 60, 60.1}), 5);
  EXPECT_TRUE(std::isinf(gap({0, 1, 60})));
}

TEST(SurveyPings, refuse_what_no_vehicle_can_do) {
  EXPECT_EQ(
      refusal([](Mission& m) { m.heads[0].listening_time = 1.5; }),
      "survey_pings: head 'fls': pings 0 and 1 at 0 and 1 s are 1 s apart, must be at least 2 max_range / c = 1.5 s");
  EXPECT_THAT(refusal([](Mission& m) { m.heads.clear(); }), HasSubstr("no head, must have at least one"));
  EXPECT_THAT(refusal([](Mission& m) { m.heads.push_back(m.heads[0]); }), HasSubstr("two heads are called 'fls'"));
  EXPECT_THAT(refusal([](Mission& m) { m.heads[0].name = "a/b"; }), HasSubstr("head 'a/b': a name must consist of"));
  EXPECT_THAT(refusal([](Mission& m) { m.heads[0].distance = 1; }), HasSubstr("by one of rate_hz, every_m and times"));
  EXPECT_THAT(refusal([](Mission& m) { m.heads[0].scan = HeadScan{0, 1, 2}; }), HasSubstr("at most the span of 57.29"));
  EXPECT_THAT(refusal([](Mission& m) {
                m.legs = {{"a", 0, 5}, {"b", 4, 6}};
              }),
              HasSubstr("leg 'b': begins at 4 s, before leg 'a' ends at 5 s; legs must not overlap"));
  EXPECT_THAT(refusal([](Mission& m) {
                m.legs = {{"a", 0, 11}};
              }),
              HasSubstr("leg 'a': from 0 to 11 s, must ascend within the trajectory's 0 and 10 s"));
  EXPECT_THAT(refusal([](Mission& m) { m.legs = {{"a", 0, 1, true, {"x"}}}; }), HasSubstr("there is no head 'x'"));
  EXPECT_THAT(refusal([](Mission& m) { m.legs = {{"a", 0, 1, false}}; }), HasSubstr("no head pings on any leg"));
}

// Counted before a list of them is made, which would take gigabytes and minutes.
TEST(SurveyPings, refuse_more_than_a_hundred_million) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal([](Mission& m) { m.heads[0].interval = 1e-8, m.heads[0].listening_time = 0; }),
              AllOf(HasSubstr("head 'fls' asks for 1000000000 pings, all heads must ask for at most 100000000"),
                    HasSubstr("rate_hz, every_m")));
  EXPECT_THAT(refusal([](Mission& m) { m.heads[0].interval = 0, m.heads[0].distance = 1e-300; }),
              HasSubstr("asks for 2e+301 pings"));
  EXPECT_THAT(refusal([](Mission& m) {
                m.heads[0].interval = 0, m.heads[0].times = {0}, m.legs = {{"a", 0, 10, true, {}, 1e-9}};
              }),
              HasSubstr("asks for 1e+10 pings"));
  EXPECT_THAT(refusal([](Mission& m) {
                m.heads[0].scan = HeadScan{0, 1, 1e-300, ScanMode::sector};
              }),
              AllOf(HasSubstr("directions, must be at most 1000000"), HasSubstr("take a larger step")));
  EXPECT_THAT(refusal([](Mission& m) {
                m.heads[0].interval = 0, m.heads[0].listening_time = 1e-12, m.heads[0].scan = HeadScan{0, 1, 0.1};
              }),
              HasSubstr("asks for 1e+13 pings"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST(WaypointTrajectory, keeps_its_speed_and_blends_its_corners) {
  const Trajectory t = waypoint_trajectory(
      {.points = {{0, 0, -3}, {20, 0, -3}, {20, 20, -3}, {20, 20, -8}}, .speed = 2, .turn_radius = 4, .start_time = 5});
  require_valid(t, "test");
  // Legs of 16 m and 13.5 m about a quarter of a circle of 4 m, then one of 2.5 m (half of the last leg).
  EXPECT_NEAR(t.time.back() - 5, (16 + 4 * pi / 2 + 13.5 + 2.5 * pi / 2 + 2.5) / 2, 2e-3);
  for (std::size_t i = 1; i < t.time.size(); ++i) {
    const Eigen::Vector3d step = t.pose[i].translation() - t.pose[i - 1].translation();
    EXPECT_NEAR(step.norm() / (t.time[i] - t.time[i - 1]), 2, 1e-9);
    if (step.head<2>().norm() > 0.02 * step.norm()) {
      EXPECT_LT(std::acos(std::min(1.0, step.normalized().dot(t.pose[i].linear().col(0)))), pi / 2);
    }
  }
  const PoseAngles middle = pose_angles(pose_at(t, 5 + (16 + pi * 4 / 4) / 2));
  EXPECT_NEAR(degrees(middle.yaw), 45, 0.1);
  EXPECT_LT((middle.position - Eigen::Vector3d(16 + 4 * std::sin(pi / 4), 4 - 4 * std::cos(pi / 4), -3)).norm(), 2e-3);
  EXPECT_NEAR(degrees(pose_angles(t.pose.back()).yaw), 90, 1e-6) << "an upright leg keeps the yaw";
}

TEST(WaypointTrajectory, refuses_ways_that_nobody_can_go) {
  const auto refusal_of = [](const Waypoints& w) { return error_of([&] { waypoint_trajectory(w); }); };
  EXPECT_THAT(refusal_of({.points = {{0, 0, 0}}, .speed = 1}), HasSubstr("1 points, must be at least two"));
  EXPECT_THAT(refusal_of({.points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, .speed = 1}), HasSubstr("goes straight back"));
  EXPECT_THAT(refusal_of({.points = {{0, 0, 0}, {0, 0, 0}}, .speed = 1}), HasSubstr("place of the one before"));
  EXPECT_THAT(refusal_of({.points = {{0, 0, 0}, {1, 0, 0}}}), HasSubstr("speed = 0 m/s, must be finite and > 0"));
}
