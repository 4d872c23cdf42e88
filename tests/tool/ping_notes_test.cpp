// SPDX-License-Identifier: BSD-3-Clause
// Follows notes on what limits the accuracy of pings to all who ask: survey, cube, merge, info and viewer.
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

using testing::HasSubstr;
using testing::Not;

class PingNotes : public ToolTest {
 protected:
  void SetUp() override { have("coarse.ply", "make-scene plane --size 30,30 --points 600"); }
  // Pings 2 m above the plane, 1 m apart; `pings` of them.
  void mission(int pings, const std::string& file) const {
    write(file, text_of({.scene = "coarse.ply",
                         .way = "[8, 0, 2], [" + std::to_string(8 + pings) + ", 0, 2]",
                         .sonar = "p900-45",
                         .range = "1:12",
                         .head = "name = \"fls\"\nset = [\"sonar.beams=16\"]\npitch_deg = -20\nevery_m = 1"}));
  }
  static const nlohmann::json& sparse_in(const nlohmann::json& notes) {
    for (const auto& note : notes)
      if (note["kind"] == "sparse beams") return note;
    throw std::runtime_error("no such note in " + notes.dump());
  }
};

TEST_F(PingNotes, of_a_survey_reach_the_person_by_kind) {
  mission(5, "m.toml");
  const ToolResult made = run("survey m.toml --pings-per-block 2 -o run");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("fls: 5 pings, the first 0: the scene is too coarse for "));
  const Cube block = read_cube(path("run/fls/blocks/000001.h5"));
  ASSERT_FALSE(block.notes.empty());
  EXPECT_EQ(block.notes[0].kind, "sparse beams");
  EXPECT_EQ(block.notes[0].count, 2U);
  EXPECT_EQ(block.notes[0].first, 2);

  EXPECT_EQ(sparse_in(json_of("info run")["notes"])["pings"], 5);
  const ToolResult merged = run("merge run");
  EXPECT_THAT(merged.err, HasSubstr("fls: 5 pings, the first 0: the scene is too coarse for "));
  EXPECT_EQ(sparse_in(read_json("run/manifest.json")["notes"])["pings"], 5);
  for (const char* of : {"run", "run/fls", "run/fls/cube.h5"}) {
    const nlohmann::json note = sparse_in(json_of("info " + std::string(of))["notes"]);
    EXPECT_EQ(note["pings"], 5) << of;
    EXPECT_EQ(note["first_ping"], 0) << of;
    EXPECT_THAT(note["text"].get<std::string>(), HasSubstr("levels of these beams are wrong by 2 dB or more")) << of;
  }
}

// Notes of single pings stand under the numbers that their pings have in the merged run.
TEST_F(PingNotes, of_pings_are_in_their_cubes_and_in_merged_ones) {
  const std::string ping = "ping coarse.ply --sonar p900-45 --set sonar.beams=16 --range 1:12 --no-picture --ping 7 ";
  const ToolResult first = run(ping + "--pose=8,0,2,0,20,0 --time 1 -o early");
  EXPECT_THAT(first.err, HasSubstr("the scene is too coarse for "));
  succeed(ping + "--pose=9,0,2,0,20,0 --time 2 -q -o late");
  ASSERT_EQ(cube_of("late").notes.size(), 1U);
  EXPECT_THAT(first.err, HasSubstr(cube_of("early").notes[0].text));
  EXPECT_EQ(cube_of("early").notes[0].first, 7);
  EXPECT_THAT(run("merge late early -o both").err, HasSubstr("2 pings, the first 0: the scene is too coarse for "));
  EXPECT_EQ(cube_of("both").notes.at(0).count, 2U);
  EXPECT_EQ(cube_of("both").notes.at(0).text, cube_of("early").notes[0].text);
}

TEST_F(PingNotes, of_a_ping_without_any_are_absent) {
  have("dense.ply", "make-scene plane --size 8,8 --points 60000");
  succeed(
      "ping dense.ply --sonar p900-45 --set sonar.beams=8 --range 1:6 --no-picture -q -o run "
      "--pose=1,0,2,0,30,0");
  EXPECT_TRUE(cube_of("run").notes.empty());
  EXPECT_TRUE(json_of("info run")["notes"].empty());
}
