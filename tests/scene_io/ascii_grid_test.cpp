// SPDX-License-Identifier: BSD-3-Clause
// ESRI ASCII grids whose heads have other orders and cases than that of ESRI.
#include "scene_io/test_files.hpp"

TEST(AsciiGrid, is_known_by_any_word_of_its_head) {
  std::string rows;
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 16; ++c) rows += std::to_string(-5 - 0.25 * r + 0.125 * c) + " ";
    rows += "\n";
  }
  const std::vector<std::string> heads = {"ncols 16\nnrows 12\nxllcorner 100\nyllcorner 200\ncellsize 0.5\n",
                                          "NROWS 12\nNCOLS 16\nXLLCORNER 100\nYLLCORNER 200\nCELLSIZE 0.5\n",
                                          "nrows 12\nncols 16\nxllcenter 100.25\nyllcenter 200.25\ncellsize 0.5\n",
                                          "xllcorner 100\nyllcorner 200\ncellsize 0.5\nncols 16\nnrows 12\n",
                                          "cellsize 0.5\nncols 16\nnrows 12\nxllcorner 100\nyllcorner 200\n",
                                          "Ncols 16\nNrows 12\nXllcorner 100\nYllcorner 200\ndx 0.5\ndy 0.5\n"};
  for (const std::string& head : heads)
    for (const char* name : {"a.asc", "a.txt"}) {
      const LoadedScene loaded = load_scene(own_file(name, head + rows));
      ASSERT_EQ(loaded.report.points_read, 12u * 16u) << name << ": " << head;
      // The middle of the first cell of the first row, which is the northernmost.
      EXPECT_LT((world(loaded.scene, 0) - Eigen::Vector3d(100.25, 205.75, -5)).norm(), 1e-4) << name << ": " << head;
    }
}
