// SPDX-License-Identifier: BSD-3-Clause
// Tests that one ping of each head decides for all of its pings in a survey if they merge surfels.
#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "survey/simulate_survey.hpp"
#include "survey/waypoint_trajectory.hpp"

namespace {

const SonarHead detail_survey_head = small_head({.min_range = 1, .max_range = 25});

const SceneInMemory& surveyed_harbour() {
  static const SceneInMemory scene(make_built_in_scene("harbour", {.points = 600000}));
  return scene;
}

/// So many seconds over the harbour at 0.1 m/s, two pings a second of each of two heads: of images, and of pressures.
Survey survey_of_images(double seconds) {
  Mission mission;
  mission.trajectory = waypoint_trajectory({.points = {{0, 0, -3}, {0.1 * seconds, 0, -3}}, .speed = 0.1});
  mission.heads = {{.name = "images", .interval = 0.5}};
  mission.heads.push_back(mission.heads[0]);
  mission.heads[1].name = "pressures";
  return Survey(mission, {PingSimulator(detail_survey_head, {}, {.outputs = {.display_bins = 100}}),
                          PingSimulator(detail_survey_head, {})});
}

Choice detail_of_head(const Survey& survey, std::size_t head) { return survey.options_of(head).sampling.detail; }

/// A scene that cannot be had.
struct NoScene : SceneSource {
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator&, const PingEvent&) const override {
    throw Error(ErrorKind::content, "no scene today");
  }
};

}  // namespace

TEST(SurveyDetail, is_decided_for_the_images_of_many_pings) {
  const Survey survey = survey_of_images(6);
  for (const int threads : {1, 2}) {
    const Survey decided = survey.decided(surveyed_harbour(), threads);
    EXPECT_EQ(detail_of_head(decided, 0), Choice::always);
    EXPECT_EQ(detail_of_head(decided, 1), Choice::as_needed) << "pressures";
    EXPECT_EQ(decided.options_of(0).threads, 1);
  }
  EXPECT_EQ(detail_of_head(survey_of_images(2).decided(surveyed_harbour()), 0), Choice::as_needed) << "five pings";
}

TEST(SurveyDetail, is_that_of_all_pings_whichever_are_made) {
  const Survey survey = survey_of_images(6), decided = survey.decided(surveyed_harbour());
  SurveyInMemory made;
  SurveyBlock last = survey.blocks(1).at(11);
  ASSERT_EQ(last.head, 0U);
  simulate_survey(survey, {last}, surveyed_harbour(), made);
  const PingOutcome one = made.of_head(0).at(0),
                    again = decided.simulate(survey.pings().at(last.begin), surveyed_harbour()),
                    all = survey.simulate(survey.pings().at(last.begin), surveyed_harbour());
  EXPECT_TRUE((one.ping.pressure == again.ping.pressure).all());
  EXPECT_FALSE((one.ping.pressure == all.ping.pressure).all());
}

TEST(SurveyDetail, leaves_it_to_the_pings_to_say_why_there_is_no_scene) {
  const Survey survey = survey_of_images(6);
  EXPECT_EQ(detail_of_head(survey.decided(NoScene()), 0), Choice::as_needed);
  SurveyInMemory made;
  simulate_survey(survey, {survey.blocks(1).front()}, NoScene(), made);
  EXPECT_EQ(made.of_head(0).at(0).failure, "no scene today");
}
