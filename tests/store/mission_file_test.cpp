// SPDX-License-Identifier: BSD-3-Clause
#include "store/mission_file.hpp"

#include "core/pose.hpp"
#include "support/test.hpp"

namespace {

const std::string whole = R"(schema = 1
[survey]
scene = "harbour.ply"
seed = 7
start_utc = "2026-05-01T08:30:00Z"
anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }
[trajectory]
waypoints_m = [[0, 0, -3], [20, 0, -3]]
speed_m_s = 2
[[head]]
name = "fls"
sonar = "gemini-720im"
range = "0.5:10"
set = ["sonar.beams=64"]
offset_m = [1, 0, -0.2]
pitch_deg = -15
rate_hz = 4
[[head]]
sonar = "ping360"
[head.scan]
start_deg = -90
stop_deg = 90
step_deg = 1.8
mode = "sector"
dwell_s = 0.2
[[leg]]
name = "out"
to_s = 4
[[leg]]
name = "back"
heads = ["fls"]
every_m = 0.5
[ping]
noise = true
)";

/// Returns the error for the file with its first `from` replaced.
std::string refusal(const std::string& from, const std::string& to) {
  return error_of_file(load_mission, "m.toml", replaced(whole, from, to));
}

const std::string way = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,1,2,3,40,-10,5\n10,11,2,3,40,-10,5\n";

MissionFile with_trajectory(const std::string& lines) {
  return load_mission(
      own_file("m.toml", replaced(whole, "waypoints_m = [[0, 0, -3], [20, 0, -3]]\nspeed_m_s = 2", lines)));
}

}  // namespace

TEST(MissionFile, reads_survey_trajectory_heads_and_legs) {
  const MissionFile m = load_mission(own_file("m.toml", whole));
  EXPECT_EQ(m.scene, "harbour.ply");
  EXPECT_EQ(m.seed, 7U);
  EXPECT_EQ(m.start_utc, "2026-05-01T08:30:00Z");
  EXPECT_EQ(m.anchor.value().heading_deg, 30);
  EXPECT_EQ(m.text, whole);
  EXPECT_EQ(m.mission.trajectory.time.back(), 10);
  ASSERT_EQ(m.mission.heads.size(), 2U);
  const MissionHead& fls = m.mission.heads[0];
  EXPECT_EQ(fls.interval, 0.25);
  EXPECT_TRUE(fls.vehicle_from_head.isApprox(pose_from_yaw_pitch_roll({1, 0, -0.2}, 0, radians(15), 0), 1e-15));
  EXPECT_EQ(m.sonars[0].sonar, "gemini-720im");
  EXPECT_EQ(m.sonars[0].range, "0.5:10");
  EXPECT_EQ(m.sonars[0].settings, std::vector<std::string>{"sonar.beams=64"});
  const MissionHead& scanning = m.mission.heads[1];
  EXPECT_EQ(scanning.name, "ping360") << "named for its sonar";
  EXPECT_EQ(scanning.interval, 0.2);
  EXPECT_EQ(scanning.scan->mode, ScanMode::sector);
  EXPECT_NEAR(scanning.scan->start, -pi / 2, 1e-15);
  ASSERT_EQ(m.mission.legs.size(), 2U);
  EXPECT_EQ(m.mission.legs[0].from, 0) << "the begin of the trajectory";
  EXPECT_EQ(m.mission.legs[1].from, 4) << "the end of the leg before";
  EXPECT_EQ(m.mission.legs[1].to, 10) << "the end of the trajectory";
  EXPECT_EQ(m.mission.legs[1].distance, 0.5);
}

TEST(MissionFile, mounts_heads_as_their_sonars_are_and_mirrors_those_to_starboard) {
  const auto axes = [](const std::string& sonar, const std::string& more) -> Eigen::Matrix3d {
    const std::string text = replaced(whole, "\"gemini-720im\"", "\"" + sonar + "\"\n" + more);
    return load_mission(own_file("m.toml", replaced(text, "pitch_deg = -15\n", "")))
        .mission.heads[0]
        .vehicle_from_head.linear();
  };
  Eigen::Matrix3d down;
  down << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // forward is down, up is ahead: the fan lies across the way
  EXPECT_TRUE(axes("em2040", "").isApprox(down, 1e-12));
  EXPECT_TRUE(axes("gemini-720im", "").isIdentity(1e-12));
  const Eigen::Vector3d port = axes("starfish-450", "").col(0);
  EXPECT_TRUE(port.isApprox(Eigen::Vector3d(0, std::sqrt(0.75), -0.5), 1e-12)) << "30 degrees down";
  const Eigen::Vector3d starboard = axes("starfish-450", "side = \"starboard\"").col(0);
  EXPECT_TRUE(starboard.isApprox(Eigen::Vector3d(0, -std::sqrt(0.75), -0.5), 1e-12));
  EXPECT_THAT(refusal("rate_hz = 4", "side = \"left\""),
              HasSubstr("head.side = \"left\", must be one of port, starboard"));
}

// Against rotations in ship axes (x forward, y starboard, z down), each by its own right-hand rule.
TEST(MissionFile, mountings_are_stated_in_ship_axes) {
  const auto axes = [](const std::string& sonar, const std::string& more) -> Eigen::Matrix3d {
    const std::string text = replaced(whole, "\"gemini-720im\"", "\"" + sonar + "\"");
    return load_mission(own_file("m.toml", replaced(text, "pitch_deg = -15\n", more)))
        .mission.heads[0]
        .vehicle_from_head.linear();
  };
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Matrix3d flip = Vector3d(1, -1, -1).asDiagonal(), down = axes("em2040", "");
  const Eigen::Matrix3d turn = (AngleAxisd(radians(30), Vector3d::UnitZ()) *
                                AngleAxisd(radians(-7), Vector3d::UnitY()) * AngleAxisd(radians(2), Vector3d::UnitX()))
                                   .toRotationMatrix();
  const std::string keys = "roll_deg = 2\npitch_deg = -7\nheading_deg = 30\n";
  EXPECT_TRUE(axes("gemini-720im", keys).isApprox(flip * turn * flip, 1e-12));
  EXPECT_TRUE(axes("em2040", keys).isApprox(flip * turn * flip * down, 1e-12)) << "after that of the sonar";
  // A roll offset of 1 degree lowers the starboard side, so that the middle of the swath moves to port.
  const Vector3d middle = axes("em2040", "roll_deg = 1\n").col(0);
  EXPECT_TRUE(middle.isApprox(Vector3d(0, std::sin(radians(1)), -std::cos(radians(1))), 1e-12));
  EXPECT_TRUE(axes("gemini-720im", "heading_deg = 90\n").col(0).isApprox(Vector3d(0, -1, 0), 1e-12)) << "starboard";
  EXPECT_NEAR(axes("gemini-720im", "pitch_deg = 10\n")(2, 0), std::sin(radians(10)), 1e-12) << "bow up";
  // The sides of a fish tilt alike.
  const Eigen::Matrix3d port = axes("starfish-450", "roll_deg = -5\nheading_deg = 3\n");
  const Eigen::Matrix3d starboard = axes("starfish-450", "roll_deg = -5\nheading_deg = 3\nside = \"starboard\"\n");
  const Eigen::Matrix3d mirror = Vector3d(1, -1, 1).asDiagonal();
  EXPECT_TRUE(starboard.isApprox(mirror * port * mirror, 1e-12));
  EXPECT_GT(-port(2, 0), std::sin(radians(34)));
  EXPECT_EQ(axes("em2040", "heading_deg = 0\n"), down);
  EXPECT_THAT(refusal("pitch_deg = -15", "angles_deg = [0, 90, 1]"),
              HasSubstr("head.angles_deg: state the mounting by roll_deg"));
}

TEST(MissionFile, reads_trajectories_of_other_programs) {
  own_file("way.csv", way);
  const Pose pose = with_trajectory("file = \"way.csv\"\ntime_offset_s = -2").mission.trajectory.pose[0];
  EXPECT_TRUE(pose.isApprox(pose_from_yaw_pitch_roll({1, 2, 3}, radians(40), radians(-10), radians(5)), 1e-12));
  EXPECT_EQ(with_trajectory("file = \"way.csv\"\ntime_offset_s = -2").mission.trajectory.time[0], -2);
  const Pose ned = with_trajectory("file = \"way.csv\"\nframe = \"ned\"").mission.trajectory.pose[0];
  EXPECT_TRUE(ned.isApprox(pose_from_ned({1, 2, 3}, radians(40), radians(-10), radians(5)), 1e-12));
  // Yaw of 90 degrees is the quaternion (0, 0, sin 45, cos 45).
  own_file("way.tum", "# time x y z qx qy qz qw\n100 1 2 3 0 0 0.70710678 0.70710678\n110 5 2 3 0 0 1 0\n");
  const Trajectory tum = with_trajectory("file = \"way.tum\"\ntime_offset_s = -100").mission.trajectory;
  EXPECT_EQ(tum.time, (std::vector<double>{0, 10}));
  EXPECT_NEAR(pose_angles(tum.pose[0]).yaw, pi / 2, 1e-7);
}

TEST(MissionFile, turns_from_179_to_181_degrees_by_the_short_way) {
  own_file("way.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,0,179,0,0\n10,0,0,0,-177,0,0\n");
  const Trajectory t = with_trajectory("file = \"way.csv\"").mission.trajectory;
  EXPECT_NEAR(degrees(pose_angles(pose_at(t, 2)).yaw), 179.8, 1e-9);
  EXPECT_NEAR(degrees(pose_angles(pose_at(t, 5)).yaw), -179, 1e-9);
}

TEST(MissionFile, names_line_key_and_rule) {
  EXPECT_EQ(refusal("schema = 1", "schema = 2"),
            "content: m.toml:1: schema = 2, this version reads schema 1; the file is of a newer insonify");
  EXPECT_EQ(refusal("schema = 1", ""), "content: m.toml:1: missing key 'schema'");
  EXPECT_EQ(refusal("scene =", "scen ="), "content: m.toml:3: unknown key 'survey.scen'; did you mean 'survey.scene'?");
  EXPECT_EQ(refusal("seed = 7", "seed = -7"),
            "content: m.toml:4: survey.seed = -7, must be an integer from 0, in quotes from 2^53");
  EXPECT_THAT(refusal("T08:30", " 8:30"),
              HasSubstr("m.toml:5: survey.start_utc = \"2026-05-01 8:30:00Z\", must be a time of UTC"));
  EXPECT_EQ(refusal("= 54.1", "= 541"),
            "content: m.toml:6: survey.anchor.latitude_deg = 541 deg, must be a number within -90 and 90");
  EXPECT_EQ(refusal("anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }", "anchor = [54.1, 7.9]"),
            "content: m.toml:6: survey.anchor = [54.1, 7.9], must be a table with keys of its own");
  EXPECT_EQ(refusal("speed_m_s = 2", "speed_m_s = 0"),
            "content: m.toml:9: trajectory.speed_m_s = 0 m/s, must be a number > 0");
  EXPECT_THAT(refusal("[20, 0, -3]", "[0, 0, -3]"),
              HasSubstr("m.toml:7: waypoint_trajectory: points[1] is at the place"));
  EXPECT_THAT(
      refusal("[20, 0, -3]", "[20, 0]"),
      HasSubstr("m.toml:8: trajectory.waypoints_m = [[0, 0, -3], [20, 0]], must be a list of points [x, y, z]"));
  EXPECT_EQ(refusal("rate_hz = 4", "rate_Hz = 4"),
            "content: m.toml:17: unknown key 'head.rate_Hz'; did you mean 'head.rate_hz'?");
  EXPECT_EQ(refusal("rate_hz = 4", ""),
            "content: m.toml:10: mission: head 'fls': must say when it pings by one of rate_hz, every_m and times");
  EXPECT_EQ(refusal("\"sector\"", "\"turn\""),
            "content: m.toml:24: head.scan.mode = \"turn\", must be one of continuous, sector, single");
  EXPECT_EQ(refusal("sonar = \"ping360\"", "sonar = \"ping360\"\nname = \"fls\""),
            "content: m.toml:18: mission: two heads are called 'fls', must have names of their own");
  EXPECT_EQ(
      refusal("name = \"back\"", "name = \"back\"\nfrom_s = 3"),
      "content: m.toml:29: mission: leg 'back': begins at 3 s, before leg 'out' ends at 4 s; legs must not overlap");
  EXPECT_THAT(refusal("to_s = 4", "to_s = 40"),
              HasSubstr("m.toml:26: mission: leg 'out': from 0 to 40 s, must ascend"));
  EXPECT_EQ(refusal("heads = [\"fls\"]", "heads = \"fls\""),
            "content: m.toml:31: leg.heads = \"fls\", must be a list of texts");
  own_file("way.csv", replaced(way, "10,11", "-1,11"));
  EXPECT_THAT(error_of([] { with_trajectory("file = \"way.csv\""); }, ErrorKind::content),
              HasSubstr("way.csv:3: time_s = -1 s, must be later than the previous line, 0 s"));
}

TEST(MissionFile, takes_from_a_template_what_a_table_lacks) {
  const std::string base = R"(schema = 1
[survey]
scene = "harbour.ply"
[trajectory]
waypoints_m = [[0, 0, -3], [20, 0, -3]]
speed_m_s = 2
[template.side]
sonar = "starfish-450"
range = "1:30"
every_m = 0.1
[[head]]
template = "side"
name = "port"
[[head]]
template = "side"
name = "starboard"
side = "starboard"
range = "1:20"
)";
  const MissionFile m = load_mission(own_file("m.toml", base));
  ASSERT_EQ(m.sonars.size(), 2U);
  EXPECT_EQ(m.sonars[0].sonar, "starfish-450");
  EXPECT_EQ(m.sonars[0].range, "1:30");
  EXPECT_EQ(m.sonars[1].range, "1:20") << "the head's own keys come first";
  EXPECT_EQ(m.mission.heads[1].distance, 0.1);
  EXPECT_FALSE(m.mission.heads[0].vehicle_from_head.isApprox(m.mission.heads[1].vehicle_from_head));
  const auto refused = [&](const std::string& from, const std::string& to) {
    return error_of_file(load_mission, "m.toml", replaced(base, from, to));
  };
  EXPECT_THAT(refused("template = \"side\"", "template = \"top\""),
              HasSubstr("m.toml:12: template = 'top': there is no table [template.top]"));
  EXPECT_THAT(refused("every_m", "evry_m"),
              HasSubstr("m.toml:10: unknown key 'head.evry_m'; did you mean 'head.every_m'?"));
}

TEST(MissionFile, reads_what_the_processing_assumes_of_a_head) {
  const std::string heads = "pitch_deg = -15\nlatency_s = 0.3\ndraught_m = 0.7\n";
  const auto assumed = [&](const std::string& lines) {
    const std::string more = "rate_hz = 4\n[head.assumed]\n" + lines;
    return load_mission(
               own_file("m.toml", replaced(replaced(whole, "pitch_deg = -15\n", heads), "rate_hz = 4\n", more)))
        .mission.heads[0];
  };
  const MissionHead head = assumed(
      "roll_deg = 1\noffset_m = [2, 0, 0]\nlatency_s = 0.1\ndraught_m = 0.5\n"
      "sound_speed_m_s = 1490\n");
  EXPECT_TRUE(head.vehicle_from_head.isApprox(pose_from_yaw_pitch_roll({1, 0, -0.2}, 0, radians(15), 0), 1e-15));
  // The pitch is left out, so it is as in truth.
  const Pose expected = pose_from_yaw_pitch_roll({2, 0, 0}, 0, radians(15), radians(1));
  EXPECT_TRUE(head.assumed.vehicle_from_head.value().isApprox(expected, 1e-15));
  EXPECT_EQ(head.latency, 0.3);
  EXPECT_EQ(head.assumed.latency, 0.1);
  EXPECT_EQ(head.assumed.draught, 0.5);
  EXPECT_EQ(head.assumed.sound_speed, 1490);
  EXPECT_FALSE(assumed("latency_s = 0\n").assumed.vehicle_from_head) << "nothing of the mounting is assumed";
  EXPECT_FALSE(load_mission(own_file("m.toml", whole)).mission.heads[0].assumed.any());
  EXPECT_THAT(refusal("rate_hz = 4", "[head.assumed]\ndraught_m = 1"),
              HasSubstr("must be stated, too: head.draught_m"));
  EXPECT_THAT(refusal("rate_hz = 4", "[head.assumed]\nsound_speed_m_s = 150"), HasSubstr("1300"));
}

TEST(MissionFile, reads_a_tide_in_place_of_a_level) {
  const std::string tide = "[tide]\ntime_s = [0, 20]\nheight_m = [1, 3]\n[ping]";
  const MissionFile m = load_mission(own_file("m.toml", replaced(whole, "[ping]", tide)));
  EXPECT_EQ(m.mission.tide.height, (std::vector<double>{1, 3}));
  EXPECT_EQ(m.mission.trajectory.pose.front().translation().z(), -3) << "heights count from the datum";
  const std::string floats =
      replaced(replaced(whole, "[ping]", tide), "speed_m_s = 2", "speed_m_s = 2\nheights_from = \"water\"");
  EXPECT_EQ(load_mission(own_file("m.toml", floats)).mission.trajectory.pose.back().translation().z(), -3 + 2);
  own_file("tide.csv", "time_s,height_m\n0,0.5\n30,0.5\n");
  const MissionFile of_file =
      load_mission(own_file("m.toml", replaced(whole, "[ping]", "[tide]\nfile = \"tide.csv\"\n[ping]")));
  EXPECT_EQ(water_height_at(of_file.mission.tide, 10), 0.5);

  EXPECT_THAT(refusal("[ping]", "[tide]\ntime_s = [0, 5]\nheight_m = [1, 3]\n[ping]"),
              HasSubstr("there is no water level at 10 s; its entries from 0 to 5 s must reach there"));
  EXPECT_THAT(refusal("[ping]", "[water]\nlevel_m = 1\n" + tide), HasSubstr("replaces level_m in [water]"));
  EXPECT_THAT(refusal("[ping]", "[tide]\nfile = \"tide.csv\"\ntime_s = [0, 9]\n[ping]"),
              HasSubstr("tide: must have file, or time_s and height_m"));
  EXPECT_THAT(refusal("[ping]", "[tide]\ntime_s = [0, 99]\nheight_m = [1]\n[ping]"), HasSubstr("tide.height_m"));
  EXPECT_THAT(refusal("speed_m_s = 2", "speed_m_s = 2\nheights_from = \"water\""),
              HasSubstr("must come with [tide], or level_m in [water]"));
}

TEST(MissionFile, reads_navigation_noise_and_where_the_survey_is) {
  const MissionFile m = load_mission(own_file(
      "m.toml", replaced(whole, "speed_m_s = 2",
                         "speed_m_s = 2\nnav_noise = { position_m = 0.5, heading_deg = 1, correlation_s = 2 }")));
  EXPECT_EQ(m.mission.navigation.step, 0.2);
  EXPECT_GT(m.mission.navigation.nodes.size(), 50U);
  EXPECT_TRUE(load_mission(own_file("m.toml", whole)).mission.navigation.nodes.empty());
  const MissionFile frame = load_mission_tables(own_path("m.toml"));
  EXPECT_EQ(frame.start_utc, "2026-05-01T08:30:00Z");
  EXPECT_EQ(frame.anchor.value().heading_deg, 30);
  EXPECT_EQ(frame.system, "");
  EXPECT_THAT(refusal("seed = 7", "seed = 7\nsystem = \"EPSG:32632\""), HasSubstr("leave one out"));
  EXPECT_THAT(refusal("seed = 7", "seed = 7\nsystem = \"32N\""), HasSubstr("EPSG:N, such as EPSG:32632"));
  EXPECT_THAT(refusal("speed_m_s = 2", "speed_m_s = 2\nnav_noise = { position_m = -1 }"),
              HasSubstr("trajectory.nav_noise.position_m = -1 m, must be a number at least 0"));
}

TEST(MissionFile, reads_the_water_level_and_the_datum_of_soundings) {
  const MissionFile none = load_mission(own_file("m.toml", whole));
  EXPECT_FALSE(none.water.level.has_value());
  EXPECT_EQ(none.water.datum, "UNKNOWN");
  const MissionFile m =
      load_mission(own_file("m.toml", replaced(whole, "[ping]", "[water]\nlevel_m = 0.75\ndatum = \"MSL\"\n[ping]")));
  EXPECT_EQ(m.water.level, 0.75);
  EXPECT_EQ(m.water.datum, "MSL");
  EXPECT_THAT(refusal("[ping]", "[water]\nlevel = 1\n[ping]"),
              HasSubstr("unknown key 'water.level'; did you mean 'water.level_m'?"));
  EXPECT_THAT(refusal("[ping]", "[water]\ndatum = \"\"\n[ping]"), HasSubstr("datum = \"\", must be 1 to 32 printable"));
  EXPECT_THAT(refusal("[ping]", "[water]\ndatum = \"A B\"\n[ping]"), HasSubstr("such as MSL or LAT"));
  EXPECT_THAT(refusal("[ping]", "[water]\nlevel_m = inf\n[ping]"),
              HasSubstr("water.level_m = inf m, must be a number"));
}

TEST(MissionFile, says_how_often_bodies_are_drawn) {
  const auto pings_of = [](const std::string& value) {
    return load_mission(own_file("m.toml", whole + "[randomise]\nscene = " + value + "\n")).randomise.scene_pings;
  };
  EXPECT_EQ(load_mission(own_file("m.toml", whole)).randomise.scene_pings, 0);
  EXPECT_EQ(pings_of("\"survey\""), 0);
  EXPECT_EQ(pings_of("\"ping\""), 1);
  EXPECT_EQ(pings_of("25"), 25);
  for (const char* bad : {"0", "1.5", "\"pings\"", "-3", "true"})
    EXPECT_THAT(error_with_kind([&] { pings_of(bad); }), HasSubstr("must be \"ping\", \"survey\" or a whole number"));
}

namespace {

const std::string at_random = R"(schema = 1
[survey]
scene = "harbour.ply"
seed = 7
[[head]]
name = "fls"
sonar = "gemini-720im"
range = "0.5:10"
[randomise.pose]
pings = 40
box_m = [[5, 4, -1], [0, -4, -3]]
yaw_deg = [-90, 90]
pitch_deg = [5, 25]
)";

}  // namespace

TEST(MissionFile, reads_limits_of_random_poses_in_place_of_a_trajectory) {
  const MissionFile m = load_mission(own_file("m.toml", at_random));
  EXPECT_EQ(m.random_poses.pings, 40);
  EXPECT_EQ(m.mission.random_pings, 40);
  EXPECT_TRUE(m.mission.trajectory.time.empty());
  EXPECT_TRUE(m.mission.poses.empty()) << "they are drawn over the scene";
  EXPECT_EQ(m.random_poses.low, Eigen::Vector3d(0, -4, -3));
  EXPECT_EQ(m.random_poses.high, Eigen::Vector3d(5, 4, -1));
  EXPECT_EQ(m.random_poses.yaw, (std::array<double, 2>{radians(-90), radians(90)}));
  EXPECT_EQ(m.random_poses.pitch, (std::array<double, 2>{radians(5), radians(25)}));
  EXPECT_EQ(m.random_poses.roll, (std::array<double, 2>{0, 0}));
  EXPECT_EQ(m.random_poses.clearance, 0.5);
  EXPECT_EQ(load_mission_tables(own_path("m.toml")).seed, 7U);
}

TEST(MissionFile, says_what_is_wrong_with_random_poses) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return error_of_file(load_mission, "m.toml", replaced(at_random, from, to));
  };
  EXPECT_THAT(refused("pings = 40\n", ""), HasSubstr("missing key 'randomise.pose.pings'"));
  EXPECT_THAT(refused("pings = 40", "pings = 0.5"), HasSubstr("randomise.pose.pings = 0.5, must be a whole number"));
  EXPECT_THAT(refused("[[5, 4, -1], [0, -4, -3]]", "[[5, 4, -1]]"), HasSubstr("must have two opposite ones"));
  EXPECT_THAT(refused("[5, 25]", "[25, 5]"), HasSubstr("must be two numbers that ascend"));
  EXPECT_THAT(refused("[5, 25]", "[25]"), HasSubstr("must be two numbers that ascend"));
  EXPECT_THAT(refused("[5, 25]", "[5, 25]\nclearance_m = -1"), HasSubstr("clearance_m = -1 m, must be"));
  EXPECT_THAT(refused("[randomise.pose]", "[trajectory]\nwaypoints_m = [[0, 0, -3], [1, 0, -3]]\n[randomise.pose]"),
              HasSubstr("[trajectory] beside [randomise.pose]"));
  EXPECT_THAT(refused("[randomise.pose]", "[[leg]]\nname = \"a\"\n[randomise.pose]"),
              HasSubstr("[leg] beside [randomise.pose]"));
  EXPECT_THAT(refused("range = \"0.5:10\"", "rate_hz = 2"),
              HasSubstr("head 'fls': pings once at each random pose; leave out rate_hz"));
  EXPECT_THAT(refused("[[head]]", "[trajectory]\n[[head]]"), HasSubstr("[trajectory] beside"));
}
