// SPDX-License-Identifier: BSD-3-Clause
// The program on a survey's folder.
#include "core/units.hpp"
#include "store/cube.hpp"
#include "tool/survey_fixture.hpp"
#include "viewer/viewer_explain.hpp"

namespace {

class ViewSurvey : public SurveyTest {
 protected:
  std::string shown(const std::string& arguments) const {
    return succeed("view " + arguments + " --size 800x600 --force --screenshot a.png -q");
  }
};

}  // namespace

// From its shards and merged, as a whole and by the folder of a head, a survey looks the same.
TEST_F(ViewSurvey, is_played_from_shards_and_merged) {
  survey("run");
  EXPECT_THAT(shown("run --ping 5 --events 'select 3 200'"), HasSubstr("Ping 5, beam 3, bin 200"));
  const std::string from_shards = read("a.png");
  succeed("merge run -q");
  shown("run/fls --ping 5 --events 'select 3 200'");
  EXPECT_EQ(read("a.png"), from_shards);
  EXPECT_THAT(shown("run --head turning --ping 3 --no-scene --events 'select 0 9; key End; select 0 9'"),
              AllOf(HasSubstr("Turn of the head -135.00°"), HasSubstr("Ping 12, ")));
  // The blocks are not needed once they are copied.
  succeed("merge run --copy -q");
  for (const char* head : {"fls", "turning"}) std::filesystem::remove_all(path("run/" + std::string(head) + "/blocks"));
  EXPECT_THAT(shown("run --ping 5 --no-scene --events 'select 3 200'"), HasSubstr("Ping 5, beam 3, bin 200"));
}

TEST_F(ViewSurvey, says_what_is_missing) {
  survey("run", "--shard 1/2");
  const ToolResult result = run("view run --size 800x600 --no-scene --screenshot a.png --events 'select 0 3'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("3 of 5 blocks of fls are not done yet"));
  EXPECT_THAT(result.err, HasSubstr("other heads too: --head turning"));
  EXPECT_THAT(result.out, HasSubstr("Ping 3, "));  // the first of block 1
  expect_refused("view run --head sonar --screenshot b.png", 2,
                 {"--head = 'sonar' is not in run; it has fls, turning"});
  expect_refused("view harbour.ply --head fls --sonar p900-45 --pose=0,0,0,0,0,0 --screenshot b.png", 2, {"--head"});
}

// A ball that moves across is explained where it is at the time of each ping, without labels in the cube.
TEST_F(ViewSurvey, has_moving_parts_where_they_are_at_each_ping) {
  have("ball.ply", "make-object sphere --set diameter_m=0.8");
  write("scene.toml",
        "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n[[part]]\nfile = \"ball.ply\"\nposition_m = [3.5, 1, -3]\n"
        "velocity_mps = [0, -2, 0]\n");
  write("m.toml",
        "schema = 1\n[survey]\nscene = \"scene.toml\"\n[trajectory]\nwaypoints_m = [[0, 0, -3], [0.0025, 0, -3]]\n"
        "speed_m_s = 0.001\n[[head]]\nname = \"fls\"\nsonar = \"p900-45\"\nrange = \"1:6\"\n"
        "set = [\"sonar.beams=33\"]\nrate_hz = 1\n");
  survey("run");
  succeed("merge run -q");
  const Cube cube = read_cube(path("run/fls/cube.h5"));
  ASSERT_GE(cube.pings.size(), 2U);
  for (const std::size_t ping : {0U, 1U})
    for (const std::size_t at : {0U, 1U}) {
      // The face of the ball towards the head.
      const Eigen::Vector3d centre(3.5, 1 - 2.0 * static_cast<double>(at), -3), head(0, 0, -3);
      const auto position = position_of(cube.pings[ping], centre - 0.38 * (centre - head).normalized());
      ASSERT_TRUE(position);
      const std::string said = shown("run --ping " + std::to_string(ping) + " --events 'select " +
                                     std::to_string(position->beam) + " " + std::to_string(position->bin) + "'");
      EXPECT_THAT(said, ping == at ? testing::Matcher<std::string>(HasSubstr("Part ball"))
                                   : testing::Not(HasSubstr("Part ball")))
          << ping << " at " << at;
    }
}

// Both heads of a side-scan are shown, unless one is named. Depths are those below the datum of the mission.
TEST_F(ViewSurvey, shows_both_sides_of_a_side_scan) {
  write("m.toml", R"(schema = 1
[survey]
scene = "harbour.ply"
[water]
level_m = 0
datum = "MSL"
[trajectory]
waypoints_m = [[0, 0, -3], [3, 0, -3]]
speed_m_s = 1
[[head]]
name = "left"
sonar = "starfish-450"
range = "1:8"
rate_hz = 1
[[head]]
name = "right"
sonar = "starfish-450"
side = "starboard"
range = "1:8"
rate_hz = 1
)");
  survey("run");
  EXPECT_THAT(shown("run --ping 1 --events 'select 1 200'"), HasSubstr("Ping 1, beam 1, bin 200"));
  const std::string both = read("a.png");
  EXPECT_THAT(shown("run --head right --ping 1 --events 'select 0 200'"), HasSubstr("Ping 1, beam 0, bin 200"));
  EXPECT_NE(read("a.png"), both);
  expect_refused("view run --head left --beam 1 --screenshot b.png", 2, {"--beam = 1", "below 1"});
  expect_refused("view run --beam 2 --screenshot b.png", 2, {"--beam = 2", "below 2"});
}
