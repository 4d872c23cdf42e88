// SPDX-License-Identifier: BSD-3-Clause
// A vehicle that dives through a thermocline: every ping has the water of its own depth, and so has all that is made of it.
#include <numeric>
#include <sstream>

#include <nlohmann/json.hpp>

#include "acoustics/sound_speed_profile.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/ros_decoder.hpp"
#include "sonar/water.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/gsf_rays.hpp"
#include "tool/tool_runner.hpp"

namespace {

using nlohmann::json;

const SoundSpeedProfile thermocline{{0, 4, 6, 40}, {1520, 1518, 1450, 1446}};
constexpr double bed_height = -25;

/// Travel time straight down [s], by the middle rule over depth.
double time_down(double from, double to) {
  constexpr int steps = 100000;
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += 1 / sound_speed_at(thermocline, from + (k + 0.5) / steps * (to - from));
  return sum * (to - from) / steps;
}

class Dive : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", "v -4 -40 -25\nv 4 -40 -25\nv 4 40 -25\nv -4 40 -25\nf 1 2 3\nf 1 3 4\n");
    write("sea.toml",
          "[water]\nlatitude_deg = -33\n[surface]\nheight_m = 0\n[profile]\ndepth_m = [0, 4, 6, 40]\n"
          "sound_speed = [1520, 1518, 1450, 1446]\n");
    write("dive.toml", mission("[[-2, 0, -1], [2, 0, -20]]"));
  }
  /// So slow that no way is made while sound is under way.
  std::string mission(const std::string& waypoints) const {
    return "schema = 1\n[survey]\nscene = \"bed.obj\"\nenvironment = \"sea.toml\"\n[trajectory]\nwaypoints_m = " +
           waypoints +
           "\nspeed_m_s = 0.05\n[[head]]\nsonar = \"em2040\"\nrange = \"3:36\"\n"
           "set = [\"sonar.field_of_view_deg=90\", \"sonar.beams=32\"]\nevery_m = 4.8\n[ping]\nsplit = true\n"
           "without = [\"multipath\"]\n";
  }
  json info(const std::string& run) const { return json_of("info " + run); }
  /// Returns the depth for which the water of a ping is computed: to a millimetre (E42).
  static double depth_of(const Ping& ping) { return std::round(-1000 * ping.world_from_head.translation().z()) / 1000; }
};

}  // namespace

TEST_F(Dive, pings_keep_the_water_of_their_own_depth_in_blocks_and_in_the_merged_cube) {
  succeed("survey dive.toml -q -o run --pings-per-block 2");
  succeed("merge -q run");
  const Cube cube = cube_of("run/em2040");
  ASSERT_EQ(cube.pings.size(), 5U);
  for (const Ping& ping : cube.pings) {
    EXPECT_NEAR(ping.sound_speed, sound_speed_at(thermocline, depth_of(ping)), 1e-4);
    const Water water{.depth = depth_of(ping), .latitude_deg = -33};
    EXPECT_NEAR(ping.absorption_db_per_m / absorption_db_per_m(water, cube.centre_frequency), 1, 1e-9);
  }
  EXPECT_EQ(cube.sound_speed, cube.pings.front().sound_speed);
  EXPECT_GT(cube.pings.front().sound_speed - cube.pings.back().sound_speed, 60);
  const auto track = read_track(path("run/em2040/cube.h5"));
  for (std::size_t p = 0; p < track.size(); ++p) EXPECT_EQ(track[p].sound_speed, cube.pings[p].sound_speed);

  const json about = info("run/em2040")["sound_speed"];
  ASSERT_EQ(about.size(), 2U) << "the slowest and the fastest";
  EXPECT_EQ(about[1], cube.pings.front().sound_speed);

  // Soundings lie on the bed, to half of the 2 cm of a pulse, and those straight down took as long as sound does.
  succeed("export run --to csv -q -o soundings.csv");
  std::vector<std::size_t> all(5);
  for (const auto& row : rows_of(read("soundings.csv"))) {
    const auto p = static_cast<std::size_t>(std::stoi(row.at("ping")));
    const double off = std::abs(std::stod(row.at("z_m")) - bed_height), across = std::stod(row.at("y_m"));
    ++all.at(p);
    EXPECT_LT(off, 0.01) << p << ": " << row.at("beam");
    const double depth = depth_of(cube.pings[p]), down = time_down(depth, -bed_height);
    if (std::abs(across) < 0.02 * (-bed_height - depth)) {
      EXPECT_NEAR(std::stod(row.at("range_m")) / cube.pings[p].sound_speed / down, 1, 6e-4) << p;
    }
  }
  EXPECT_THAT(all, testing::Each(32U));
}

// A head that dives at 2 m/s, pitches and rolls goes on while sound is under way: 6 cm and half a degree, which is 30 cm
// in the outer beams. What it says of the bed is as good as at rest.
TEST_F(Dive, soundings_of_a_fast_and_rolling_head_lie_on_the_bed) {
  write("roll.csv",
        "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,-2,0,-1,0,4,-9\n2,-1,0.5,-5,5,-3,9\n"
        "4,0,0,-9,0,4,-9\n6,1,0.5,-13,5,-3,9\n");
  std::string fast = replaced(mission("[[-2, 0, -1], [2, 0, -20]]"),
                              "waypoints_m = [[-2, 0, -1], [2, 0, -20]]\nspeed_m_s = 0.05", "file = \"roll.csv\"");
  write("fast.toml", replaced(replaced(fast, "every_m = 4.8", "rate_hz = 1.3"), "3:36", "3:45"));
  succeed("survey fast.toml -q -o run");
  succeed("merge -q run");
  EXPECT_NEAR(read_track(path("run/em2040/cube.h5")).at(1).motion.velocity.z(), -2, 1e-12);
  succeed("export run --to csv -q -o soundings.csv");
  std::vector<double> off;
  for (const auto& row : rows_of(read("soundings.csv"))) off.push_back(std::stod(row.at("z_m")) - bed_height);
  ASSERT_GT(off.size(), 200U);
  double sum = 0, largest = 0;
  for (const double o : off) sum += o, largest = std::max(largest, std::abs(o));
  EXPECT_LT(std::abs(sum) / static_cast<double>(off.size()), 0.002);
  EXPECT_LT(largest, 0.02);
  succeed("export run --to gsf --anchor -33.5,-71.6,0 -q -o fast.gsf");
  EXPECT_LT(largest_difference(decode::read_gsf(read("fast.gsf"))), 0.02);
}

TEST_F(Dive, a_water_level_of_the_mission_is_the_surface_that_depth_counts_from) {
  const std::string raised = replaced(read("dive.toml"), "every_m = 4.8", "every_m = 15");
  write("surface.toml", replaced(read("sea.toml"), "height_m = 0", "height_m = 0.5"));
  write("level.toml", replaced(read("sea.toml"), "[surface]\nheight_m = 0\n", ""));
  write("a.toml", replaced(raised, "sea.toml", "surface.toml"));
  write("b.toml", replaced(raised, "sea.toml", "level.toml") + "\n[water]\nlevel_m = 0.5\n");
  for (const char* name : {"a", "b"}) {
    succeed(std::string("survey ") + name + ".toml -q -o run-" + name);
    succeed(std::string("merge -q run-") + name);
  }
  const Cube a = cube_of("run-a/em2040"), b = cube_of("run-b/em2040");
  ASSERT_EQ(a.pings.size(), b.pings.size());
  for (std::size_t p = 0; p < a.pings.size(); ++p) {
    EXPECT_EQ(a.pings[p].sound_speed, b.pings[p].sound_speed);
    EXPECT_NEAR(b.pings[p].sound_speed, sound_speed_at(thermocline, 0.5 + depth_of(b.pings[p])), 1e-4);
  }
}

TEST_F(Dive, files_of_other_programs_have_the_water_of_each_ping) {
  write("short.toml", replaced(read("dive.toml"), "every_m = 4.8", "every_m = 15"));
  succeed("survey short.toml -q -o run");
  succeed("merge -q run");
  const Cube cube = cube_of("run/em2040");
  ASSERT_EQ(cube.pings.size(), 2U);
  succeed("export run --to gsf --anchor -33.5,-71.6,0 -q -o dive.gsf");
  const decode::GsfContent gsf = decode::read_gsf(read("dive.gsf"));
  succeed("export run --to mcap -q -o dive.mcap");
  std::vector<double> speeds;
  for (const auto& message : decode::read_mcap(read("dive.mcap")).messages)
    if (message.topic == "/sonar/image") speeds.push_back(message.content.one("ping_info.sound_speed"));
  ASSERT_EQ(gsf.swaths.size(), 2U);
  ASSERT_EQ(speeds.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(gsf.swaths[p].of_sensor.at("surface_velocity"), cube.pings[p].sound_speed, 0.051);
    EXPECT_NEAR(speeds[p], cube.pings[p].sound_speed, 1e-3);
    const auto& times = gsf.swaths[p].arrays.at(4);
    EXPECT_NEAR(*std::min_element(times.begin(), times.end()) / (2 * time_down(depth_of(cube.pings[p]), -bed_height)),
                1, 1e-3)
        << "straight down";
  }
}

// Without a profile sound is straight, at the speed that the pressure at the head gives it: a profile for each ping.
TEST_F(Dive, gsf_has_the_sound_speed_of_each_ping_where_there_is_no_profile) {
  write("sea.toml", "[surface]\nheight_m = 0\n");
  succeed("survey dive.toml -q -o run");
  succeed("merge -q run");
  const Cube cube = cube_of("run/em2040");
  succeed("export run --to gsf --anchor -33.5,-71.6,0 -q -o dive.gsf");
  const decode::GsfContent gsf = decode::read_gsf(read("dive.gsf"));
  ASSERT_EQ(gsf.swaths.size(), 5U);
  EXPECT_EQ(std::count(gsf.records.begin(), gsf.records.end(), 3), 5);
  EXPECT_GT(cube.pings.back().sound_speed - cube.pings.front().sound_speed, 0.3);
  for (std::size_t p = 0; p < 5; ++p) {
    const decode::GsfSwath& s = gsf.swaths[p];
    ASSERT_EQ(s.profile.size(), 2U);
    EXPECT_NEAR(s.profile[0].second, cube.pings[p].sound_speed, 0.0051);
    EXPECT_EQ(s.profile[1].second, s.profile[0].second);
    for (std::size_t b = 0; b < s.flags.size(); ++b) {
      const double down = s.profile[0].second * s.arrays.at(4)[b] / 2 * std::cos(radians(s.arrays.at(5)[b]));
      EXPECT_NEAR(depth_of(cube.pings[p]) + down, s.arrays.at(1)[b], 2e-3) << p << ": " << b;
    }
  }
}

TEST_F(Dive, level_ways_have_one_water_and_no_numbers_of_their_own) {
  write("level.toml", mission("[[-2, 0, -10], [2, 0, -10]]"));
  succeed("survey level.toml -q -o run");
  const std::string block = "run/em2040/blocks/000000.h5";
  ASSERT_TRUE(std::filesystem::exists(path(block))) << "of the only block";
  const Cube cube = read_cube(path(block));
  EXPECT_NEAR(cube.sound_speed, sound_speed_at(thermocline, 10), 1e-4);
  const std::string bytes = read(block), name = "absorption_db_per_m";
  EXPECT_EQ(bytes.find(name, bytes.find(name) + 1), std::string::npos) << "an attribute alone, no dataset";
  for (const Ping& ping : cube.pings) EXPECT_EQ(ping.sound_speed, cube.sound_speed);
}

TEST_F(Dive, a_ping_says_which_water_it_was_in_and_can_be_made_again) {
  const std::string ping = "ping bed.obj --sonar em2040 --environment sea.toml --range 3:25 --set sonar.beams=16 ";
  succeed(ping + "--pose=0,0,-8,0,90,0 -q -o out");
  const json manifest = manifest_of("out");
  EXPECT_EQ(manifest["water"]["depth_m"], 8.0);
  EXPECT_NEAR(manifest["water"]["sound_speed"].get<double>(), sound_speed_at(thermocline, 8), 1e-4);
  EXPECT_EQ(info("out")["sound_speed"], manifest["water"]["sound_speed"]);
  succeed("ping --run out/run.toml -q -o again");
  EXPECT_EQ(read("again/cube.h5"), read("out/cube.h5"));
  // Pings of one head at two depths are merged into one cube.
  succeed(ping + "--pose=0,0,-2,0,90,0 --time 1 -q -o high");
  succeed("merge -q out high -o both");
  const Cube both = cube_of("both");
  ASSERT_EQ(both.pings.size(), 2U);
  EXPECT_NEAR(both.pings[0].sound_speed, sound_speed_at(thermocline, 8), 1e-4);
  EXPECT_NEAR(both.pings[1].sound_speed, sound_speed_at(thermocline, 2), 1e-4);
}

TEST_F(Dive, refuses_heads_without_a_depth_before_any_work) {
  const std::string ping = "ping bed.obj --sonar em2040 --no-picture -o out --pose=0,0,";
  write("ctd.csv", "depth_m,sound_speed\n0,1520\n5,1440\n");
  expect_refused(ping + "0.5,0,90,0 --environment sea.toml", 2,
                 {"z = 0.5 m", "surface.height = 0 m", "lower the head"});
  expect_refused(ping + "-8,0,90,0 --environment sea.toml --set water.depth_m=3", 2,
                 {"water.depth = 3 m", "8 m below", "leave water.depth_m out"});
  expect_refused(ping + "374,0,90,0 --profile ctd.csv", 2, {"profile", "give surface.height_m"});
  expect_refused(ping + "374,0,90,0 --profile ctd.csv --set water.depth_m=3", 2, {"profile", "give surface.height_m"});
  write("flying.toml", mission("[[-2, 0, -1], [2, 0, 9]]"));
  expect_refused("survey flying.toml -o out", 3, {"flying.toml: head 'em2040', ping", "above the sea surface"});
  write("sea.toml", "[surface]\nheight_m = 0\n[water]\ndepth_m = 1\n");
  expect_refused("survey dive.toml -o out", 3, {"dive.toml: head 'em2040', ping 1", "leave water.depth_m out"});
}

// A profile without a surface leaves depths unknown: pings can be exported, but nothing is drawn as the head sees it.
// No release wrote such runs.
TEST_F(Dive, runs_of_a_profile_without_a_surface_are_exported_and_not_looked_from) {
  succeed(
      "ping bed.obj --sonar em2040 --set water.depth_m=8 --range 3:25 --set sonar.beams=16 --pose=0,0,-8,0,90,0 -q -o "
      "out");
  write("out/run.toml", read("out/run.toml") + "\n[profile]\ndepth_m = [0, 40]\nsound_speed = [1520, 1446]\n");
  succeed("export out --to csv -q -o soundings.csv");
  expect_refused("image out --view scene --colour visibility -q -o scene.png", 2,
                 {"the sound-speed profile counts depth from the surface", "give surface.height_m"});
}
