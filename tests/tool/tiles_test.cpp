// SPDX-License-Identifier: BSD-3-Clause
// Scenes on disk: a ping of what the fan reaches is the ping of the whole.
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "scene_io/load_scene.hpp"
#include "store/contributor_file.hpp"
#include "support/test.hpp"
#include "support/tile_parts.hpp"
#include "tiles/tiled_scene.hpp"
#include "tool/survey_fixture.hpp"

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

TEST_F(Tiles, a_ping_with_detail_is_that_of_the_cloud_and_reads_less) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  const std::string head = sonar + " --pose=0,0,-3,0,10,0 --range 2:30 --keep contributors --force";
  for (const std::string& more : {std::string(" --with detail"), std::string(" --detail-spacing 0.5")}) {
    succeed("ping harbour.ply -o a" + head + more);
    const auto manifest = nlohmann::json::parse(succeed("ping harbour.tiles --json -o b" + head + more));
    EXPECT_EQ(read("a/cube.h5"), read("b/cube.h5"));
    EXPECT_EQ(read("a/returns.ply"), read("b/returns.ply"));
    const Contributors a = read_contributor_file(path("a/contributors.h5")).contributors,
                       b = read_contributor_file(path("b/contributors.h5")).contributors;
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.material, b.material);
    const auto& tiles = manifest["scene"]["tiles"];
    EXPECT_LT(tiles["bytes_read"].get<double>(), 0.8 * tiles["bytes"].get<double>());  // most is near here
    EXPECT_LT(2 * tiles["surfels_read"].get<double>(), tiles["surfels"].get<double>());
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

TEST_F(Tiles, h5py_reads_the_surfels_as_the_page_says) {
  const std::string python = "cd " + path("") + " && /usr/bin/python3 ";
  if (std::system((python + "-c 'import h5py' 2>absent.txt").c_str()) != 0)
    GTEST_SKIP() << "python3-h5py is not installed";
  succeed("prepare harbour.ply -o harbour.tiles -q");
  std::istringstream page(file_bytes(INSONIFY_ROOT "/docs/scene-files.md"));
  std::string code;
  for (std::string line; std::getline(page, line) && !(line == "```" && !code.empty());)
    if (line == "import h5py" || !code.empty()) code += line + "\n";
  write("read.py", code + R"x(
import numpy
every = tiles["tile"][:]
assert (every["first"][1:] == (every["first"] + every["count"])[:-1]).all() and every["count"].sum() == len(tiles["id"])
order = numpy.argsort(tiles["id"][:])
print(repr(float(tiles["point"][:][order][1234, 0])), tiles["material"][:][order][1234], tiles["point"].attrs["units"])
)x");
  ASSERT_EQ(std::system((python + "read.py >said.txt").c_str()), 0);
  const SceneCloud scene = load_scene(path("harbour.ply")).scene;
  const TiledScene tiled(path("harbour.tiles"));
  const std::string said = read("said.txt");
  std::istringstream words(said.substr(said.rfind(']') + 1));
  double area = 0, x = 0;
  std::size_t material = 0;
  std::string unit;
  ASSERT_TRUE(words >> area >> x >> material >> unit) << said;
  TileSelection first = tiled.select_all();
  first.tiles = {0};
  const SceneCloud tile = tiled.load(first);
  EXPECT_NEAR(area, std::accumulate(tile.area.begin(), tile.area.end(), 0.0), 1e-4 * area);
  EXPECT_EQ(static_cast<float>(x), scene.point[1234].x());
  EXPECT_EQ(material, scene.material[1234]);
  EXPECT_EQ(unit, "m");
  EXPECT_THAT(said, HasSubstr("insonify material 0"));
}

TEST_F(Tiles, what_cannot_be_pinged_is_refused) {
  succeed("prepare harbour.ply -o harbour.tiles -q");
  expect_refused("ping harbour.tiles -o out --memory-limit 0.001" + tiles_head, 4,
                 {"harbour.tiles", "need about", "GiB", "raise the limit"});
  expect_refused("ping harbour.tiles -o out --material sand" + tiles_head, 2, {"--material", "prepared already"});
  expect_refused("prepare harbour.ply -o harbour.tiles", 4, {"harbour.tiles", "exists already"});
  const std::string good = read("harbour.tiles");
  write("cut.tiles", good.substr(0, good.size() / 2));
  expect_refused("ping cut.tiles -o out" + tiles_head, 3, {"cut.tiles", "cut short"});
  expect_refused("info cut.tiles", 3, {"cut.tiles", "cut short"});
  write("text.tiles", "hello");
  expect_refused("info text.tiles", 3, {"text.tiles", "not a .tiles file"});
  expect_refused("prepare text.tiles -o x.ply", 3, {"text.tiles", "not a .tiles file", "insonify prepare SCENE -o"});
}

TEST_F(Tiles, values_of_no_surfel_are_named_by_file_and_row_whatever_reads_them) {
  have("small.tiles", "make-scene plane --points 400");
  write("m.toml", replaced(survey_mission, "harbour.ply", "bad.tiles"));
  succeed("ping small.tiles -o whole" + tiles_head);
  const TileParts good = load_tile_parts(path("small.tiles"));
  const std::vector<std::pair<std::string, std::function<void(SceneCloud&)>>> damages = {
      {"bad.tiles: row 24: normal = (0, 0, 0), must be", [](SceneCloud& s) { s.normal[24].setZero(); }},
      {"bad.tiles: row 24: material = 77, must be", [](SceneCloud& s) { s.material[24] = 77; }}};
  for (const auto& [said, damage] : damages) {
    TileParts parts = good;
    damage(parts.rows);
    save_tile_parts(parts, path("bad.tiles"));
    for (const std::string& arguments :
         {std::string("info bad.tiles"), "ping bad.tiles -o x" + tiles_head, std::string("prepare bad.tiles -o x.ply"),
          std::string("image bad.tiles --view scene -o x.png"), std::string("survey m.toml --plan")})
      expect_refused(arguments, 3, {said});
  }
  TileParts parts = good;
  parts.node.at(0).area = -1;
  save_tile_parts(parts, path("bad.tiles"));
  expect_refused("ping bad.tiles -o x --with detail" + tiles_head, 3, {"bad.tiles: node 0: area = -1, must be"});
}
