// SPDX-License-Identifier: BSD-3-Clause
// A mesh of two triangles from the command line: a ping samples it as its beams need; and what a display averages.
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify;

namespace {

const std::string swath =
    "ping bed.obj --no-picture -q --sonar em2040 --set sonar.beams=64 --pose=0,0,20,0,0,0 --range 18:26";

class MeshRun : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write("bed.obj", "v -200 -200 0\nv 200 -200 0\nv 200 200 0\nv -200 200 0\nf 1 2 3 4\n");
  }
};

}  // namespace

TEST_F(MeshRun, a_swath_over_a_big_bed_receives_it_in_every_beam) {
  succeed(swath + " -o fine");
  const nlohmann::json fine = manifest_of("fine");
  EXPECT_EQ(fine["sampling"]["sparse_beams"], 0);
  EXPECT_TRUE(fine["notes"].empty() || fine["notes"].dump().find("beams see") == std::string::npos) << fine["notes"];
  const Ping ping = ping_of("fine");
  const Grid<float> level = level_db(ping);
  for (Eigen::Index b = 14; b < 50; ++b) EXPECT_GT(level.row(b).maxCoeff(), 60) << b;  // 45 degrees: 28 m

  succeed("ping --run fine/run.toml -o again --no-picture -q");
  EXPECT_TRUE(read("again/cube.h5") == read("fine/cube.h5"));
}

TEST_F(MeshRun, a_spacing_asked_for_is_kept_and_its_gaps_are_noted) {
  succeed(swath + " --mesh-spacing 0.9 -o coarse");
  const nlohmann::json coarse = manifest_of("coarse");
  EXPECT_EQ(coarse["scene"]["surfels"], 197531);  // 400^2 / 0.9^2
  EXPECT_GT(coarse["sampling"]["sparse_beams"], 32);
  EXPECT_NE(coarse["notes"].dump().find("of 64 beams: their main lobes hold fewer than four surfels"),
            std::string::npos);
}

TEST_F(MeshRun, a_memory_limit_coarsens_and_is_noted) {
  succeed(swath + " --memory-limit 0.0001 -o small");  // 384 surfels
  const nlohmann::json small = manifest_of("small");
  EXPECT_LE(small["scene"]["surfels"], 384);
  EXPECT_NE(small["notes"].dump().find("the mesh is sampled by at most 384 surfels"), std::string::npos);
}

TEST_F(MeshRun, contributors_belong_to_the_surfels_of_the_ping) {
  succeed(swath + " --keep contributors,insonification -o kept");
  EXPECT_EQ(manifest_of("kept")["insonification"]["surfels"], manifest_of("kept")["scene"]["surfels"]);
}

TEST_F(MeshRun, looks_are_in_the_cube_and_in_run_toml) {
  succeed(swath + " --looks-range 2 --looks-pings 2 -o looks");
  succeed(swath + " -o single");
  const Ping looks = ping_of("looks"), single = ping_of("single");
  EXPECT_TRUE((looks.pressure == single.pressure).all());
  EXPECT_EQ(single.intensity.size(), 0);
  ASSERT_EQ(looks.intensity.size(), looks.pressure.size());
  EXPECT_NEAR(db_from_power(looks.intensity.sum() / single.pressure.abs2().sum()), 0, 1);
  succeed("ping --run looks/run.toml -o again --no-picture -q");
  EXPECT_TRUE(read("again/cube.h5") == read("looks/cube.h5"));
  expect_refused(swath + " --looks-range 0 -o no", 2, {"--looks-range"});
  expect_refused(swath + " --looks-pings 2 --method incoherent -o no", 2, {"--looks-pings = 2", "method incoherent"});
}
