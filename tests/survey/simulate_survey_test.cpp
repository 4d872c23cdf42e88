// The engine of a survey: what is made, kept, left and resumed, with pings that cost nothing.
#include "survey/simulate_survey.hpp"

#include <atomic>
#include <mutex>

#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "survey/waypoint_trajectory.hpp"

using testing::ElementsAre;
using testing::UnorderedElementsAre;

namespace {

/// 10 pings in blocks of four, and what became of them.
struct Survey {
  std::vector<SurveyPing> pings = std::vector<SurveyPing>(10);
  std::vector<SurveyBlock> blocks;
  std::mutex guard;
  std::vector<std::int64_t> made;                         ///< numbers of pings
  std::map<std::int64_t, std::vector<std::string>> kept;  ///< of each block: a word for each ping
  std::map<std::int64_t, BlockReturns> left;              ///< to resume
  std::atomic<int> before_stop = 1000;
  SurveyWork work;

  Survey() {
    for (std::size_t p = 0; p < pings.size(); ++p) pings[p].number = static_cast<std::int64_t>(p);
    blocks = survey_blocks(pings, {4});
    work.simulate = [this](const SurveyPing& ping) {
      --before_stop;
      const std::scoped_lock lock(guard);
      made.push_back(ping.number);
      if (ping.number == 6) throw Error(ErrorKind::content, "no such luck");
      if (ping.number == 7) throw std::bad_alloc();
      SurveyReturn returned;
      returned.ping.number = ping.number;
      return returned;
    };
    work.done = [](const SurveyReturn*) {};
    work.resume = [this](const SurveyBlock& block) { return left[block.number]; };
    work.keep = [this](const SurveyBlock& block, BlockReturns& returns) {
      auto& words = kept[block.number];
      EXPECT_TRUE(words.empty()) << "each block is kept once";
      for (const auto& r : returns)
        words.push_back(!r ? "-" : !r->failure.empty() ? r->failure : std::to_string(r->ping.number));
      left[block.number] = returns;
    };
    work.stop = [this] { return before_stop <= 0; };
  }
  bool run(int threads) { return simulate_survey(pings, blocks, threads, work); }
};

}  // namespace

TEST(SimulateSurvey, keeps_whole_blocks_with_the_reasons_of_failures) {
  for (const int threads : {1, 3}) {
    Survey survey;
    EXPECT_TRUE(survey.run(threads));
    EXPECT_THAT(survey.kept[0], ElementsAre("0", "1", "2", "3"));
    EXPECT_THAT(survey.kept[1], ElementsAre("4", "5", "no such luck", "out of memory"));
    EXPECT_THAT(survey.kept[2], ElementsAre("8", "9"));
    EXPECT_EQ(survey.made.size(), 10U);
  }
}

TEST(SimulateSurvey, leaves_what_is_done_when_it_stops_and_goes_on_from_there) {
  for (const int before_stop : {1, 3, 4, 5, 9}) {
    Survey survey;
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
  Survey survey;
  survey.work.keep = [](const SurveyBlock&, BlockReturns&) { throw Error(ErrorKind::file, "the disk is full"); };
  EXPECT_EQ(error_of([&] { survey.run(2); }, ErrorKind::file), "the disk is full");
}

TEST(SimulateSurvey, gives_every_ping_its_place_motion_and_noise) {
  Mission mission;
  mission.trajectory = waypoint_trajectory({.points = {{0, 0, -3}, {4, 0, -3}}, .speed = 2});
  mission.heads = {{.name = "a", .interval = 1, .listening_time = 0.1}};
  mission.heads.push_back(mission.heads[0]);
  mission.heads[1].name = "b", mission.heads[1].scan = HeadScan{1, 2, 0.5};
  const std::vector<SurveyPing> pings = survey_pings(mission);
  const SimulationOptions options = options_of({.seed = 9}, pings[3], place_of(mission, pings[3]));
  EXPECT_EQ(options.seed, 9U);
  EXPECT_EQ(options.time, 1);
  EXPECT_EQ(options.threads, 1);
  EXPECT_TRUE(options.effects.motion.velocity.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_NE(options.ping, options_of({}, pings[1], place_of(mission, pings[1])).ping) << "of the other head";
  SimulatedPing simulated;
  simulated.ping.number = options.ping;
  const SurveyReturn returned = return_of(std::move(simulated), mission, pings[3]);
  EXPECT_EQ(returned.ping.number, 1);
  EXPECT_EQ(returned.ping.scan.value().angle, 1.5);
  EXPECT_FALSE(return_of({}, mission, pings[0]).ping.scan);
}
