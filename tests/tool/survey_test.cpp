// SPDX-License-Identifier: BSD-3-Clause
// Surveys: one result whatever the shards, threads and order, and what it holds.
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/survey_fixture.hpp"

namespace fs = std::filesystem;

namespace {

class Survey : public SurveyTest {};

}  // namespace

TEST_F(Survey, gives_the_same_bytes_for_any_shards_threads_and_order) {
  const auto whole = expected();
  for (const char* shard : {"1/2", "0/2"}) survey("two", std::string("-j1 --shard ") + shard);
  EXPECT_EQ(merged("two"), whole);
  for (const int shard : {6, 5, 4, 3, 2, 1, 0}) survey("seven", "-j2 --shard " + std::to_string(shard) + "/7");
  EXPECT_EQ(merged("seven"), whole);
}

TEST_F(Survey, cubes_hold_time_pose_and_scan_of_every_ping) {
  survey("run");
  merged("run");
  const Cube fls = cube_of("run/fls"), turning = cube_of("run/turning");
  ASSERT_EQ(fls.pings.size(), 13U);
  EXPECT_EQ(fls.pings[5].time, 2.5);
  EXPECT_EQ(fls.pings[5].number, 5);
  EXPECT_EQ(fls.seed, 7U);
  EXPECT_FALSE(fls.pings[5].scan);
  ASSERT_EQ(turning.pings.size(), 13U);
  const Ping& ping = turning.pings[3];
  EXPECT_NEAR(ping.scan.value().angle, radians(135), 1e-12);
  EXPECT_EQ(turning.pings[9].scan->sweep, 1);
  EXPECT_TRUE(ping.world_from_head.isApprox(pose_from_yaw_pitch_roll({2, 0, -3}, radians(135), 0, 0), 1e-12));
  EXPECT_GT(ping.pressure.abs().maxCoeff(), 0);
  // A ping of the survey is the ping of its pose, and knows its noise by seed, head and number.
  succeed("survey m.toml -q -o one --pings-per-block 100");
  EXPECT_EQ(read_cube(path("one/fls/blocks/000000.h5")).pings[5].pressure(3, 4), fls.pings[5].pressure(3, 4));
}

TEST_F(Survey, ping_is_that_of_insonify_ping_on_the_same_trajectory) {
  write("way.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,20,0\n4,3,1,-3,30,20,5\n");
  write("m.toml", R"(schema = 1
[survey]
scene = "harbour.ply"
seed = 3
[trajectory]
file = "way.csv"
[[head]]
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
times_s = [1, 2.5]
[ping]
accuracy_db = 0.01
)");
  survey("run");
  merged_cubes("run", {"p900-45"});
  const Ping of_survey = cube_of("run/p900-45").pings.at(1);
  succeed(
      "ping harbour.ply -q --no-picture --sonar p900-45 --range 1:6 --set sonar.beams=16 --accuracy-db 0.01 --seed 3"
      " --trajectory way.csv --time 2.5 -o one");
  const Ping alone = ping_of("one");
  EXPECT_GT(alone.pressure.abs().maxCoeff(), 0);
  EXPECT_TRUE((of_survey.pressure == alone.pressure).all());
  EXPECT_TRUE(of_survey.world_from_head.isApprox(alone.world_from_head, 1e-15));
}

TEST_F(Survey, of_tiles_is_that_of_the_cloud) {
  survey("cloud");
  succeed("prepare harbour.ply -o harbour.tiles -q");
  write("m.toml", replaced(survey_mission, "harbour.ply", "harbour.tiles"));
  survey("tiles", "-j2");
  EXPECT_EQ(merged_cubes("tiles", {"fls", "turning"}), merged_cubes("cloud", {"fls", "turning"}));
}

TEST_F(Survey, returns_know_time_head_ping_and_beam) {
  survey("run");
  merged("run");
  const std::string ply = read("run/returns.ply");
  const std::string header = ply.substr(0, ply.find("end_header"));
  for (const char* column : {"double x", "int scalar_ping", "int scalar_beam", "double scalar_time", "int scalar_head"})
    EXPECT_THAT(header, HasSubstr(std::string("property ") + column + "\n"));
  std::size_t rows = 0;
  std::istringstream(header.substr(header.find("vertex ") + 7)) >> rows;
  EXPECT_GT(rows, 20U);
  EXPECT_EQ(ply.size(), header.size() + 11 + rows * (3 * 8 + 10 * 4 + 8 + 4));
}

TEST_F(Survey, failed_pings_are_listed_and_the_others_kept) {
  // Between the second and third entry the vehicle is faster than a hundredth of the sound speed.
  write("way.csv",
        "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,0,0\n1,0.5,0,-3,0,0,0\n"
        "1.2,4.5,0,-3,0,0,0\n2,5,0,-3,0,0,0\n");
  write("m.toml", replaced(replaced(survey_mission, "rate_hz = 2", "times_s = [0.5, 1.1, 1.5]"),
                           "waypoints_m = [[0, 0, -3], [4, 0, -3], [4, 3, -3]]\nspeed_m_s = 1", "file = \"way.csv\""));
  const ToolResult made = run("survey m.toml -o run -q");
  EXPECT_EQ(made.exit_code, 5);
  EXPECT_THAT(made.err, HasSubstr("2 of 7 pings failed: fls ping 1: "));
  EXPECT_THAT(made.err, HasSubstr("motion.velocity = 20 m/s, must be below"));
  const ToolResult joined = run("merge run -q");
  EXPECT_EQ(joined.exit_code, 5);
  EXPECT_EQ(cube_of("run/fls").pings.size(), 2U);
  EXPECT_EQ(manifest_of("run")["failed"][0]["ping"], 1);
}

TEST_F(Survey, coverage_is_the_same_for_any_shards_and_sums_the_pings) {
  write("m.toml", replaced(survey_mission, "seed = 7", "seed = 7\ncoverage = true"));
  const auto covered = [&](const std::string& run) {
    succeed("merge -q " + run);
    return sha256_of_file(path(run + "/coverage.ply"));
  };
  survey("whole", "-j1");
  const std::string whole = covered("whole");
  for (const char* shard : {"2/3", "0/3", "1/3"}) survey("three", std::string("-j2 --shard ") + shard);
  EXPECT_EQ(covered("three"), whole);
  const auto manifest = manifest_of("whole");
  EXPECT_EQ(manifest["coverage_sha256"], whole);
  // A surfel that both heads see is seen by more pings than one of them has.
  const std::string ply = read("whole/coverage.ply");
  constexpr std::size_t row = 52;
  const std::size_t begin = ply.find("end_header\n") + 11, rows = (ply.size() - begin) / row;
  EXPECT_GT(rows, 40U);
  EXPECT_LT(rows, 6000U);
  std::uint32_t most = 0, last = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    std::uint32_t pings = 0, id = 0;
    std::memcpy(&pings, ply.data() + begin + i * row + 44, 4);
    std::memcpy(&id, ply.data() + begin + i * row + 48, 4);
    ASSERT_TRUE(i == 0 || id > last);
    last = id;
    most = std::max(most, pings);
    ASSERT_GE(pings, 1U);
    ASSERT_LE(pings, 26U);
  }
  EXPECT_GT(most, 3U);
  std::ofstream(path("three/fls/blocks/000001.coverage.ply"), std::ios::app) << "x";
  expect_refused("merge three", 3, {"three/fls/blocks/000001.coverage.ply: was changed since it was made"});
  write("wall.obj", "v 0 0 -5\nv 9 0 -5\nv 0 9 -5\nf 1 2 3\n");
  write("mesh.toml", replaced(read("m.toml"), "harbour.ply", "wall.obj"));
  expect_refused("survey mesh.toml -o mesh", 3, {"coverage counts the pings of each surfel", "insonify prepare"});
}

TEST_F(Survey, navigation_noise_moves_what_is_stored_and_not_what_is_heard) {
  survey("run");
  merged("run");
  write("m.toml",
        replaced(survey_mission, "speed_m_s = 1", "speed_m_s = 1\nnav_noise = { position_m = 0.3, heading_deg = 5 }"));
  survey("noisy");
  merged("noisy");
  const Cube truth = cube_of("run/fls"), believed = cube_of("noisy/fls");
  for (std::size_t p = 0; p < truth.pings.size(); ++p) {
    EXPECT_TRUE((truth.pings[p].pressure == believed.pings[p].pressure).all());
    EXPECT_GT((truth.pings[p].world_from_head.translation() - believed.pings[p].world_from_head.translation()).norm(),
              1e-3);
  }
  // Returns stand where they were relative to the head.
  const Soundings a = load_soundings(path("run/fls/blocks/000000.ply")),
                  b = load_soundings(path("noisy/fls/blocks/000000.ply"));
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Pose &of_a = truth.pings[a.ping[i]].world_from_head, &of_b = believed.pings[b.ping[i]].world_from_head;
    EXPECT_LT((of_a.inverse() * a.position[i] - of_b.inverse() * b.position[i]).norm(), 1e-9);
  }
}

TEST_F(Survey, knows_where_on_the_globe_and_when_it_was) {
  write("m.toml",
        replaced(survey_mission, "seed = 7",
                 "seed = 7\nstart_utc = \"2026-05-01T08:30:00Z\"\nanchor = { latitude_deg = 54, longitude_deg = 8, "
                 "heading_deg = 90 }"));
  survey("run");
  expect_refused("image run --view track -o track.png", 3, {"run: holds no fls/cube.h5; run insonify merge run"});
  merged("run");
  const auto manifest = manifest_of("run");
  EXPECT_EQ(manifest["start_utc"], "2026-05-01T08:30:00Z");
  EXPECT_EQ(manifest["anchor"]["heading_deg"], 90);
  const auto track = read_json("run/track.geojson");
  const auto& fls = track["features"][0];
  EXPECT_EQ(fls["properties"]["head"], "fls");
  EXPECT_EQ(fls["properties"]["time"][5], "2026-05-01T08:30:02.500Z");
  ASSERT_EQ(fls["geometry"]["coordinates"].size(), 13U);
  // x is east: 2.5 m on, the longitude has grown by that over the radius of the parallel of 54 degrees, 3757214 m.
  const auto& position = fls["geometry"]["coordinates"][5];
  EXPECT_NEAR(radians(position[0].get<double>() - 8) * 3757214, 2.5, 1e-3);
  EXPECT_NEAR(position[1].get<double>(), 54, 1e-8);
  EXPECT_NEAR(position[2].get<double>(), -3, 1e-3);
  write("m.toml", survey_mission);
  survey("plain");
  merged("plain");
  EXPECT_FALSE(file_exists(path("plain/track.geojson")));
  EXPECT_TRUE(manifest_of("plain")["anchor"].is_null());
  succeed("image plain --view track -o track.png --size 500x400");
  EXPECT_TRUE(file_exists(path("track.png")));
  expect_refused("image harbour.ply --view track -o x.png", 4, {"harbour.ply: is not the folder of a survey"});
}

TEST_F(Survey, plans_without_writing_anything) {
  const auto plan = nlohmann::json::parse(succeed("survey m.toml --plan --json -q"));
  EXPECT_EQ(plan["all"]["pings"], 26);
  EXPECT_EQ(plan["heads"][1]["name"], "turning");
  EXPECT_GT(plan["heads"][0]["echoes"].get<double>(), 100);
  EXPECT_GT(plan["all"]["cpu_hours"].get<double>(), 0);
  survey("run");
  merged("run");
  double bytes = static_cast<double>(fs::file_size(path("run/returns.ply")));
  for (const auto& entry : fs::recursive_directory_iterator(path("run")))
    if (entry.path().extension() == ".h5" && entry.path().stem() != "cube")
      bytes += static_cast<double>(entry.file_size());
  EXPECT_LT(std::abs(std::log(plan["all"]["bytes"].get<double>() / bytes)), std::log(1.5)) << bytes;
}

// Plans a swath with the phase between the halves of its array, which takes a third of the disk.
TEST_F(Survey, plan_says_the_disk_that_split_phase_takes) {
  write("swath.toml", R"(schema = 1
[survey]
scene = "harbour.ply"
seed = 3
[trajectory]
waypoints_m = [[4, -2, -1], [8, 2, -1]]
speed_m_s = 1
[[head]]
sonar = "em2040"
set = ["sonar.beams=32"]
range = "1:12"
rate_hz = 1
[ping]
noise = true
split = true
)");
  const double said =
      nlohmann::json::parse(succeed("survey swath.toml --plan --json -q"))["all"]["bytes"].get<double>();
  succeed("survey swath.toml -q -o swath");
  double written = 0;
  for (const auto& entry : fs::recursive_directory_iterator(path("swath")))
    if (entry.is_regular_file()) written += static_cast<double>(entry.file_size());
  EXPECT_NEAR(said / written, 1, 0.1) << written;
}

TEST_F(Survey, refuses_what_cannot_be) {
  const auto refuses = [&](const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
    write("bad.toml", replaced(survey_mission, from, to));
    expect_refused("survey bad.toml -o bad", 3, parts);
  };
  refuses(
      "rate_hz = 2", "rate_hz = 200",
      {"bad.toml: survey_pings: head 'fls': pings 0 and 1", "0.005 s apart, must be at least 2 max_range / c = 0.008"});
  write("sea.toml", "[surface]\nheight_m = -3.5\n");
  refuses("seed = 7", "environment = \"sea.toml\"",
          {"bad.toml: head 'fls', ping 0 at 0 s: is at z = -3 m, above the sea surface at -3.5 m"});
  refuses("[4, 3, -3]]", "[400, 3, -3]]", {"head 'fls', ping", "m from the scene, beyond its max range of 6 m"});
  refuses("noise = true", "nois = true", {"bad.toml:", "unknown key 'ping.nois'; did you mean 'ping.noise'?"});
  refuses("noise = true", "pose = \"0,0,0,0,0,0\"", {"unknown key 'ping.pose'"});
  refuses("schema = 1", "schema = 2", {"bad.toml:1: schema = 2", "newer insonify"});
  refuses("name = \"turning\"", "name = \"fls\"",
          {"bad.toml:15: ", "two heads are called 'fls', must have names of their own"});
  refuses("[ping]", "[[leg]]\nname = \"a\"\nto_s = 4\n[[leg]]\nname = \"b\"\nfrom_s = 3\n[ping]",
          {"bad.toml:", "leg 'b': begins at 3 s, before leg 'a' ends at 4 s; legs must not overlap"});
  write("back.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,0,0\n2,2,0,-3,0,0,0\n1,4,0,-3,0,0,0\n");
  refuses("waypoints_m = [[0, 0, -3], [4, 0, -3], [4, 3, -3]]\nspeed_m_s = 1", "file = \"back.csv\"",
          {"back.csv:4: ", "time"});
  survey("run", "--shard 0/9");
  write("m.toml", survey_mission + "threshold_db = 12\n");
  expect_refused("survey m.toml --pings-per-block 3 -o run", 3, {"run: holds a survey of another mission"});
  expect_refused("survey m.toml -o x --shard 3/3", 2, {"--shard = '3/3' is not I/N"});
  expect_refused("survey m.toml", 2, {"give either --output"});
  expect_refused("merge run -o x", 2, {"--output: a survey is merged in its own folder"});
}
