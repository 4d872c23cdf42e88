// SPDX-License-Identifier: BSD-3-Clause
// Random poses of a vehicle over scenes of all kinds.
#include "core/error.hpp"
#include "run/mission_heads.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/test.hpp"
#include "survey/simulate_survey.hpp"
#include "tiles/tile_writer.hpp"

namespace {

const std::string posed_mission = R"(schema = 1
[survey]
scene = "SCENE"
seed = 7
[[head]]
name = "fls"
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
[randomise]
scene = "survey"
[randomise.pose]
pings = 12
box_m = [[0, -4, -4], [8, 4, -2]]
pitch_deg = [10, 30]
[ping]
scatterers_per_cell = 0
)";

MissionFile drawn_over(const std::string& scene) {
  MissionFile file = load_mission(own_file("posed-" + scene + ".toml", replaced(posed_mission, "SCENE", scene)));
  draw_poses(file, *scene_source_of(file));
  return file;
}

}  // namespace

TEST(DrawPoses, are_the_same_over_a_file_its_tiles_and_its_parts) {
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 20000});
  save_tiles(own_path("harbour.tiles"), harbour, {});
  save_scene(own_path("harbour.ply"), harbour);
  own_file("parts.toml", "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n");
  const MissionFile first = drawn_over("harbour.ply");
  ASSERT_EQ(first.mission.poses.size(), 12U);
  for (const char* name : {"harbour.tiles", "parts.toml"}) {
    const MissionFile file = drawn_over(name);
    ASSERT_EQ(file.mission.poses.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i)
      EXPECT_TRUE(file.mission.poses[i].isApprox(first.mission.poses[i])) << name << ", ping " << i;
  }
}

TEST(DrawPoses, are_those_of_the_pings_at_rest) {
  save_scene(own_path("harbour.ply"), make_built_in_scene("harbour", {.points = 20000}));
  MissionFile file = load_mission(own_file("m.toml", replaced(posed_mission, "SCENE", "harbour.ply")));
  const auto scene = scene_source_of(file);
  const Survey early(file.mission, mission_heads(file));
  EXPECT_THAT(error_with_kind([&] { early.event_of(early.pings()[0]); }), HasSubstr("has none of 0 drawn poses"));
  draw_poses(file, *scene);
  const Survey survey(file.mission, mission_heads(file), {file.randomise, file.seed, file.coverage});
  const std::vector<PingOutcome> pings = simulate_survey(survey, *scene).of_head(0);
  ASSERT_EQ(pings.size(), 12U);
  for (std::size_t i = 0; i < pings.size(); ++i) {
    EXPECT_EQ(pings[i].failure, "");
    EXPECT_EQ(pings[i].ping.time, static_cast<double>(i));
    EXPECT_TRUE(pings[i].ping.world_from_head.isApprox(file.mission.poses[i]));
    EXPECT_TRUE(pings[i].ping.motion.velocity.isZero(0));
  }
}

// Balls lie scattered anew for each ping, in a field that is hardly wider than they are.
TEST(DrawPoses, are_clear_of_the_bodies_of_their_draw) {
  save_scene(own_path("bed.ply"), make_built_in_scene("plane", {.points = 20000, .size = {10, 10}}));
  SceneCloud ball = make_built_in_scene("sphere", {.points = 2000, .radius = 0.5});
  const Bounds box = bounds(ball);
  const Eigen::Vector3f middle = ((box.min + box.max) / 2 - ball.origin).cast<float>();
  for (Eigen::Vector3f& point : ball.point) point -= middle;
  save_scene(own_path("ball.ply"), ball);
  own_file(
      "balls.toml",
      "schema = 1\n[[part]]\nfile = \"bed.ply\"\n[[scatter]]\nfiles = [\"ball.ply\"]\ncount = 3\nmin_distance_m = 0.6\n"
      "area_m = [[3, -2], [7, -2], [7, 2], [3, 2]]\n");
  const std::string mission = replaced(replaced(posed_mission, "SCENE", "balls.toml"), "[[0, -4, -4], [8, 4, -2]]",
                                       "[[3, -2, 0.6], [7, 2, 1.4]]");
  MissionFile file = load_mission(own_file(
      "balls-mission.toml", replaced(replaced(mission, "\"survey\"", "\"ping\""), "pings = 12", "pings = 40")));
  const auto scene = scene_source_of(file);
  draw_poses(file, *scene);
  const auto& open = dynamic_cast<const OpenScene&>(*scene);
  const auto nearest = [&](std::int64_t of_draw, const Pose& pose) {
    const auto cloud = open.cloud_at(open.moment_of(static_cast<double>(of_draw), of_draw));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < cloud->size(); ++i)
      least = std::min(least, (cloud->origin + cloud->point[i].cast<double>() - pose.translation()).norm());
    return least;
  };
  std::size_t too_near = 0;
  for (std::int64_t i = 0; i < 40; ++i) {
    const Pose& pose = file.mission.poses[static_cast<std::size_t>(i)];
    EXPECT_GE(nearest(i, pose), 0.4) << "ping " << i;
    too_near += nearest((i + 1) % 40, pose) < 0.4;
  }
  EXPECT_GT(too_near, 3U) << "of the bodies of other draws";
}
