// SPDX-License-Identifier: BSD-3-Clause
// GSF of ships that roll, pitch, turn and drift below the surface, read by a decoder from the specification: soundings
// follow from travel times, angles and profile as MB-System computes them, and attitude, course and depth are the ship's.
#include <nlohmann/json.hpp>

#include "core/geodesy.hpp"
#include "formats/gsf_decoder.hpp"
#include "store/cube.hpp"
#include "tool/gsf_rays.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

namespace {

const Anchor south_west{-33.9, -71.5, 40};

/// A ship on a circle of 6 m to port at 1.5 m/s, that drifts 10 degrees to starboard of where it looks.
struct Ship {
  static constexpr double turn_rate = 0.25, radius = 6, drift = 10;  // [rad/s, m, deg]
  double time;
  double way_deg() const { return degrees(turn_rate * time); }
  double yaw_deg() const { return way_deg() + drift; }  // to port
  double bow_down_deg() const { return -2 + 4.9 * std::sin(1.3 * time); }
  double roll_deg() const { return 8 * std::sin(2.1 * time + 0.4); }
  Eigen::Vector3d position() const {
    return {-3 + radius * std::sin(turn_rate * time), radius * (1 - std::cos(turn_rate * time)) - 3, -1.5};
  }
  Pose pose() const {
    return pose_from_yaw_pitch_roll(position(), radians(yaw_deg()), radians(bow_down_deg()), radians(roll_deg()));
  }
};

constexpr double entry_step = 0.1, ping_step = 0.7;  // [s]

}  // namespace

class ExportGsf : public ToolTest {
 protected:
  /// The survey of a sloping bed with an em2040 that is pitched by 1 degree and rolled by 4, below the ship's origin: at a
  /// depth of 2.2 m to some millimetres.
  void SetUp() override {
    write("bed.obj", "v -24 -24 -12\nv 24 -24 -12\nv 24 24 -11\nv -24 24 -11\nf 1 2 3\nf 1 3 4\n");
    std::ostringstream way;
    way << "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n" << std::setprecision(12);
    for (int i = 0; i <= 32; ++i) {
      const Ship ship{entry_step * i};
      const Eigen::Vector3d at = ship.position();
      way << ship.time << ',' << at.x() << ',' << at.y() << ',' << at.z() << ',' << ship.yaw_deg() << ','
          << ship.bow_down_deg() << ',' << ship.roll_deg() << '\n';
    }
    write("way.csv", way.str());
    write("svp.csv", "depth_m,sound_speed\n1,1510\n2,1500\n11,1465\n");
    write("sea.toml", "[water]\ndepth_m = 2.2\n[surface]\nheight_m = 0.5\n");  // the head is at z = -1.7
    write("ship.toml", R"(schema = 1
[survey]
scene = "bed.obj"
environment = "sea.toml"
profile = "svp.csv"
anchor = { latitude_deg = -33.9, longitude_deg = -71.5, heading_deg = 40 }
start_utc = "2026-05-01T08:30:00Z"
[trajectory]
file = "way.csv"
nav_noise = { position_m = 0 }
[[head]]
sonar = "em2040"
name = "swath"
set = ["sonar.beams=32", "sonar.field_of_view_deg=90"]
range = "6:20"
times_s = [0, 0.7, 1.4, 2.1, 2.8]
offset_m = [0, 0, -0.2]
pitch_deg = 1
roll_deg = 4
[ping]
split = true
)");
    have("run", "survey ship.toml");
    succeed("export run --to gsf -q -o ship.gsf");
  }
  decode::GsfContent content(const std::string& file = "ship.gsf") const { return decode::read_gsf(read(file)); }
};

TEST_F(ExportGsf, soundings_follow_from_times_angles_and_profile) {
  const decode::GsfContent gsf = content();
  ASSERT_EQ(gsf.swaths.size(), 5U);
  EXPECT_LT(largest_difference(gsf), 0.02);
  std::size_t soundings = 0;
  bool ahead = false, astern = false;  // azimuths from 0 to 360
  for (const decode::GsfSwath& s : gsf.swaths)
    for (std::size_t b = 0; b < s.flags.size(); ++b) {
      soundings += s.flags[b] == 0;
      const double azimuth = s.arrays.at(18)[b];
      EXPECT_GE(azimuth, 0);
      EXPECT_LT(azimuth, 360);
      ahead |= azimuth > 5 && azimuth < 175;
      astern |= azimuth > 185 && azimuth < 355;
    }
  EXPECT_GT(soundings, 5 * 30U);
  EXPECT_TRUE(ahead && astern);
  // The profile reaches from the surface to below any sea floor, as ray tracers need it.
  const std::vector<std::pair<double, double>> profile = {{0, 1510}, {1, 1510}, {2, 1500}, {11, 1465}, {12000, 1465}};
  EXPECT_EQ(gsf.profile, profile);
}

// Compares soundings with the table in the world: across and along are level, as the ship heads, from the head.
TEST_F(ExportGsf, soundings_lie_where_the_table_has_them) {
  succeed("export run --to csv -q -o ship.csv");
  std::vector<std::vector<std::array<double, 3>>> expected(5);  // across, along, depth of each ping
  const Pose ship_from_head = pose_from_yaw_pitch_roll({0, 0, -0.2}, 0, radians(-1), radians(4)) *
                              pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0);
  for (const auto& row : rows_of(read("ship.csv"))) {
    const auto number = [&](const char* column) { return std::stod(row.at(column)); };
    const auto p = static_cast<std::size_t>(number("ping"));
    const Eigen::Vector3d sounding(number("x_m"), number("y_m"), number("z_m"));
    const Ship ship{ping_step * static_cast<double>(p)};
    const Eigen::Vector3d away = sounding - (ship.pose() * ship_from_head).translation();
    const double yaw = radians(ship.yaw_deg());
    expected.at(p).push_back({away.x() * std::sin(yaw) - away.y() * std::cos(yaw),
                              away.x() * std::cos(yaw) + away.y() * std::sin(yaw), -sounding.z()});
  }
  const decode::GsfContent gsf = content();
  for (std::size_t p = 0; p < 5; ++p) {
    std::vector<std::array<double, 3>> found;
    const decode::GsfSwath& s = gsf.swaths[p];
    for (std::size_t b = 0; b < s.flags.size(); ++b)
      if (s.flags[b] == 0) found.push_back({s.arrays.at(2)[b], s.arrays.at(3)[b], s.arrays.at(1)[b]});
    std::sort(expected[p].begin(), expected[p].end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), expected[p].size());
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(found[i][k], expected[p][i][k], 2e-3) << p << ' ' << i << ' ' << k;
  }
}

TEST_F(ExportGsf, attitude_course_and_speed_are_those_of_the_ship) {
  const decode::GsfContent gsf = content();
  ASSERT_EQ(gsf.attitudes.size(), 1U);
  ASSERT_EQ(gsf.attitudes[0].size(), 5U);
  for (std::size_t p = 0; p < 5; ++p) {
    const Ship ship{ping_step * static_cast<double>(p)};
    const decode::GsfSwath& s = gsf.swaths[p];
    const double heading = std::fmod(south_west.heading_deg - ship.yaw_deg() + 720, 360);
    EXPECT_NEAR(s.heading_deg, heading, 0.006) << p;
    EXPECT_NEAR(s.pitch_deg, -ship.bow_down_deg(), 0.006) << p;
    EXPECT_NEAR(s.roll_deg, ship.roll_deg(), 0.006) << p;
    // The way to the next entry of the trajectory.
    const double middle = ship.way_deg() + degrees(Ship::turn_rate * entry_step / 2);
    EXPECT_NEAR(s.course_deg, std::fmod(south_west.heading_deg - middle + 720, 360), 0.02) << p;
    EXPECT_NEAR(s.speed_knots, Ship::turn_rate * Ship::radius / 0.514444, 0.01) << p;
    const decode::GsfAttitudeEntry& attitude = gsf.attitudes[0][p];
    EXPECT_NEAR(attitude.time, s.time, 6e-4);
    EXPECT_EQ(attitude.heading_deg, s.heading_deg);
    EXPECT_EQ(attitude.pitch_deg, s.pitch_deg);
    EXPECT_EQ(attitude.roll_deg, s.roll_deg);
  }
}

// GSF counts from port, a cube along its azimuths, which are positive to port.
TEST_F(ExportGsf, beams_are_those_of_the_cube_from_the_other_side) {
  succeed("export run --to csv -q -o beams.csv");
  const decode::GsfContent gsf = content();
  std::istringstream lines(read("beams.csv"));
  std::string line;
  std::getline(lines, line);
  ASSERT_THAT(line,
              AllOf(testing::StartsWith("ping,time_s,beam,x_m,y_m,z_m,range_m,"), HasSubstr(",reject,gsf_beam,")));
  const auto gsf_beam =
      std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find("gsf_beam")), ',');
  std::size_t soundings = 0;
  while (std::getline(lines, line)) {
    std::vector<double> row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      row.push_back(field == "phase" || field == "amplitude" ? 0 : std::stod(field));
    const decode::GsfSwath& s = gsf.swaths.at(static_cast<std::size_t>(row[0]));
    const std::size_t entry = s.flags.size() - 1 - static_cast<std::size_t>(row[2]);
    EXPECT_EQ(row[static_cast<std::size_t>(gsf_beam)], static_cast<double>(entry)) << line;
    EXPECT_EQ(s.flags.at(entry), 0) << line;
    EXPECT_NEAR(s.arrays.at(1)[entry], -row[5], 0.006) << line;
    ++soundings;
  }
  EXPECT_GT(soundings, 100U);
}

// A head that looks astern has its port beams first all the same, also with several soundings of a beam.
TEST_F(ExportGsf, entries_of_the_table_are_those_of_any_mounting) {
  write("turned.toml", replaced(read("ship.toml"), "[[head]]", "[[head]]\nheading_deg = 180"));
  succeed("survey turned.toml -q -o turned");
  for (const std::string more : {"", " --per-beam 3"}) {
    succeed("export turned --to gsf -q --force -o turned.gsf" + more);
    succeed("export turned --to csv -q --force -o turned.csv" + more);
    const decode::GsfContent gsf = content("turned.gsf");
    std::istringstream lines(read("turned.csv"));
    std::string line;
    std::getline(lines, line);
    const auto column =
        std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find("gsf_beam")), ',');
    std::size_t soundings = 0;
    while (std::getline(lines, line)) {
      std::vector<std::string> row;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
      const decode::GsfSwath& s = gsf.swaths.at(std::stoul(row[0]));
      const std::size_t entry = std::stoul(row[static_cast<std::size_t>(column)]);
      EXPECT_NEAR(s.arrays.at(1).at(entry), -std::stod(row[5]), 0.006) << line;
      EXPECT_NEAR(s.arrays.at(9).at(entry), std::min(5.1, std::stod(row[9])), 0.011) << line;
      ++soundings;
    }
    EXPECT_GT(soundings, 100U);
  }
}

// A single ping has the course and speed of its trajectory or of its velocity, though it has one position only.
TEST_F(ExportGsf, single_pings_have_the_course_and_speed_of_their_trajectory) {
  write("sea.toml", "[surface]\nheight_m = 0.5\n");
  const std::string ping = "ping bed.obj --sonar em2040 --environment sea.toml --range 6:20 --set sonar.beams=8 -q ";
  const std::string as_gsf = " --to gsf --anchor -33.9,-71.5,40 -q -o ";
  succeed(ping + "--trajectory way.csv --time 1.4 --mount=0.5,0,-0.2,0,89,4 -o on-way");
  succeed("export on-way" + as_gsf + "on-way.gsf");
  const Ship ship{1.4};
  const decode::GsfSwath s = content("on-way.gsf").swaths.at(0);
  const double middle = ship.way_deg() + degrees(Ship::turn_rate * entry_step / 2);
  EXPECT_NEAR(s.course_deg, std::fmod(40 - middle + 720, 360), 0.02);
  EXPECT_NEAR(s.speed_knots, Ship::turn_rate * Ship::radius / 0.514444, 0.01);
  // The file is looked up beside the run, too; another trajectory by now is not taken for that of the ping.
  write("way.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-1,0,0,0\n3,3,0,-1,0,0,0\n");
  const ToolResult other = run("export on-way --to gsf --anchor -33.9,-71.5,40 -o other.gsf");
  EXPECT_EQ(other.exit_code, 0);
  EXPECT_THAT(other.err,
              HasSubstr("way.csv: is not the trajectory of the pings of on-way/run.toml (it is elsewhere at 1.4 "
                        "s); their way is that through their own places"));
  EXPECT_EQ(content("other.gsf").swaths.at(0).speed_knots, 0);
  write("way.csv", "no table");
  EXPECT_THAT(run("export on-way --to gsf --anchor -33.9,-71.5,40 -o text.gsf").err,
              HasSubstr("way.csv: is not the trajectory of the pings"));
  succeed(ping + "--pose=0,0,-1.7,0,89,0 --velocity=0,-2,0.1 -o fast");
  succeed("export fast" + as_gsf + "fast.gsf");
  EXPECT_NEAR(content("fast.gsf").swaths.at(0).speed_knots, 2 / 0.514444, 0.0051);
  EXPECT_NEAR(content("fast.gsf").swaths.at(0).course_deg, 130, 0.0051);
}

TEST_F(ExportGsf, depth_of_the_head_height_and_place_are_those_of_the_track) {
  succeed("merge -q run");
  const auto track = read_json("run/track.geojson")["features"][0]["geometry"]["coordinates"];
  const decode::GsfContent gsf = content();
  const Pose ship_from_head = pose_from_yaw_pitch_roll({0, 0, -0.2}, 0, radians(-1), radians(4)) *
                              pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0);
  for (std::size_t p = 0; p < 5; ++p) {
    const decode::GsfSwath& s = gsf.swaths[p];
    const double z = (Ship{ping_step * static_cast<double>(p)}.pose() * ship_from_head).translation().z();
    EXPECT_NEAR(s.depth_corrector, 0.5 - z, 0.0051) << p;  // the water level is at z = 0.5
    EXPECT_NEAR(s.tide, -0.5, 1e-9);
    EXPECT_EQ(s.heave, 0);
    EXPECT_NEAR(s.longitude_deg, track[p][0].get<double>(), 0.6e-7);
    EXPECT_NEAR(s.latitude_deg, track[p][1].get<double>(), 0.6e-7);
    EXPECT_NEAR(s.height, track[p][2].get<double>(), 0.0011);
    EXPECT_NEAR(s.height - s.separation, z, 0.0011);
    EXPECT_NEAR(s.of_sensor.at("transducer_depth"), 0.5 - z, 1e-4);
    EXPECT_NEAR(s.of_sensor.at("vehicle_depth"), 2, 1e-3);
  }
  ASSERT_TRUE(gsf.summary.has_value());
  EXPECT_NEAR(gsf.summary->end - gsf.summary->begin, 2.8, 1e-6);
  // A merged head says the same.
  succeed("export run/swath --to gsf -q -o merged.gsf");
  EXPECT_TRUE(read("merged.gsf") == read("ship.gsf"));
}

TEST_F(ExportGsf, names_sonar_versions_and_how_the_head_is_mounted) {
  const decode::GsfContent gsf = content();
  EXPECT_EQ(gsf.records, (std::vector<int>{1, 9, 6, 7, 4, 3, 11, 2, 2, 2, 2, 2, 12}));
  ASSERT_EQ(gsf.comments.size(), 1U);
  const std::string version = read_cube(path("run/swath/blocks/000000.h5"), 0, 1).insonify_version;
  EXPECT_EQ(gsf.comments[0], "sonar em2040, simulated by insonify " + version);
  ASSERT_EQ(gsf.histories.size(), 1U);
  EXPECT_EQ(gsf.histories[0].command, "insonify export --to gsf");
  EXPECT_THAT(gsf.histories[0].comment, HasSubstr("by insonify " + version));
  for (const decode::GsfSwath& s : gsf.swaths) {
    EXPECT_EQ(s.sensor, 149);
    EXPECT_EQ(s.of_sensor.at("model_number"), 2040);
    EXPECT_EQ(s.centre_beam, 16) << "half of the beams, else the GSF library takes it for one of two heads";
    EXPECT_NEAR(s.of_sensor.at("surface_velocity"), 1499.2, 0.051);  // of the profile at 2.2 m
    EXPECT_NEAR(s.of_sensor.at("sector_frequency"), 4e5, 1);
    EXPECT_NEAR(s.of_sensor.at("receive_beam_width_deg"), 1, 0.051);
  }
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_OFFSET"), "+00.00,+00.00,+00.20");
  // Checks the mounting angles, as the mission states them.
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_PITCH_OFFSET"), "+01.00");
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_ROLL_OFFSET"), "+04.00");
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_HEADING_OFFSET"), "+00.00");
  EXPECT_EQ(gsf.parameter.at("PLATFORM_TYPE"), "AUV");
  EXPECT_EQ(gsf.parameter.at("TIDE_COMPENSATED"), "YES");
  EXPECT_NEAR(std::stod(gsf.parameter.at("APPLIED_DRAFT")), gsf.swaths[0].depth_corrector, 0.0051);
}

// A ship that dives below a water level of z = 0.75, with its head ahead of the origin, to port and below.
TEST_F(ExportGsf, of_a_ship_that_dives_follows_its_depth) {
  write("dive.toml",
        text_of({.survey = "anchor = { latitude_deg = 54.1, longitude_deg = -7.9, heading_deg = 200 }",
                 .way = "[-4, 0, -1], [4, 0, -3]",
                 .speed = "2",
                 .sonar = "r2sonic-2024",
                 .range = "6:20",
                 .head = "set = [\"sonar.beams=32\", \"sonar.field_of_view_deg=90\"]\ntimes_s = [0, 1, 2]\n"
                         "offset_m = [0.5, 0.3, -0.2]",
                 .more = "[water]\nlevel_m = 0.75\ndatum = \"LAT\""}));
  succeed("survey dive.toml -q -o dive");
  succeed("export dive --to gsf -q -o dive.gsf");
  const decode::GsfContent gsf = content("dive.gsf");
  EXPECT_LT(largest_difference(gsf), 0.02);
  ASSERT_EQ(gsf.swaths.size(), 3U);
  const double length = std::hypot(8, 2), speed = 2 * 8 / length, sinking = 2 * 2 / length;
  for (std::size_t p = 0; p < 3; ++p) {
    const decode::GsfSwath& s = gsf.swaths[p];
    EXPECT_NEAR(s.depth_corrector, 0.75 + 1 + 0.2 + sinking * static_cast<double>(p), 0.0051) << p;
    EXPECT_NEAR(s.tide, -0.75, 1e-9);
    EXPECT_NEAR(s.speed_knots, speed / 0.514444, 0.006);  // over ground
    EXPECT_NEAR(s.course_deg, 200, 0.006);
  }
  EXPECT_EQ(gsf.parameter.at("TIDAL_DATUM"), "LAT");
  EXPECT_EQ(gsf.parameter.at("TIDE_COMPENSATED"), "YES");
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_OFFSET"), "+00.50,-00.30,+00.20");
  EXPECT_NEAR(gsf.swaths[1].of_sensor.at("ping_period"), 1, 1e-6);
  // Another level than that of the sea surface is refused.
  write("other.toml", "[surface]\nheight_m = 1\n");
  write("wrong.toml", replaced(read("dive.toml"), "[survey]", "[survey]\nenvironment = \"other.toml\""));
  expect_refused("survey wrong.toml -o wrong", 2,
                 {"water.level_m = 0.75", "surface.height_m = 1", "leave one of them"});
}

// A head that scans turns, and its ship does not.
TEST_F(ExportGsf, of_a_scanning_head_has_the_attitude_of_its_ship) {
  write("scan.toml",
        text_of(
            {.survey = "anchor = { latitude_deg = -10, longitude_deg = 179.9, heading_deg = 90 }",
             .way = "[0, 0, -1], [1, 0, -1]",
             .sonar = "seaking-profiler",
             .range = "6:20",
             .more = "[head.scan]\nstart_deg = -40\nstop_deg = 40\nstep_deg = 20\nmode = \"sector\"\ndwell_s = 0.2"}));
  succeed("survey scan.toml -q -o scan");
  succeed("export scan --to gsf -q -o scan.gsf");
  const decode::GsfContent gsf = content("scan.gsf");
  ASSERT_GE(gsf.swaths.size(), 5U);
  for (std::size_t p = 0; p < 5; ++p) {
    const decode::GsfSwath& s = gsf.swaths[p];
    EXPECT_NEAR(s.heading_deg, 90, 0.006);
    EXPECT_NEAR(s.roll_deg, 0, 0.006);
    EXPECT_NEAR(s.pitch_deg, 0, 0.006);
    ASSERT_EQ(s.flags, std::vector<int>{0});
    // Only the pulse has an elevation, so the echo comes from abeam of where the ship was when it sent (E219).
    EXPECT_NEAR(s.arrays.at(5)[0], std::abs(-40 + 20 * static_cast<double>(p)), 0.003);
  }
  EXPECT_LT(largest_difference(gsf), 0.02);
}

// A run of one ping has the attitude of its --mount; of a cube alone the port axis is all that is known.
TEST_F(ExportGsf, of_a_ping_has_the_attitude_of_its_mounting) {
  succeed(
      "ping bed.obj --sonar r2sonic-2024 --set sonar.beams=32 --set sonar.field_of_view_deg=90 "
      "--mount=0.5,0,-0.2,0,90,0 --pose=0,0,-1,30,-3,5 "
      "--range 6:20 --no-picture -q -o one");
  succeed("export one --to gsf --anchor 54.1,-7.9,100 -q -o one.gsf");
  const decode::GsfContent gsf = content("one.gsf");
  const decode::GsfSwath& s = gsf.swaths.at(0);
  EXPECT_NEAR(s.heading_deg, 70, 0.006);
  EXPECT_NEAR(s.pitch_deg, 3, 0.006);
  EXPECT_NEAR(s.roll_deg, 5, 0.006);
  EXPECT_NEAR(s.course_deg, 70, 0.006);  // at rest
  EXPECT_EQ(s.speed_knots, 0);
  EXPECT_EQ(s.sensor, 152);
  EXPECT_EQ(s.sensor_model.substr(0, 5), std::string("2024\0", 5));
  EXPECT_LT(largest_difference(gsf), 0.02);
  EXPECT_EQ(gsf.parameter.at("APPLIED_TRANSDUCER_OFFSET"), "+00.50,+00.00,+00.20");
  EXPECT_EQ(gsf.parameter.at("TIDE_COMPENSATED"), "NO");
  EXPECT_TRUE(gsf.position_errors.empty());
  succeed("export one/cube.h5 --to gsf --anchor 54.1,-7.9,100 -q -o cube.gsf");
  const decode::GsfContent alone = content("cube.gsf");
  EXPECT_EQ(alone.swaths.at(0).pitch_deg, 0);
  EXPECT_EQ(alone.parameter.at("APPLIED_TRANSDUCER_OFFSET"), "UNKNWN,UNKNWN,UNKNWN");
  EXPECT_LT(largest_difference(alone), 0.02);
}

// Without a mission, from ping to ping: the first moves as the second.
TEST_F(ExportGsf, of_pings_without_a_mission_has_the_motion_between_them) {
  Cube cube = read_cube(path("run/swath/blocks/000000.h5"));
  for (std::size_t p = 0; p < cube.pings.size(); ++p)
    cube.pings[p].world_from_head.translation() = Eigen::Vector3d(0.7 * static_cast<double>(p), 0, -2);
  write_cube(path("line.h5"), cube);
  succeed("export line.h5 --to gsf --anchor=-33.9,-71.5,120 -q -o line.gsf");
  for (const decode::GsfSwath& s : content("line.gsf").swaths) {
    EXPECT_NEAR(s.course_deg, 120, 0.011);
    EXPECT_NEAR(s.speed_knots, 1 / 0.514444, 0.006);
  }
}
