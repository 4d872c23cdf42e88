// SPDX-License-Identifier: BSD-3-Clause
// Runs against runs and records through the whole tool.
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "returns/looks.hpp"
#include "scene_io/load_scene.hpp"
#include "sonar/beam_fan.hpp"
#include "store/cube.hpp"
#include "support/npy.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

class CompareRun : public ToolTest {
 protected:
  const std::string over = " --sonar p900-45 --set sonar.beams=64 --pose=0,0,3,0,15,0 --range 4:9 --no-picture -q ";

  void SetUp() override {
    have("plane.ply", "make-scene plane --size 20,20 --points 40000");
    have("one", "ping plane.ply --seed 1" + over);
    have("two", "ping plane.ply --seed 2" + over);
    have("expected", "ping plane.ply --method incoherent" + over);
  }
  nlohmann::json compared(const std::string& arguments) const {
    return nlohmann::json::parse(succeed("compare --json " + arguments));
  }
  /// Returns an .aris file of one frame: 48 beams, 250 samples of 10.5 mm from 5.25 m on, made-up levels.
  std::string recording() const {
    const auto put = [](std::string& bytes, std::size_t at, auto number) {
      std::memcpy(bytes.data() + at, &number, sizeof number);
    };
    std::string file(2048, '\0');
    for (const auto& [at, number] : {std::pair(0, 0x05464444U),
                                     {1024 + 12, 0x05464444U},
                                     {1024 + 436, 1U},
                                     {1024 + 452, 14U},
                                     {1024 + 468, 250U},
                                     {1024 + 476, 7000U},
                                     {1024 + 484, 2U},
                                     {1024 + 516, 1U}})
      put(file, static_cast<std::size_t>(at), number);
    put(file, 1024 + 464, 1500.0F);
    for (unsigned i = 0; i < 48 * 250; ++i) file += static_cast<char>(100 + (i * 7919U) % 83U);
    return file;
  }
};

TEST_F(CompareRun, of_two_seeds_prints_their_own_floor) {
  const nlohmann::json r = compared("one two -o out");
  const nlohmann::json found = r["similarity"][0], drawn = r["floor"]["drawn"];
  EXPECT_NEAR(found["psnr_db"].get<double>(), drawn["psnr_db"].get<double>(), 0.5);
  EXPECT_NEAR(found["ssim"].get<double>(), drawn["ssim"].get<double>(), 0.05);
  EXPECT_NEAR(r["floor"]["analytic"]["psnr_db"].get<double>(), 17.64, 0.05);
  EXPECT_LT(std::abs(r["levels"]["bias_db"].get<double>()), 0.5);
  EXPECT_GT(r["levels"]["kolmogorov_smirnov"]["probability"].get<double>(), 0.001);
  EXPECT_GT(r["a"]["autocorrelation_width"]["range_over_c_2b"].get<double>(), 0.5);
  EXPECT_LT(r["a"]["autocorrelation_width"]["range_over_c_2b"].get<double>(), 2);
  EXPECT_EQ(read_json("out/compare.json")["pixels"], r["pixels"]);
  for (const char* picture : {"a.png", "b.png", "difference.png", "levels.png", "correlation.png", "map.png"}) {
    EXPECT_THAT(read("out/index.html"), HasSubstr(picture));
    EXPECT_TRUE(file_exists(path(std::string("out/") + picture))) << picture;
  }
  EXPECT_THAT(succeed("compare one two"), HasSubstr("floor: two seeds, drawn"));
}

// Edges, shadows and silence before the first echo raise the similarity of two seeds, and their floor with it.
TEST_F(CompareRun, of_two_seeds_of_a_scene_with_shadows_prints_their_own_floor) {
  have("harbour.ply", "make-scene harbour --points 30000");
  const std::string ahead = " --sonar p900-45 --set sonar.beams=128 --pose=0,0,-3,0,10,0 --range 2:15 --no-picture -q ";
  for (const std::string seed : {"1", "2"}) succeed("ping harbour.ply --seed " + seed + ahead + "-o harbour-" + seed);
  const nlohmann::json r = compared("harbour-1 harbour-2");
  const nlohmann::json found = r["similarity"][0], drawn = r["floor"]["drawn"];
  EXPECT_GT(found["ssim"].get<double>(), 0.3);
  EXPECT_NEAR(found["psnr_db"].get<double>(), drawn["psnr_db"].get<double>(), 0.5);
  EXPECT_NEAR(found["ssim"].get<double>(), drawn["ssim"].get<double>(), 0.05);
}

TEST_F(CompareRun, moves_an_image_by_the_shift_that_it_finds) {
  const Grid<float> level = shown_level_db(ping_of("one"));
  Grid<float> moved = level;
  moved.rightCols(level.cols() - 5) = level.leftCols(level.cols() - 5);
  write("moved.npy", npy_of(moved));
  const nlohmann::json as_is = compared("moved.npy one"), aligned = compared("moved.npy one --align");
  EXPECT_EQ(as_is["shift"]["bins"], 5);
  EXPECT_FALSE(as_is.contains("aligned_by"));
  EXPECT_GT(as_is["similarity"][0]["mse_db2"].get<double>(), 1);
  EXPECT_EQ(aligned["aligned_by"]["bins"], 5);
  EXPECT_EQ(aligned["aligned_by"]["beams"], 0);
  EXPECT_EQ(aligned["shift"]["bins"], 0);
  EXPECT_EQ(aligned["similarity"][0]["mse_db2"], 0);
  EXPECT_THAT(succeed("compare moved.npy one --align"), HasSubstr("A was moved back by 0 beams, 5 bins"));
}

TEST_F(CompareRun, takes_pictures_and_arrays_of_the_run_itself) {
  succeed("image one --view grey --raw --window 60 --max 150 -o one.png");
  const nlohmann::json grey = compared("one one.png --scale 90:150 --window 90:150");
  EXPECT_LT(grey["similarity"][0]["mse_db2"].get<double>(), 0.25 * 0.25);  // half a step of grey
  succeed("image one --view grey --bits 16 --raw --window 60 --max 150 -o fine.png");
  EXPECT_LT(compared("one fine.png --scale 90:150 --window 90:150")["similarity"][0]["mse_db2"].get<double>(), 1e-4);
  write("one.npy", npy_of(shown_level_db(ping_of("one"))));
  EXPECT_EQ(compared("one one.npy")["similarity"][0]["mse_db2"], 0);
}

TEST_F(CompareRun, resamples_a_run_to_a_recording) {
  write("r.aris", recording());
  const nlohmann::json r = compared("one r.aris");
  EXPECT_EQ(r["b"]["kind"], "ARIS 1200");
  EXPECT_EQ(r["a"]["beams"], 48);
  EXPECT_EQ(r["a"]["bins"], 250);
  EXPECT_GT(r["pixels"], 5000);
}

TEST_F(CompareRun, ranks_a_scan_with_measured_strength) {
  // A scan whose strengths are the expected levels themselves, bent by a gain of 20 dB per decade.
  const Ping p = ping_of("expected");
  const Grid<float> level = shown_level_db(p);
  std::string rows = "x,y,z,strength\n";
  const SceneCloud scene = load_scene(path("plane.ply")).scene;
  for (std::size_t i = 0; i < scene.size(); i += 7) {
    const Eigen::Vector3d world = scene.origin + scene.point[i].cast<double>(), q = p.world_from_head.inverse() * world;
    const double bin = (q.norm() - p.gate.min_range) / p.gate.bin_size;
    const auto nearest = std::min_element(p.fan.azimuth.begin(), p.fan.azimuth.end(), [&](double a, double b) {
      const double at = cone_azimuth(q);
      return std::abs(a - at) < std::abs(b - at);
    });
    if (!(bin >= 0 && bin < static_cast<double>(p.gate.bins()))) continue;
    const float l = level(nearest - p.fan.azimuth.begin(), static_cast<Eigen::Index>(bin));
    rows += printed("%.9f,%.9f,%.9f,%.6f\n", world.x(), world.y(), world.z(),
                    amplitude_from_db(static_cast<double>(l) - 100 + 20 * std::log10(q.norm())));
  }
  write("scan.csv", rows);
  const nlohmann::json r =
      compared("expected scan.csv --strength strength --strength-unit linear --repeat scan.csv -o out");
  EXPECT_GT(r["rank_correlation_without_trend"].get<double>(), 0.999);
  EXPECT_NEAR(r["fitted_tvg_db_per_decade"].get<double>(), -20, 0.01);
  EXPECT_LT(r["deviation_without_trend_db"].get<double>(), 0.01);
  EXPECT_LT(r["ceiling_of_speckle_without_trend"].get<double>(), 0.99);
  EXPECT_NEAR(r["ceiling_of_repeat"].get<double>(), 1, 1e-9);
  EXPECT_TRUE(file_exists(path("out/points.png")));
  expect_refused("compare expected scan.csv --strength loudness", 3, {"scan.csv", "no field 'loudness'", "strength"});
  expect_refused("compare one.npy scan.csv --strength strength", 4, {"one.npy"});
  write("far.csv", "x,y,z,strength\n900,0,0,1\n901,0,0,1\n902,0,0,1\n");
  expect_refused("compare expected far.csv --strength strength", 3, {"far.csv", "0 of 3 points", "one frame"});
}

TEST_F(CompareRun, refuses_records_that_do_not_fit) {
  write("other.npy", "PK");
  expect_refused("compare one other.npy", 3, {"other.npy", "does not begin as a .npy file"});
  write("small.npy", npy_of(Grid<float>::Constant(20, 30, 50)));
  expect_refused("compare one small.npy", 3, {"one has 64 beams", "small.npy 20 x 30", "small.npy has no geometry"});
  expect_refused("compare small.npy small.npy -o out --repeat x", 2, {"--repeat goes with --strength"});
  succeed("image one --view grey -o grey.png");
  expect_refused("compare one grey.png", 2, {"--scale must be given for", "grey.png"});
  expect_refused("compare one grey.png --scale 9", 2, {"--scale = '9' is not MIN:MAX"});
  const std::string png = read("grey.png");
  write("cut.png", png.substr(0, png.size() / 2));
  expect_refused("compare one cut.png --scale 40:100", 3, {"cut.png", "truncated"});
  succeed("image one -o colours.png");
  expect_refused("compare one colours.png --scale 40:100", 3, {"colours.png", "channels, must have one"});
  const std::string aris = recording();
  write("cut.aris", aris.substr(0, aris.size() - 9));
  expect_refused("compare one cut.aris", 3, {"cut.aris", "ends within frame 0", "truncated"});
  std::string swapped = aris;
  std::reverse(swapped.begin(), swapped.begin() + 4);
  write("swapped.aris", swapped);
  expect_refused("compare one swapped.aris", 3, {"swapped.aris", "other byte order"});
  std::string bare = aris;
  bare[1024 + 452] = '\0';
  write("bare.aris", bare);
  expect_refused("compare one bare.aris", 3, {"bare.aris", "has no geometry"});
  expect_refused("compare one notes.txt", 4, {"notes.txt: no such run or record"});
  write("notes.txt", "x");
  expect_refused("compare one notes.txt", 2, {"notes.txt", "must be a run directory"});
  have("far", "ping plane.ply --sonar p900-45 --set sonar.beams=8 --pose=0,0,3,0,15,0 --range 10:11 --no-picture -q ");
  expect_refused("compare one far", 3, {"one, far: ", "do not overlap: 4 to 9 m and 10 to 11 m"});
  expect_refused("compare one two --ping 3", 2, {"--ping = 3", "below 1"});
  write("silent.npy", npy_of(Grid<float>::Constant(64, static_cast<Eigen::Index>(ping_of("one").gate.bins()), -200)));
  expect_refused("compare one silent.npy", 3, {"one, silent.npy: ", "no pixel has a level in both"});
}
