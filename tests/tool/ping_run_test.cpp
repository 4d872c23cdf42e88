// SPDX-License-Identifier: BSD-3-Clause
// One ping from the command line: what it writes, and that the same words give the same bytes.
#include <nlohmann/json.hpp>

#include "returns/compare.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string harbour_head = " --sonar p900-45 --set sonar.beams=32 --pose=0,0,-3,0,10,0 --range 2:14";

class PingRun : public ToolTest {
 protected:
  void SetUp() override { have("harbour.ply", "make-scene harbour --points 15000"); }
  ComplexGrid image(const std::string& run) const {
    return read_cube(path(run + "/cube.h5")).pings.at(0).pressure.cast<std::complex<double>>();
  }
};

}  // namespace

TEST_F(PingRun, writes_everything_and_says_what_it_did) {
  succeed("ping harbour.ply -o out" + harbour_head);
  for (const char* file : {"cube.h5", "returns.pcd", "returns.ply", "fan.png", "run.toml", "manifest.json"})
    EXPECT_TRUE(std::filesystem::exists(path(std::string("out/") + file))) << file;
  const auto manifest = manifest_of("out");
  for (const char* stage : {"load", "sampling", "acoustics", "synthesis", "output"})
    EXPECT_GT(manifest["seconds"][stage].get<double>(), 0) << stage;
  EXPECT_GT(manifest["sampling"]["scatterers"].get<int>(), 1000);
  for (const auto& note : manifest["notes"])
    EXPECT_EQ(note.get<std::string>().find("the ping is silent"), std::string::npos) << note;
  EXPECT_GT(manifest["peak_memory_mib"].get<double>(), 1);
  EXPECT_EQ(manifest["seed"], 1);
  // Every line of run.toml's [sonar] makes a sonar file again.
  EXPECT_THAT(read("out/run.toml"), HasSubstr("[sonar]"));
}

TEST_F(PingRun, same_seed_same_bytes_for_one_and_two_threads) {
  succeed("ping harbour.ply -j1 -o one --no-picture" + harbour_head);
  succeed("ping harbour.ply -j2 -o two --no-picture" + harbour_head);
  EXPECT_EQ(read("one/cube.h5"), read("two/cube.h5"));
  EXPECT_EQ(read("one/returns.pcd"), read("two/returns.pcd"));
  EXPECT_EQ(read("one/returns.ply"), read("two/returns.ply"));
}

TEST_F(PingRun, a_view_of_nothing_is_silent_and_says_so) {
  const ToolResult result = run("ping harbour.ply --sonar p900-45 --pose=30,0,3,0,-90,0 --range 2:25 -o out");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("the ping is silent"));
  EXPECT_EQ(image("out").abs().maxCoeff(), 0);
  EXPECT_TRUE(std::filesystem::exists(path("out/fan.png")));
}

TEST_F(PingRun, water_outside_the_formulas_is_computed_and_noted) {
  const ToolResult result = run("ping harbour.ply --set water.temperature_c=45 --no-picture -o out" + harbour_head);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("45")) << result.err;
  EXPECT_THAT(result.err, HasSubstr("extrapolation")) << result.err;
}

TEST_F(PingRun, settings_may_stand_before_the_scene) {
  succeed(
      "ping --set sonar.beams=8 --set water.ph=7.9 harbour.ply --sonar p900-45 --pose 0,0,-3,0,10,0 --range 2:9 "
      "--no-picture -q -o out");
  EXPECT_EQ(ping_of("out").fan.beams(), 8U);
}

TEST_F(PingRun, draws_each_view) {
  succeed("ping harbour.ply -o out --no-picture -q" + harbour_head);
  for (const std::string view : {"fan", "rect", "ascan"}) {
    succeed("image out --view " + view + " -o " + view + ".png --size 400x300 -q");
    EXPECT_EQ(read(view + ".png").substr(1, 3), "PNG");
  }
}

TEST_F(PingRun, prepared_scene_gives_the_same_ping) {
  succeed("prepare harbour.ply -o again.ply -q");
  succeed("ping harbour.ply -o one --no-picture -q" + harbour_head);
  succeed("ping again.ply -o two --no-picture -q" + harbour_head);
  EXPECT_EQ(compare_images(image("one"), image("two")).relative_l2, 0);
}

TEST_F(PingRun, info_tells_machines_what_it_tells_people) {
  const auto cloud = json_of("info harbour.ply");
  EXPECT_NEAR(cloud["points"].get<double>(), 15000, 300);
  EXPECT_TRUE(cloud["normals"].get<bool>());
  EXPECT_LE(cloud["bounds"]["max"][2].get<double>(), 1e-3);
  EXPECT_THAT(succeed("info harbour.ply"), HasSubstr("bounds"));
  write("grid.xyz", "451000.25 5411030.5 -20\n451000.75 5411030.5 -20\n451000.25 5411031.0 -20\n");
  EXPECT_THAT(succeed("info grid.xyz"), HasSubstr("y 5411030.50..5411031.00"));
  succeed("ping harbour.ply -o out --no-picture -q" + harbour_head);
  EXPECT_EQ(json_of("info out")["beams"], 32);
}

TEST_F(PingRun, sonars_show_every_number_with_its_source) {
  const auto all = json_of("sonars");
  EXPECT_GT(all.size(), 20U);
  for (const auto& sonar : all)
    for (const auto& number : sonar["numbers"]) {
      EXPECT_FALSE(number["status"].get<std::string>().empty()) << sonar["name"] << " " << number["key"];
      EXPECT_FALSE(number["source"].get<std::string>().empty()) << sonar["name"] << " " << number["key"];
    }
  EXPECT_THAT(succeed("sonars oculus-m750d"), HasSubstr("centre_frequency_hz"));
}
