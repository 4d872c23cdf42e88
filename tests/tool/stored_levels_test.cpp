// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail beside a prepared cloud: pings use them as long as they belong to its very bytes.
#include "tool/survey_fixture.hpp"

namespace {

const std::string sent = " --sonar p900-45 --set sonar.beams=64 --pose=0,0,-3,0,10,0 --range 2:15 --no-picture --force";

class StoredLevels : public ToolTest {
 protected:
  void SetUp() override {
    have("harbour.ply", "make-scene harbour --points 60000");
    succeed("prepare harbour.ply -o bay.ply --levels -q");
  }
  nlohmann::json manifest_of_ping(const std::string& of, const std::string& run, const std::string& more = "") const {
    return json_of("ping " + of + " -q -o " + run + sent + more);
  }
};

bool merges(const nlohmann::json& manifest) {
  for (const auto& stage : manifest["plan"]["stages"])
    if (stage["name"] == "detail") return stage["included"];
  return false;
}

}  // namespace

TEST_F(StoredLevels, give_the_ping_of_the_cloud_byte_for_byte_and_read_less) {
  EXPECT_EQ(read("bay.ply"), read("harbour.ply"));
  for (const std::string& more : {std::string(), std::string(" --with detail")}) {
    const auto all = manifest_of_ping("harbour.ply", "a", more), some = manifest_of_ping("bay.ply", "b", more);
    EXPECT_EQ(read("a/cube.h5"), read("b/cube.h5"));
    EXPECT_EQ(read("a/returns.ply"), read("b/returns.ply"));
    EXPECT_FALSE(all["scene"].contains("tiles"));
    EXPECT_EQ(some["scene"]["path"], "bay.ply");
    EXPECT_EQ(some["scene"]["tiles"]["path"], "bay.ply.tiles");
    EXPECT_LT(some["scene"]["tiles"]["surfels_read"], some["scene"]["tiles"]["surfels"]);
    EXPECT_EQ(merges(some), !more.empty());
  }
  EXPECT_THAT(succeed("info bay.ply"), HasSubstr("levels     bay.ply.tiles, "));
}

TEST_F(StoredLevels, are_those_of_any_prepared_cloud) {
  for (const std::string& arguments : {std::string("-o bay.pcd"), std::string("-o thin.ply --thin 0.3")}) {
    const std::string name = arguments.substr(3, arguments.find(' ', 3) - 3);
    const auto report = json_of("prepare bay.ply -q --levels " + arguments);
    EXPECT_EQ(report["levels"]["output"], name + ".tiles");
    EXPECT_EQ(report["levels"]["bytes"], std::filesystem::file_size(path(name + ".tiles")));
    const auto with = manifest_of_ping(name, "with");
    std::filesystem::remove(path(name + ".tiles"));
    const auto without = manifest_of_ping(name, "without");
    EXPECT_TRUE(with["scene"].contains("tiles") && !without["scene"].contains("tiles"));
    EXPECT_EQ(read("with/cube.h5"), read("without/cube.h5"));
  }
}

// A byte of the cloud changes, its size and its time stay; then the file is that of a newer cloud.
TEST_F(StoredLevels, of_another_cloud_are_not_used) {
  const auto time = std::filesystem::last_write_time(path("bay.ply"));
  const std::string good = read("bay.ply");
  std::string changed = good;
  changed[good.size() - 20] = static_cast<char>(changed[good.size() - 20] ^ 1);
  for (const std::string& bytes : {changed, good + '\0'}) {
    write("bay.ply", bytes);
    std::filesystem::last_write_time(path("bay.ply"), time);
    const auto manifest = manifest_of_ping("bay.ply", "out");
    EXPECT_FALSE(manifest["scene"].contains("tiles"));
    EXPECT_THAT(manifest["notes"].dump(), HasSubstr("bay.ply.tiles is not used: it holds no levels of this bay.ply"));
    const auto info = json_of("info bay.ply");
    EXPECT_FALSE(info.contains("levels"));
    EXPECT_THAT(info["problems"].dump(), HasSubstr("insonify prepare --levels, or remove it"));
  }
  write("bay.ply", good);
  EXPECT_TRUE(manifest_of_ping("bay.ply", "out")["scene"].contains("tiles"));
  // Tiles that were prepared on their own belong to no cloud.
  succeed("prepare harbour.ply -o bay.ply.tiles -q --force");
  EXPECT_FALSE(manifest_of_ping("bay.ply", "out")["scene"].contains("tiles"));
}

TEST_F(StoredLevels, stand_aside_where_options_change_the_scene) {
  const auto manifest = manifest_of_ping("bay.ply", "out", " --material sand");
  EXPECT_FALSE(manifest["scene"].contains("tiles"));
  EXPECT_THAT(manifest["notes"].dump(), HasSubstr("it holds levels of the scene without --material"));
}

TEST_F(StoredLevels, that_are_damaged_are_refused_with_a_remedy) {
  const std::string good = read("bay.ply.tiles");
  write("bay.ply.tiles", good.substr(0, good.size() / 2));
  expect_refused("ping bay.ply -o out" + sent, 3,
                 {"bay.ply.tiles", "cut short", "levels of bay.ply: insonify prepare --levels --force"});
  std::string damaged = good;
  for (std::size_t at = good.size() / 10; at < good.size() / 7; at += 500)  // within the points
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
  write("bay.ply.tiles", damaged);
  expect_refused("ping bay.ply -o out" + sent, 3, {"bay.ply.tiles", "is damaged", "copy or make the file again"});
}

TEST_F(StoredLevels, replace_no_file_and_no_surface) {
  expect_refused("prepare harbour.ply -o bay.ply --levels", 4, {"bay.ply", "exists already"});
  std::filesystem::remove(path("bay.ply"));
  expect_refused("prepare harbour.ply -o bay.ply --levels", 4, {"bay.ply.tiles", "exists already"});
  succeed("prepare harbour.ply -o bay.ply --levels --force -q");
  expect_refused("prepare harbour.ply -o x.tiles --levels", 2, {"--levels", "x.tiles holds levels itself"});
  write("bed.obj", "v 0 0 0\nv 3 0 0\nv 3 3 0.5\nv 0 3 0\nf 1 2 3\nf 1 3 4\n");
  expect_refused("prepare bed.obj -o bed.ply --levels", 2, {"--levels", "bed.obj has a surface between its points"});
}

// Surveys may merge what a cloud alone would not, so one that was begun without levels does not go on with them.
TEST_F(StoredLevels, are_read_by_surveys_and_tell_them_apart) {
  write("m.toml", replaced(survey_mission, "harbour.ply", "bay.ply"));
  succeed("survey m.toml -o with -q");
  std::filesystem::rename(path("bay.ply.tiles"), path("away"));
  expect_refused("survey m.toml -o with", 3, {"another mission"});
  succeed("survey m.toml -o without -q");
  for (const std::string& run : {std::string("with"), std::string("without")}) succeed("merge " + run + " -q");
  EXPECT_EQ(read("with/fls/cube.h5"), read("without/fls/cube.h5"));
}
