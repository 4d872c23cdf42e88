// SPDX-License-Identifier: BSD-3-Clause
// Expected levels and hole masks through the whole tool.
#include <nlohmann/json.hpp>

#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

class ExpectedLevelRun : public ToolTest {
 protected:
  const std::string over = " --sonar p900-45 --pose=0,0,3,0,15,0 --range 4:10 -q ";

  void SetUp() override { have("plane.ply", "make-scene plane --size 20,20 --points 40000"); }
};

TEST_F(ExpectedLevelRun, is_labelled_in_cube_and_manifest_and_smooth) {
  succeed("ping plane.ply -o smooth --method incoherent --scatterers-per-cell 40 --no-picture" + over);
  succeed("ping plane.ply -o speckle --no-picture" + over);
  EXPECT_EQ(manifest_of("smooth")["pressure"], "expected level, no speckle");
  EXPECT_FALSE(manifest_of("speckle").contains("pressure"));
  const Ping smooth = ping_of("smooth"), speckle = ping_of("speckle");
  EXPECT_TRUE(smooth.expected_level);
  EXPECT_FALSE(speckle.expected_level);
  EXPECT_NEAR(mean_level_db(smooth, 7, 9), mean_level_db(speckle, 7, 9), 0.25);  // 0.05 dB of speckle
  const auto contrast = [](const Ping& p) {  // of the intensity at 8 m: 1 in speckle
    const auto power = p.pressure.col(static_cast<Eigen::Index>(4 / p.gate.bin_size)).abs2();
    const float mean = power.mean();
    return std::sqrt((power - mean).square().mean()) / mean;
  };
  EXPECT_GT(contrast(speckle), 0.6);
  EXPECT_LT(contrast(smooth), 0.4);
}

TEST_F(ExpectedLevelRun, of_scatterers_is_labelled_too) {
  write("one.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n7,0,0,0.01,0.6,0.8\n");
  succeed("synthesize one.csv -o one --method incoherent --sonar p900-45 --range 4:10 --no-picture -q");
  EXPECT_EQ(manifest_of("one")["pressure"], "expected level, no speckle");
  EXPECT_TRUE(ping_of("one").expected_level);
}

TEST_F(ExpectedLevelRun, keeps_the_mask_of_holes_if_asked) {
  succeed("ping plane.ply -o out --keep mask --no-picture" + over);
  EXPECT_EQ(manifest_of("out")["holes"]["unknown"], 0);
  const Ping p = ping_of("out");
  ASSERT_EQ(p.unknown.size(), p.pressure.size());
  EXPECT_EQ(p.unknown.cast<int>().sum(), 0);
}

TEST_F(ExpectedLevelRun, refuses_what_makes_no_sense) {
  const std::string ping = "ping plane.ply -o out" + over;
  expect_refused(ping + "--method incoherent --keep elements", 2,
                 {"--keep elements: must be left out", "method incoherent", "use gridded"});
}
