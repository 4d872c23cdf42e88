// SPDX-License-Identifier: BSD-3-Clause
// Runs and surveys of display cells (E180) through the whole tool, and the verbs that read them.
#include "support/test.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"
#include "view/grey_file.hpp"

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

TEST_F(DisplayRun, keeps_labels_of_cells_for_data_sets_and_pictures) {
  have("harbour.ply", "make-scene harbour --points 30000");
  const std::string ping = "ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:20 --no-picture -q ";
  have("labelled", ping + "--display 150 --keep labels");
  const Ping cells = ping_of("labelled");
  EXPECT_EQ(cells.labels.material.cols(), 150);
  EXPECT_EQ(cells.labels.second_share.cols(), 150);
  EXPECT_GT((material_image(cells.labels) < PixelLabels::shadow).count(), 1000);
  EXPECT_LT(cells.labels.elevation.minCoeff(), -0.05) << "the bed is below the head";
  succeed("ping --run labelled/run.toml -o again --no-picture -q");
  EXPECT_TRUE(read("again/cube.h5") == read("labelled/cube.h5"));
  succeed("dataset labelled -o set -q --split 1:0:0");
  EXPECT_EQ(manifest_of("set")["images"], 1);
  EXPECT_GT(manifest_of("set")["boxes"]["fan"], 0);
  const GreyPicture mask = load_grey_png(path("set/polar/masks/000_000000.png"));
  EXPECT_EQ(mask.value.rows(), 150);
  succeed("image labelled --view labels -o labels.png -q");
  // Without a number of cells there are 600.
  have("usual", ping + "--keep labels");
  EXPECT_EQ(ping_of("usual").gate.bins(), 600u);
  EXPECT_THAT(read("usual/run.toml"), HasSubstr("keep = [\"labels\"]"));
  expect_refused(ping + "--keep labels,contributors -o no", 2, {"contributors", "listed by sample"});
}

TEST_F(DisplayRun, needs_samples_for_some_outputs) {
  expect_refused(swath + "--display 200 --split -o no", 2, {"--display = 200", "split"});
  expect_refused(swath + "--display 200 --keep elements -o no", 2, {"--display = 200", "samples of pressure"});
  expect_refused(swath + "--display 200 --looks-range 2 -o no", 2, {"--display = 200", "looks"});
  expect_refused(swath + "--display -3 -o no", 2, {"--display"});
  for (const char* kind : {"gsf", "las", "csv", "mcap", "geotiff"})
    expect_refused(std::string("export cells --anchor 54,8 -o no --to ") + kind, 2,
                   {"cells", "display cells", "without --display"});
  expect_refused("dataset cells -o no", 3, {"cells", "--keep labels"});
}

TEST_F(DisplayRun, survey_of_cells_merges) {
  write("m.toml", text_of({.scene = "bed.ply",
                           .way = "[-3, 0, 3], [0, 0, 3]",
                           .sonar = "oculus-m750d",
                           .range = "2:9",
                           .head = "rate_hz = 1",
                           .more = "[ping]\ndisplay = 100\nnoise = true\nkeep = [\"labels\"]"}));
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
  EXPECT_EQ(cube.pings[2].labels.second.cols(), 100);
  succeed("dataset s -o set -q");
}
