// SPDX-License-Identifier: BSD-3-Clause
// Scenes on disk: a ping of what the fan reaches is the ping of the whole.
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string sonar = " --sonar p900-45 --set sonar.beams=64 --scatterers-per-cell 3 --no-picture -q";
const std::string tiles_head = sonar + " --pose=0,0,-3,0,10,0 --range 2:15";

class Tiles : public ToolTest {
 protected:
  void SetUp() override { have("harbour.ply", "make-scene harbour --points 60000"); }
};

}  // namespace

TEST_F(Tiles, a_ping_of_the_tiles_is_the_ping_of_the_cloud_byte_for_byte) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  for (const std::string& more : {std::string(), std::string(" --multipath --set surface.height_m=0")}) {
    succeed("ping harbour.ply --force -o a" + tiles_head + more);
    succeed("ping harbour.tiles --force -o b" + tiles_head + more);
    EXPECT_EQ(read("a/cube.h5"), read("b/cube.h5"));
    EXPECT_EQ(read("a/returns.ply"), read("b/returns.ply"));
  }
}

TEST_F(Tiles, a_built_in_scene_can_be_made_as_tiles) {
  succeed("prepare harbour.ply -o prepared.tiles -q");
  have("made.tiles", "make-scene harbour --points 60000");
  EXPECT_EQ(read("prepared.tiles"), read("made.tiles"));
  succeed("prepare made.tiles -o back.ply -q");
  EXPECT_EQ(read("back.ply"), read("harbour.ply"));
}

TEST_F(Tiles, the_manifest_says_how_much_was_read) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  const auto info = json_of("info harbour.tiles");
  EXPECT_EQ(info["format"], "insonify tiles");
  EXPECT_EQ(info["materials"][0], "sand");
  const auto manifest = nlohmann::json::parse(succeed("ping harbour.tiles --json -o out" + tiles_head));
  const auto& tiles = manifest["scene"]["tiles"];
  EXPECT_EQ(tiles["surfels"], info["surfels"]);
  EXPECT_EQ(tiles["tiles"], info["tiles"]);
  EXPECT_GT(tiles["surfels_read"], 0);
  EXPECT_LT(tiles["surfels_read"], tiles["surfels"]);
  EXPECT_LT(tiles["tiles_read"], tiles["tiles"]);
  EXPECT_THAT(
      succeed("plan harbour.tiles" + tiles_head.substr(0, tiles_head.find(" --no-picture")) + " --pose=0,0,-3,0,10,0"),
      HasSubstr("direct"));
}

TEST_F(Tiles, a_ping_that_sees_nothing_reads_nothing_and_is_silent) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  const auto manifest = nlohmann::json::parse(
      succeed("ping harbour.tiles --json -o out" + sonar + " --pose=0,5000,-3,90,10,0 --range 2:15"));
  EXPECT_EQ(manifest["scene"]["tiles"]["surfels_read"], 0);
  EXPECT_THAT(manifest["notes"].dump(), HasSubstr("silent"));
}

TEST_F(Tiles, what_cannot_be_pinged_is_refused) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  expect_refused("ping harbour.tiles -o out --memory-limit 0.001" + tiles_head, 4,
                 {"harbour.tiles", "need about", "GiB", "raise the limit"});
  expect_refused("ping harbour.tiles -o out --material sand" + tiles_head, 2, {"--material", "prepared already"});
  expect_refused("prepare harbour.ply -o harbour.tiles", 4, {"harbour.tiles", "exists already"});
  const std::string good = read("harbour.tiles");
  write("cut.tiles", good.substr(0, good.size() / 2));
  expect_refused("ping cut.tiles -o out" + tiles_head, 3, {"cut.tiles", "cut off"});
  expect_refused("info cut.tiles", 3, {"cut.tiles", "cut off"});
  write("text.tiles", "hello");
  expect_refused("info text.tiles", 3, {"text.tiles", "not a .tiles file"});
}
