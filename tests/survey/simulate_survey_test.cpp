// SPDX-License-Identifier: BSD-3-Clause
// Tests the engine of a survey: pings made, kept, left and resumed, with pings that cost nothing.
#include "survey/simulate_survey.hpp"

#include <atomic>
#include <mutex>

#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "survey/make_blocks_internal.hpp"
#include "survey/waypoint_trajectory.hpp"

using testing::ElementsAre;
using testing::UnorderedElementsAre;

namespace {

/// Ten pings in blocks of four, and their fates.
struct Pings : SurveyStore {
  std::vector<SurveyPing> pings = std::vector<SurveyPing>(10);
  std::vector<SurveyBlock> blocks;
  std::mutex guard;
  std::vector<std::int64_t> made;                         ///< numbers of the pings made
  std::map<std::int64_t, std::vector<std::string>> kept;  ///< a word for each ping of a block
  std::map<std::int64_t, BlockOutcomes> left;             ///< outcomes of blocks to resume
  std::atomic<int> before_stop = 1000;
  bool disk_is_full = false;

  Pings() {
    for (std::size_t p = 0; p < pings.size(); ++p) pings[p].number = static_cast<std::int64_t>(p);
    blocks = survey_blocks(pings, {4});
  }
  PingOutcome simulate(const SurveyPing& ping) {
    --before_stop;
    const std::scoped_lock lock(guard);
    made.push_back(ping.number);
    if (ping.number == 6) throw Error(ErrorKind::content, "no such luck");
    if (ping.number == 7) throw std::bad_alloc();
    PingOutcome outcome;
    outcome.ping.number = ping.number;
    return outcome;
  }
  BlockOutcomes resume(const SurveyBlock& block) override { return left[block.number]; }
  void keep(const SurveyBlock& block, BlockOutcomes& outcomes) override {
    if (disk_is_full) throw Error(ErrorKind::file, "the disk is full");
    auto& words = kept[block.number];
    EXPECT_TRUE(words.empty()) << "each block is kept once";
    for (const auto& r : outcomes)
      words.push_back(!r ? "-" : !r->failure.empty() ? r->failure : std::to_string(r->ping.number));
    left[block.number] = outcomes;
  }
  bool stopped() override { return before_stop <= 0; }
  bool run(int threads) {
    return make_blocks(
        pings, blocks, threads, [this](const SurveyPing& ping) { return simulate(ping); }, *this);
  }
};

/// Returns a vehicle at 2 m/s for 2 s with two heads, one of which scans, above a plane.
Mission two_heads() {
  Mission mission;
  mission.trajectory = waypoint_trajectory({.points = {{0, 0, -3}, {4, 0, -3}}, .speed = 2});
  mission.heads = {{.name = "a", .interval = 1}};
  mission.heads.push_back(mission.heads[0]);
  mission.heads[1].name = "b", mission.heads[1].scan = HeadScan{1, 2, 0.5};
  return mission;
}

}  // namespace

TEST(SimulateSurvey, keeps_whole_blocks_with_the_reasons_of_failures) {
  for (const int threads : {1, 3}) {
    Pings survey;
    EXPECT_TRUE(survey.run(threads));
    EXPECT_THAT(survey.kept[0], ElementsAre("0", "1", "2", "3"));
    EXPECT_THAT(survey.kept[1], ElementsAre("4", "5", "no such luck", "out of memory"));
    EXPECT_THAT(survey.kept[2], ElementsAre("8", "9"));
    EXPECT_EQ(survey.made.size(), 10U);
  }
}

TEST(SimulateSurvey, leaves_what_is_done_when_it_stops_and_goes_on_from_there) {
  for (const int before_stop : {1, 3, 4, 5, 9}) {
    Pings survey;
    survey.before_stop = before_stop;
    EXPECT_FALSE(survey.run(1));
    EXPECT_EQ(survey.made.size(), static_cast<std::size_t>(before_stop));
    survey.kept.clear();
    survey.before_stop = 1000;
    EXPECT_TRUE(survey.run(2));
    std::sort(survey.made.begin(), survey.made.end());
    EXPECT_THAT(survey.made, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9)) << "no ping is made twice";
    EXPECT_THAT(survey.kept[2], ElementsAre("8", "9"));
  }
}

TEST(SimulateSurvey, ends_with_what_keeping_throws) {
  Pings survey;
  survey.disk_is_full = true;
  EXPECT_EQ(error_of([&] { survey.run(2); }, ErrorKind::file), "the disk is full");
}

TEST(SimulateSurvey, gives_every_ping_its_place_motion_and_noise) {
  const PingSimulator simulator(small_head({}), {}, {.seed = 9});
  const Survey survey(two_heads(), {simulator, simulator});
  const std::vector<SurveyPing>& pings = survey.pings();
  const PingEvent event = survey.event_of(pings[3]);
  EXPECT_EQ(survey.simulator_of(pings[3]).options().seed, 9U);
  EXPECT_EQ(survey.simulator_of(pings[3]).options().threads, 1);
  EXPECT_EQ(event.time, 1);
  EXPECT_TRUE(event.motion.velocity.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_NE(event.number, survey.event_of(pings[1]).number) << "of the other head";
  SimulatedPing simulated;
  simulated.ping.number = event.number;
  const PingOutcome outcome = outcome_of(std::move(simulated), survey.mission(), pings[3]);
  EXPECT_EQ(outcome.ping.number, 1);
  EXPECT_EQ(outcome.ping.scan.value().angle, 1.5);
  EXPECT_FALSE(outcome_of({}, survey.mission(), pings[0]).ping.scan);
}

TEST(SimulateSurvey, in_memory_has_the_pings_of_single_calls_in_their_order) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 2000, .size = {8, 8}});
  const SonarHead head = small_head({.max_range = 6});
  const PingSimulator simulator(head, {}, {.synthesis = {.tolerance = 1e-2}});
  Mission mission = two_heads();
  for (Pose& pose : mission.trajectory.pose) pose.translation().z() = 3;
  mission.heads[1].vehicle_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(40), 0);
  const Survey survey(mission, {simulator, simulator}, {.coverage = true});
  for (const int threads : {1, 3}) {
    const SurveyInMemory all = simulate_survey(survey, SceneInMemory(plane), threads);
    std::size_t p = 0;
    for (const std::size_t h : {0U, 1U})
      for (const PingOutcome& outcome : all.of_head(h)) {
        const PingEvent event = survey.event_of(survey.pings().at(p++));
        const SimulatedPing single = simulator.ping(PreparedScene(plane), event);
        EXPECT_TRUE((outcome.ping.pressure == single.ping.pressure).all()) << h << ' ' << outcome.ping.number;
        EXPECT_EQ(outcome.scatterers, single.report.sampling.scatterers);
        EXPECT_EQ(outcome.covered.empty(), single.report.sampling.scatterers == 0);
      }
    EXPECT_EQ(p, survey.pings().size());
  }
}

TEST(SimulateSurvey, wants_a_simulator_for_each_head) {
  EXPECT_THAT(error_of([] { Survey(two_heads(), {PingSimulator(small_head({}), {})}); }),
              testing::HasSubstr("1 simulators for 2 heads of the mission, must be one for each"));
}
