// SPDX-License-Identifier: BSD-3-Clause
// Asks the tool what a ping would compute and leave out.
#include <nlohmann/json.hpp>

#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

class Plan : public ToolTest {
 protected:
  void SetUp() override { have("plane.ply", "make-scene plane --size 20,20 --points 20000"); }
  static bool included(const nlohmann::json& plan, const std::string& name) {
    for (const auto& stage : plan["stages"])
      if (stage["name"] == name) return stage["included"];
    ADD_FAILURE() << "no stage " << name;
    return false;
  }
  const std::string ping = "plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --range 4:12 -q";
};

TEST_F(Plan, lists_stages_with_reason_and_bound_and_writes_nothing) {
  const auto plan = json_of("plan " + ping);
  int left_out = 0;
  for (const auto& stage : plan["stages"]) {
    EXPECT_FALSE(stage["why"].get<std::string>().empty()) << stage["name"];
    EXPECT_TRUE(stage["bound_relative"].is_number() || stage["bound_relative"].is_null());
    left_out += !stage["included"].get<bool>();
  }
  EXPECT_GE(left_out, 10);
  EXPECT_THAT(succeed("plan " + ping), HasSubstr("absorption-slope"));
}

TEST_F(Plan, decides_by_the_budget) {
  const auto rough = nlohmann::json::parse(succeed("plan " + ping + " --json --accuracy-db 20"));
  const auto fine = nlohmann::json::parse(succeed("plan " + ping + " --json --accuracy-db 0.001"));
  EXPECT_FALSE(included(rough, "outer-azimuths"));
  EXPECT_TRUE(included(fine, "outer-azimuths"));
  EXPECT_LT(rough["scatterers"], fine["scatterers"]);
  EXPECT_LE(rough["left_out_db"], 20);
}

TEST_F(Plan, stands_in_the_manifest_of_the_ping_that_follows_it) {
  succeed(
      "ping plane.ply --sonar p900-45 --set sonar.beams=8 --pose=0,0,3,0,15,0 --range 4:4.5 -q -o out --no-picture "
      "--with noise "
      "--with absorption-slope --keep elements");
  const auto manifest = manifest_of("out");
  EXPECT_TRUE(included(manifest["plan"], "noise"));
  EXPECT_TRUE(included(manifest["plan"], "absorption-slope"));
  EXPECT_FALSE(included(manifest["plan"], "multipath"));
  EXPECT_EQ(manifest["layers"].back()["name"], "noise");
  EXPECT_TRUE(std::filesystem::exists(path("out/elements.h5")));
}

TEST_F(Plan, refuses_stages_that_are_unknown_or_have_no_cause) {
  expect_refused("plan " + ping + " --with noize", 2, {"'noize' cannot be forced", "noise"});
  expect_refused("ping " + ping + " -o out --with multipath", 2, {"multipath", "neither surface nor bottom"});
  expect_refused("ping " + ping + " -o out --with refraction", 2, {"refraction", "no sound-speed profile"});
  expect_refused("ping " + ping + " -o out --with volume", 2, {"volume.scattering_db"});
  for (const std::string bad : {"0", "-1", "nan", "inf", "21"})
    expect_refused("plan " + ping + " --accuracy-db=" + bad, 2, {"--accuracy-db = ", "above 0 and at most 20 dB"});
  expect_refused("ping " + ping + " -o out --keep everything", 2, {"--keep"});
}

// Left out is what is in: an expected level stays one, and the direct sum takes a tolerance that gridding refuses.
TEST_F(Plan, forces_and_checks_only_the_method_in_force) {
  succeed("ping " + ping + " -q -o level --no-picture --method incoherent --without true-delays --without direct-sum");
  EXPECT_TRUE(ping_of("level").expected_level);
  EXPECT_THAT(succeed("plan " + ping + " --method direct --tolerance 1e-14"), HasSubstr("direct-sum         in"));
  expect_refused("plan " + ping + " --tolerance 1e-14", 2, {"tolerance = 1e-14", "within 1e-13 and 1", "use direct"});
}
