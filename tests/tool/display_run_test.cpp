// SPDX-License-Identifier: BSD-3-Clause
// Runs and surveys of display cells (E180) through the whole tool, and the verbs that read them.
#include "support/test.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

class DisplayRun : public ToolTest {
 protected:
  const std::string swath = "ping bed.ply --sonar oculus-m750d --pose=-1,0,3,0,20,0 --range 2:9 --noise -q ";

  void SetUp() override {
    have("bed.ply", "make-scene plane --size 12,12 --points 30000");
    have("cells", swath + "--display 200");
    have("samples", swath + "--display 200 --with phases");
  }
};

TEST_F(DisplayRun, holds_levels_in_a_small_file) {
  const Ping cells = ping_of("cells"), samples = ping_of("samples");
  EXPECT_TRUE(cells.display_cells && samples.display_cells);
  EXPECT_EQ(cells.gate.bins(), 200u);
  EXPECT_EQ(cells.gate.max_range, 9);
  EXPECT_LT(std::filesystem::file_size(path("cells/cube.h5")), 3 * 512 * 200u);
  EXPECT_NEAR(mean_level_db(cells, 4, 8), mean_level_db(samples, 4, 8), 0.1);
  EXPECT_EQ(manifest_of("cells")["pressure"], "display cells: mean intensity over area, no phase");
  EXPECT_THAT(read("cells/run.toml"), HasSubstr("display = 200"));
  succeed("ping --run cells/run.toml -o again --no-picture -q");
  EXPECT_TRUE(read("again/cube.h5") == read("cells/cube.h5"));
}

TEST_F(DisplayRun, is_read_by_pictures_comparisons_and_exports) {
  succeed("image cells -o cells.png -q");
  EXPECT_EQ(json_of("info cells/cube.h5")["holds"], "display cells");
  const auto compared = json_of("compare cells samples");
  EXPECT_LT(std::abs(compared["levels"]["bias_db"].get<double>()), 0.3) << compared;
  succeed("export cells --to png -o levels.png -q");
  expect_refused("dataset cells samples -o set -q --stuff sand", 3, {"cells/cube.h5", "has no labels"});
  EXPECT_GT(std::filesystem::file_size(path("cells.png")), 10000u);
}

TEST_F(DisplayRun, needs_samples_for_some_outputs) {
  expect_refused(swath + "--display 200 --split -o no", 2, {"--display = 200", "split"});
  expect_refused(swath + "--display 200 --keep elements -o no", 2, {"--display = 200", "samples of pressure"});
  expect_refused(swath + "--display 200 --looks-range 2 -o no", 2, {"--display = 200", "looks"});
  expect_refused(swath + "--display -3 -o no", 2, {"--display"});
  for (const char* kind : {"gsf", "las", "csv", "mcap", "geotiff"})
    expect_refused(std::string("export cells --anchor 54,8 -o no --to ") + kind, 2,
                   {"cells", "display cells", "without --display"});
  expect_refused("dataset cells -o no", 3, {"cells", "--keep contributors", "without --display"});
}

TEST_F(DisplayRun, survey_of_cells_merges) {
  write("m.toml", text_of({.scene = "bed.ply",
                           .way = "[-3, 0, 3], [0, 0, 3]",
                           .sonar = "oculus-m750d",
                           .range = "2:9",
                           .head = "rate_hz = 1",
                           .more = "[ping]\ndisplay = 100\nnoise = true"}));
  succeed("survey m.toml -o s -q");
  succeed("merge s -q");
  std::string head;
  for (const auto& entry : std::filesystem::directory_iterator(path("s")))
    if (entry.is_directory()) head = entry.path().filename().string();
  succeed("info s");
  const Cube cube = read_cube(path("s/" + head + "/cube.h5"));
  ASSERT_GE(cube.pings.size(), 3u);
  EXPECT_TRUE(cube.pings[2].display_cells);
  EXPECT_EQ(cube.pings[2].gate.bins(), 100u);
}
