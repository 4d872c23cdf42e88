// SPDX-License-Identifier: BSD-3-Clause
// Runs that look right and are not say so: profiles that end above the bed, gaps of trajectories, heads beside their scene,
// depths without a water level; and what later verbs must know is kept.
#include <nlohmann/json.hpp>

#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

constexpr const char* utm_32 = "EPSG:32632 (WGS 84 / UTM zone 32N)";

}  // namespace

class PlausibleRuns : public ToolTest {
 protected:
  /// A level bed of 40 m x 20 m about (0, 0) at z = -6, called bed.ply.
  void make_bed(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(), const std::string& system = "") const {
    SceneCloud bed;
    for (double x = -20; x < 20; x += 0.5)
      for (double y = -10; y < 10; y += 0.5) add_surfel(bed, {x, y, -6}, Eigen::Vector3d::UnitZ(), 0.25);
    bed.origin = origin;
    SceneColumns columns;
    columns.system = system;
    save_scene(path("bed.ply"), bed, columns);
  }
  /// A mission of an echo sounder along way.csv.
  void write_mission(const std::string& trajectory_keys = "", const std::string& survey_keys = "") const {
    write("m.toml", "schema = 1\n[survey]\nscene = \"bed.ply\"\nseed = 1\n" + survey_keys +
                        "[trajectory]\nfile = \"way.csv\"\n" + trajectory_keys +
                        "[[head]]\nsonar = \"es200-7c\"\nname = \"mb\"\nrange = \"1:12\"\n"
                        "rate_hz = 1\n");
  }
  void write_way(const std::vector<std::pair<double, double>>& entries) const {
    std::string way = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n";
    for (const auto& [time, x] : entries) way += std::to_string(time) + "," + std::to_string(x) + ",0,-1,0,0,0\n";
    write("way.csv", way);
  }
  std::string said_by(const std::string& command) const {
    const ToolResult result = run(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }
};

TEST_F(PlausibleRuns, a_profile_that_ends_above_the_bed_is_said) {
  make_bed();
  write_way({{0, -5}, {1, -4}, {2, -3}, {3, -2}});
  const std::string note = "sound-speed profile ends at a depth of 1 m, but the scene is heard down to 6 m";
  for (const bool shallow : {true, false}) {
    write("sea.toml", std::string("[surface]\nheight_m = 0\n[profile]\ndepth_m = [0, ") + (shallow ? "1" : "6") +
                          "]\nsound_speed = [1500, 1490]\n");
    write_mission("", "environment = \"sea.toml\"\n");
    const auto expected = [&]() -> testing::Matcher<std::string> {
      if (shallow) return HasSubstr(note);
      return testing::Not(HasSubstr("profile ends"));
    };
    EXPECT_THAT(said_by("ping bed.ply --sonar es200-7c --range 1:12 --environment sea.toml "
                        "--pose=0,0,-1,0,0,0 --force -o one"),
                expected());
    EXPECT_THAT(said_by("survey m.toml --plan"), expected());
  }
}

TEST_F(PlausibleRuns, a_gap_of_a_trajectory_is_not_flown_over_in_a_straight_line) {
  make_bed();
  std::vector<std::pair<double, double>> entries;
  for (int i = 0; i <= 5; ++i) entries.emplace_back(i, -15 + i);
  for (int i = 0; i <= 5; ++i) entries.emplace_back(65 + i, 5 + i);
  write_way(entries);
  write_mission();
  const std::string said = said_by("survey m.toml -o run");
  EXPECT_THAT(said,
              HasSubstr("way.csv: 59 of 70 pings lie in gaps of more than 10 s and are left out; the longest is from 5 "
                        "to 65 s. max_gap_s = 60 in [trajectory]"));
  succeed("merge -q run");
  const Cube cube = cube_of("run/mb");
  ASSERT_EQ(cube.pings.size(), 11U);
  EXPECT_EQ(cube.pings[5].time, 5);
  EXPECT_EQ(cube.pings[6].time, 65);
  EXPECT_EQ(cube.pings[6].number, 6);
  write_mission("max_gap_s = 60\n");
  EXPECT_THAT(said_by("survey m.toml -o whole"), testing::Not(HasSubstr("gaps of more than")));
  succeed("merge -q whole");
  EXPECT_EQ(cube_of("whole/mb").pings.size(), 70U);
  EXPECT_THAT(said_by("ping bed.ply --sonar es200-7c --range 1:12 --trajectory way.csv --time 30 -o one"),
              HasSubstr("way.csv has no entry between 5 and 65 s: the pose at 30 s is that of a straight line"));
  write("m.toml", replaced(read("m.toml"), "file = \"way.csv\"", "waypoints_m = [[0,0,-1],[5,0,-1]]\nspeed_m_s = 1"));
  expect_refused("survey m.toml --plan", 3, {"m.toml", "max_gap_s"});
}

TEST_F(PlausibleRuns, a_head_that_looks_down_beside_its_scene_says_so) {
  make_bed();
  write_way({{0, 17}, {1, 18.5}, {2, 20.5}, {3, 22}});
  write_mission();
  EXPECT_THAT(said_by("survey m.toml --plan"),
              HasSubstr("head mb: 1 of 3 pings look down from beside the scene, up to 1 m"));
  write_way({{0, 7}, {1, 8.5}, {2, 10.5}, {3, 12}});
  EXPECT_THAT(said_by("survey m.toml --plan"), testing::Not(HasSubstr("beside the scene")));
}

TEST_F(PlausibleRuns, drafts_without_a_water_level_are_said) {
  make_bed({500000, 5900000, 379}, utm_32);
  write("way.csv",
        "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,500000,5900000,378,0,0,0\n2,500002,5900000,378,0,0,0\n");
  write_mission();
  succeed("survey m.toml -q -o run");
  EXPECT_THAT(said_by("export run --to gsf -o a.gsf"),
              HasSubstr("the run states no water level: depths count from z = 0, 378 m "));
  write("m.toml", read("m.toml") + "[water]\nlevel_m = 379\n");
  succeed("survey m.toml -q -o level");
  EXPECT_THAT(said_by("export level --to gsf -o b.gsf"), testing::Not(HasSubstr("water level")));
}

TEST_F(PlausibleRuns, merged_pings_keep_the_coordinate_system_of_their_runs) {
  make_bed({500000, 5900000, 0}, utm_32);
  const std::string ping = "ping bed.ply -q --sonar es200-7c --range 1:12 --pose=5000";
  succeed(ping + "00,5900000,-1,0,0,0 -o a");
  succeed(ping + "01,5900000,-1,0,0,0 -o b");
  succeed("merge a b -q -o both");
  EXPECT_EQ(manifest_of("both")["scene"]["system"], utm_32);
  succeed("export both --to las -q -o both.las");  // needs no --utm
  make_bed({500000, 5900000, 0}, "EPSG:25832 (ETRS89 / UTM zone 32N)");
  succeed(ping + "02,5900000,-1,0,0,0 -o c");
  expect_refused("merge a c -o two", 3, {"c: its world is in EPSG:25832", "EPSG:32632"});
  make_bed({500000, 5900000, 0});
  succeed(ping + "02,5900000,-1,0,0,0 -o d");
  succeed("merge a d -q -o unknown");
  EXPECT_FALSE(manifest_of("unknown").contains("scene"));
}

TEST_F(PlausibleRuns, tiles_keep_the_coordinate_system_for_runs) {
  make_bed({500000, 5900000, 0}, utm_32);
  succeed("prepare bed.ply -q -o bed.tiles");
  EXPECT_EQ(json_of("info bed.tiles")["system"], utm_32);
  succeed("ping bed.tiles -q --sonar es200-7c --range 1:12 --pose=500000,5900000,-1,0,0,0 -o a");
  EXPECT_EQ(manifest_of("a")["scene"]["system"], utm_32);
  write("scene.toml", "schema = 1\n[[part]]\nname = \"bed\"\nfile = \"bed.tiles\"\n");
  succeed("ping scene.toml -q --sonar es200-7c --range 1:12 --pose=500000,5900000,-1,0,0,0 -o b");
  EXPECT_EQ(manifest_of("b")["scene"]["system"], utm_32);
  write("way.csv",
        "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,500000,5900000,-1,0,0,0\n1,500001,5900000,-1,0,0,0\n");
  write_mission();
  write("m.toml", replaced(read("m.toml"), "bed.ply", "bed.tiles"));
  succeed("survey m.toml -q -o run");
  EXPECT_EQ(read_json("run/scene.json")["scene"]["system"], utm_32);
}

TEST_F(PlausibleRuns, a_mission_without_centre_is_over_the_middle_of_its_scene) {
  make_bed({500000, 5900000, 379});
  succeed("make-mission lawnmower --scene bed.ply --sonar em2040 --size 10,0 -q -o m.toml");
  EXPECT_THAT(read("m.toml"), HasSubstr("[499994.750, 5899999.750, 376.950]"));
  make_bed();
  succeed("make-mission lawnmower --scene bed.ply --sonar em2040 --size 10,0 -q --force -o m.toml");
  EXPECT_THAT(read("m.toml"), HasSubstr("[-5.250, -0.250, -3.000]"));
  succeed("make-mission lawnmower --scene later.ply --size 10,0 --range 1:5 -q --force -o m.toml");
  EXPECT_THAT(read("m.toml"), HasSubstr("[-5.000, 0.000, -3.000]"));
}

TEST_F(PlausibleRuns, what_info_proposes_after_prepare_takes_what_was_prepared) {
  std::string text;
  for (int i = 0; i < 400; ++i)
    text += std::to_string(0.1 * (i % 20)) + " " + std::to_string(0.1 * (i / 20)) + " 0.1\n";
  write("bare.xyz", text);
  const nlohmann::json next = json_of("info bare.xyz")["next"];
  ASSERT_GE(next.size(), 3U);
  EXPECT_THAT(next[0].get<std::string>(), HasSubstr("prepare bare.xyz"));
  for (std::size_t k = 1; k < 3; ++k) EXPECT_THAT(next[k].get<std::string>(), HasSubstr(" prepared.ply ")) << k;
}
