// SPDX-License-Identifier: BSD-3-Clause
// A mission file is run by the library alone: its heads, and its scene whatever its file is.
#include "run/mission_heads.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/test.hpp"
#include "survey/simulate_survey.hpp"
#include "tiles/tile_writer.hpp"

namespace {

const std::string library_mission = R"(schema = 1
[survey]
scene = "SCENE"
seed = 7
[water]
level_m = 0.25
[trajectory]
waypoints_m = [[0, 0, -3], [2, 0, -3]]
speed_m_s = 1
[[head]]
name = "fls"
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
pitch_deg = -20
rate_hz = 2
[randomise]
source_level_db = 0.5
[ping]
noise = true
scatterers_per_cell = 0
)";

MissionFile mission_over(const std::string& scene) {
  return load_mission(own_file("over-" + scene + ".toml", replaced(library_mission, "SCENE", scene)));
}

std::vector<PingOutcome> pings_of(const MissionFile& file, const SceneSource& scene) {
  const Survey survey(file.mission, mission_heads(file), {file.randomise, file.seed, file.coverage});
  return simulate_survey(survey, scene).of_head(0);
}

}  // namespace

TEST(LibraryMission, over_a_file_or_tiles_is_that_over_their_cloud) {
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 6000});
  save_tiles(own_path("harbour.tiles"), harbour, {});
  save_scene(own_path("harbour.ply"), harbour);
  own_file("parts.toml", "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n");
  const MissionFile in_memory = mission_over("harbour.ply");
  const std::vector<PingOutcome> expected = pings_of(in_memory, SceneInMemory(harbour));
  ASSERT_EQ(expected.size(), 4U);
  for (const char* name : {"harbour.ply", "harbour.tiles"}) {
    const MissionFile file = mission_over(name);
    const std::vector<PingOutcome> pings = pings_of(file, *scene_source_of(file));
    ASSERT_EQ(pings.size(), expected.size());
    for (std::size_t i = 0; i < pings.size(); ++i)
      EXPECT_TRUE((pings[i].ping.pressure == expected[i].ping.pressure).all()) << name << ", ping " << i;
  }
  // Merged parts have a speckle of their own, which follows from the scene alone.
  const MissionFile file = mission_over("parts.toml");
  const std::vector<PingOutcome> pings = pings_of(file, *scene_source_of(file)),
                                 again = pings_of(file, *scene_source_of(file, 1));
  ASSERT_EQ(pings.size(), expected.size());
  for (std::size_t i = 0; i < pings.size(); ++i) {
    EXPECT_EQ(pings[i].failure, "");
    EXPECT_GT(pings[i].scatterers, 0U);
    EXPECT_TRUE((pings[i].ping.pressure == again[i].ping.pressure).all()) << "ping " << i;
    EXPECT_FALSE((pings[i].ping.pressure == expected[i].ping.pressure).all()) << "ping " << i;
  }
}

// The head's water is that of the mission: by its level the depth of each ping follows, and by it the speed of sound.
TEST(LibraryMission, heads_have_level_and_settings_of_the_file) {
  const MissionFile file = mission_over("harbour.ply");
  const PingSimulator head = mission_heads(file).at(0);
  EXPECT_EQ(head.environment().water_level, 0.25);
  EXPECT_EQ(head.head().fan.beams(), 16U);
  EXPECT_EQ(head.head().gate.max_range, 6);
  EXPECT_EQ(head.options().seed, 7U);
  EXPECT_TRUE(head.options().effects.noise);
  const std::string wrong = own_file("wrong.toml", library_mission + "detail_width = -1\n");
  EXPECT_THAT(error_with_kind([&] { mission_heads(load_mission(wrong)); }),
              HasSubstr("wrong.toml:22: ping.detail_width = -1, must be within 0 and 4"));
}

TEST(LibraryMission, scene_of_a_path_needs_no_mission) {
  save_tiles(own_path("bed.tiles"), make_built_in_scene("harbour", {.points = 6000}), {});
  const MissionFile file = mission_over("bed.tiles");
  const PingSimulator head = mission_heads(file).at(0);
  const PingEvent event{.world_from_head = Pose(Eigen::Translation3d(0, 0, -3))};
  const auto scene = scene_source_of(file.scene)->scene_for(head, event);
  EXPECT_GT(scene->scene().size(), 0U);
  EXPECT_LT(scene->scene().size(), 6000U) << "a ping reads what it reaches";
  EXPECT_THAT(error_with_kind([] { scene_source_of("absent.tiles"); }), HasSubstr("absent.tiles"));
}

// A ping that gives its plan is resolved once, with the bytes of one without, and the plan is that asked for alone.
TEST(LibraryMission, a_ping_gives_the_plan_that_it_follows) {
  const PreparedScene scene(make_built_in_scene("harbour", {.points = 6000}));
  const PingSimulator head = mission_heads(mission_over("harbour.ply")).at(0);
  const PingEvent event{.world_from_head = Pose(Eigen::Translation3d(0, 0, -3)), .motion = {.velocity = {1, 0, 0}}};
  PingPlan plan;
  const SimulatedPing planned = head.ping(scene, event, plan), alone = head.ping(scene, event);
  const PingPlan requested = head.plan(scene, event);
  EXPECT_TRUE((planned.ping.pressure == alone.ping.pressure).all());
  EXPECT_EQ(planned.soundings.size(), alone.soundings.size());
  EXPECT_EQ(plan.left_out_db, requested.left_out_db);
  ASSERT_EQ(plan.stages.size(), requested.stages.size());
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    EXPECT_EQ(plan.stages[i].included, requested.stages[i].included) << plan.stages[i].name;
    EXPECT_EQ(plan.stages[i].bound_db, requested.stages[i].bound_db) << plan.stages[i].name;
  }
}
