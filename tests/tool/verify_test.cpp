// SPDX-License-Identifier: BSD-3-Clause
// Files of a run against the digests of when it was made.
#include "tool/tool_runner.hpp"

namespace fs = std::filesystem;

namespace {

class Verify : public ToolTest {
 protected:
  void SetUp() override {
    have("poles.ply", "make-scene poles --points 4000");
    have("run", "ping poles.ply --no-picture --sonar p900-45 --set sonar.beams=4 --pose=0,0,0,0,0,0 --range 3:5");
  }
  void damage(const std::string& name) const {
    std::string bytes = read(name);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write(name, bytes);
  }
};

}  // namespace

TEST_F(Verify, names_what_was_changed_or_is_missing) {
  EXPECT_THAT(succeed("info --verify run"), HasSubstr("run: 4 files match the manifest"));
  damage("run/returns.ply");
  fs::remove(path("run/run.toml"));
  expect_refused("info --verify run", 3, {"run: returns.ply was changed, run: run.toml is missing"});
  const ToolResult json = run("info --verify run --json");
  EXPECT_EQ(json.exit_code, 3);
  EXPECT_THAT(json.out, HasSubstr("\"returns.ply was changed\""));
}

TEST_F(Verify, knows_runs_of_synthesize) {
  write("one.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n4,0,0,0.01,1,0\n");
  succeed("synthesize one.csv --no-picture --sonar p900-45 --set sonar.beams=4 --range 3:5 -o beams -q");
  EXPECT_THAT(succeed("info --verify beams"), HasSubstr("beams: 2 files match the manifest"));
}

TEST_F(Verify, needs_digests) {
  fs::remove(path("run/manifest.json"));
  expect_refused("info --verify run", 3, {"no manifest.json with the SHA-256"});
  write("run/manifest.json", "{\"sha256\": ");
  expect_refused("info --verify run", 3, {"manifest.json: is damaged"});
  expect_refused("info --verify poles.ply", 4, {"is no folder; --verify compares the files of a run"});
}

TEST_F(Verify, merge_refuses_a_changed_cube_and_view_says_so) {
  succeed("merge run run -o whole -q");
  EXPECT_THAT(succeed("info --verify whole"), HasSubstr("4 files match the manifest"));
  damage("run/cube.h5");
  expect_refused("merge run run -o both", 3, {"run: cube.h5 was changed since the run was made", "cube.h5 to merge"});
  const std::string line = "'" INSONIFY_TOOL "' view '" + path("run") + "' --no-scene --screenshot '" + path("v.png") +
                           "' >/dev/null 2>'" + path("err") + "'";
  EXPECT_EQ(std::system(line.c_str()), 0) << read("err");
  EXPECT_THAT(read("err"), HasSubstr("cube.h5 was changed since the run was made"));
}

TEST_F(Verify, compares_the_blocks_of_a_survey) {
  succeed(
      "make-mission lawnmower --scene poles.ply --sonar p900-45 --range 3:5 --centre 0,0,0 --size 2,1 --spacing 4 "
      "--rate 1 -o mission.toml -q");
  succeed("survey mission.toml -o survey -q");
  EXPECT_THAT(succeed("info --verify survey"), HasSubstr("files match the manifest"));
  std::string block;
  for (const auto& entry : fs::recursive_directory_iterator(path("survey")))
    if (entry.path().filename().string().ends_with(".ply")) block = fs::relative(entry.path(), folder_).string();
  ASSERT_FALSE(block.empty());
  damage(block);
  expect_refused("info --verify survey", 3, {"was changed", fs::relative(block, "survey").string()});
}
