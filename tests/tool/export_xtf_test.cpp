// SPDX-License-Identifier: BSD-3-Clause
// Side-scans and scanning heads as XTF, read by a decoder from the specification: samples are the levels of the cubes, and
// places, attitude and altitude those of the ship.
#include "core/geodesy.hpp"
#include "formats/xtf_decoder.hpp"
#include "returns/quantise.hpp"
#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

namespace {

const Anchor north_sea{54.1, 7.9, 70};

/// A level bed 5 m below the way, of two heads to either side and a scanning one; starboard pings half as often.
const std::string two_sides = R"(schema = 1
[survey]
scene = "bed.obj"
anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 70 }
start_utc = "2026-05-01T08:30:00Z"
[water]
level_m = 2
[trajectory]
waypoints_m = [[-1.5, 0, 0], [1.5, 0, 0]]
speed_m_s = 1
[[head]]
name = "right"
sonar = "starfish-450"
side = "starboard"
range = "1:16"
set = ["sonar.bandwidth_hz=7500"]
every_m = 0.8
offset_m = [0, -0.5, -0.25]
[[head]]
name = "left"
sonar = "starfish-450"
range = "1:16"
set = ["sonar.bandwidth_hz=7500"]
every_m = 0.4
offset_m = [0, 0.5, -0.25]
)";
const std::string turning = R"(schema = 1
[survey]
scene = "bed.obj"
anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 70 }
[trajectory]
waypoints_m = [[-1.5, 0, 0], [1.5, 0, 0]]
speed_m_s = 1
[[head]]
name = "turning"
sonar = "ping360"
range = "1:8"
set = ["sonar.range_resolution_m=0.1"]
pitch_deg = -30
[head.scan]
start_deg = -90
stop_deg = 90
step_deg = 45
dwell_s = 0.5
)";

class ExportXtf : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", "v -9 -17 -5\nv 9 -17 -5\nv 9 17 -5\nv -9 17 -5\nf 1 2 3\nf 1 3 4\n");
    write("m.toml", two_sides);
    write("t.toml", turning);
    have("line", "survey m.toml -q");
  }
  decode::XtfContent exported(const std::string& arguments) const {
    succeed("export " + arguments + " --to xtf -o line.xtf -q --force");
    return decode::read_xtf_file(read("line.xtf"));
  }
  /// The ping of a head at a time, from its blocks.
  Ping ping_at(const std::string& head, double time) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("line/" + head)))
      if (entry.path().extension() == ".h5")
        for (Ping& ping : read_cube(entry.path().string()).pings)
          if (std::abs(ping.time - time) < 1e-6) return std::move(ping);
    return {};
  }
};

double seconds_of(const decode::XtfSonarPacket& p) {
  return 3600 * p.hour + 60 * p.minute + p.second + 0.01 * p.hundredth - (8 * 3600 + 30 * 60);
}

}  // namespace

TEST_F(ExportXtf, has_both_sides_of_a_line) {
  const decode::XtfContent read = exported("line");
  EXPECT_EQ(read.program, "insonify");
  EXPECT_EQ(read.sonar, "starfish-450");
  ASSERT_EQ(read.channels.size(), 2U);
  EXPECT_EQ(read.channels[0].type, 1);  // port before starboard, whatever the order of the mission
  EXPECT_EQ(read.channels[0].name, "left");
  EXPECT_EQ(read.channels[1].type, 2);
  EXPECT_EQ(read.channels[1].name, "right");
  EXPECT_EQ(read.channels[1].frequency, 450);
  EXPECT_NEAR(read.channels[1].tilt, 30, 1e-4);
  EXPECT_NEAR(read.channels[1].beam_angle, 2, 1e-5);
  EXPECT_NEAR(read.channels[1].beam_width, 60, 1e-4);
  ASSERT_EQ(read.pings.size(), 8U);  // every 0.4 m of 3 m; a second head shares every other one
  for (std::size_t k = 0; k < read.pings.size(); ++k) {
    const decode::XtfSonarPacket& p = read.pings[k];
    EXPECT_EQ(p.number, k);
    EXPECT_EQ(p.channels.size(), k % 2 == 0 ? 2U : 1U) << k;
    EXPECT_NEAR(seconds_of(p), 0.4 * static_cast<double>(k), 0.0051);
    EXPECT_EQ(p.year, 2026);
  }
}

TEST_F(ExportXtf, has_the_ship_where_it_is) {
  const decode::XtfContent read = exported("line");
  for (const decode::XtfSonarPacket& p : read.pings) {
    const double x = -1.5 + seconds_of(p);
    const GeoPosition ship = geo_from_world(north_sea, {x, 0, 0}), sonar = geo_from_world(north_sea, {x, 0.5, -0.25});
    EXPECT_NEAR(p.ship_y, degrees(ship.latitude), 1e-7);  // times are of 0.01 s
    EXPECT_NEAR(p.ship_x, degrees(ship.longitude), 1e-7);
    EXPECT_NEAR(p.sensor_y - p.ship_y, degrees(sonar.latitude - ship.latitude), 1e-9);
    EXPECT_NEAR(p.sensor_x - p.ship_x, degrees(sonar.longitude - ship.longitude), 1e-9);
    EXPECT_NEAR(p.heading, 70, 1e-3);
    EXPECT_NEAR(p.ship_gyro, 70, 1e-3);
    EXPECT_NEAR(p.pitch, 0, 1e-4);
    EXPECT_NEAR(p.roll, 0, 1e-4);
    EXPECT_EQ(p.yaw, 0);
    EXPECT_NEAR(p.ship_speed, 3600 / 1852.0, 1e-3);
    EXPECT_NEAR(p.depth, 2.25, 1e-6);     // the water level is at z = 2, the sonar at -0.25
    EXPECT_NEAR(p.altitude, 4.75, 0.15);  // by the first return, in bins of 0.1 m
    EXPECT_NEAR(p.computed_speed, ping_at("left", seconds_of(p)).sound_speed, 1e-3);
  }
}

// Samples are amplitudes with the gain of a bottom, in steps that the annotation says; with --linear as they were received.
TEST_F(ExportXtf, has_the_levels_of_the_pings) {
  const auto check = [&](const decode::XtfContent& read, double step, bool gained) {
    for (const decode::XtfSonarPacket& p : read.pings)
      for (const decode::XtfChannelOfPing& c : p.channels) {
        const bool port = c.channel == 0;
        const Ping ping = ping_at(port ? "left" : "right", seconds_of(p));
        ASSERT_EQ(ping.pressure.rows(), 1);
        std::vector<double> samples = c.samples;
        if (port) std::reverse(samples.begin(), samples.end());
        const auto before = static_cast<std::size_t>(ping.gate.min_range / ping.gate.bin_size);
        ASSERT_EQ(samples.size(), before + ping.gate.bins());
        EXPECT_NEAR(c.slant_range, ping.gate.min_range + static_cast<double>(ping.gate.bins()) * ping.gate.bin_size,
                    1e-4);
        EXPECT_NEAR(c.delay * ping.sound_speed / 2,
                    ping.gate.min_range - static_cast<double>(before) * ping.gate.bin_size, 1e-5);
        EXPECT_EQ(c.flags, gained ? 4 : 0);
        for (std::size_t n = 0; n < samples.size(); ++n) {
          double due = 0;
          if (n >= before) {
            const auto bin = static_cast<Eigen::Index>(n - before);
            const Tvg tvg{gained ? 30.0 : 0.0, gained ? ping.absorption_db_per_m : 0.0};
            due = static_cast<double>(std::abs(ping.pressure(0, bin))) *
                  amplitude_from_db(gain_db(tvg, ping.gate.centre(n - before))) / step;
          }
          EXPECT_NEAR(samples[n], due, gained ? 0.5 + 1e-6 * due : 1e-6 * due) << n;
        }
      }
  };
  const decode::XtfContent gained = exported("line");
  ASSERT_EQ(gained.notes.size(), 1U);
  double step = 0;
  ASSERT_EQ(std::sscanf(gained.notes[0].c_str(), "%*[^=]= value * %lf", &step), 1) << gained.notes[0];
  check(gained, step, true);
  double largest = 0;
  for (const auto& p : gained.pings)
    for (const auto& c : p.channels) largest = std::max(largest, *std::max_element(c.samples.begin(), c.samples.end()));
  EXPECT_EQ(largest, 65535);
  const decode::XtfContent linear = exported("line --linear");
  EXPECT_EQ(linear.channels[0].format, 5);
  EXPECT_THAT(linear.notes.at(0), HasSubstr("amplitude [Pa] = value, as received"));
  check(linear, 1, false);
}

TEST_F(ExportXtf, of_one_head_has_one_channel) {
  const decode::XtfContent read = exported("line --head right");
  ASSERT_EQ(read.channels.size(), 1U);
  EXPECT_EQ(read.channels[0].type, 2);
  EXPECT_EQ(read.pings.size(), 4U);
  EXPECT_EQ(read.pings[1].channels.at(0).channel, 0);
  EXPECT_NEAR(read.pings[1].channels[0].period, 0.8, 1e-3);
}

TEST_F(ExportXtf, says_where_a_scanning_head_looks) {
  succeed("survey t.toml -q -o turned");
  const decode::XtfContent read = exported("turned --start-utc 2026-05-01T08:30:00Z");
  ASSERT_GE(read.pings.size(), 5U);
  EXPECT_EQ(read.channels.at(0).type, 2);
  for (std::size_t k = 0; k < 5; ++k) {
    const double turn =
        radians(90 - 45.0 * static_cast<double>(k));  // from starboard to port, about an axis tilted by 30
    EXPECT_NEAR(read.pings[k].yaw, degrees(std::atan2(std::sin(turn), std::cos(turn) * std::cos(radians(30)))), 1e-3)
        << k;
    EXPECT_NEAR(read.pings[k].heading, 70, 1e-3);
  }
}

TEST_F(ExportXtf, is_the_same_twice_and_reads_as_a_record) {
  succeed("export line --to xtf -o a.xtf -q");
  const std::string once = read("a.xtf");
  succeed("export line --to xtf -o a.xtf -q --force");
  EXPECT_TRUE(read("a.xtf") == once);
  const nlohmann::json info = json_of("info a.xtf");
  EXPECT_EQ(info["pings"], 8);
  EXPECT_EQ(info["beams"], 2);
  EXPECT_EQ(info["channels"], (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(info["first_utc"], "2026-05-01T08:30:00.000Z");
  EXPECT_NEAR(info["track_length_m"].get<double>(), 2.8, 1e-3);
  EXPECT_NEAR(info["latitude_deg"].get<double>(), 54.1, 1e-4);
  // Compares linear samples, peak pressures in Pa, with levels in dB re 1 uPa rms.
  succeed("merge line -q");
  succeed("export line --head right --to xtf --linear -o b.xtf -q");
  const nlohmann::json levels = json_of("compare line/right b.xtf")["levels"];
  EXPECT_NEAR(levels["bias_db"].get<double>(), db_from_amplitude(1e6 / std::sqrt(2.0)), 1e-3);
  EXPECT_LT(levels["deviation_db"].get<double>(), 1e-3);
}

TEST_F(ExportXtf, refuses_what_it_is_not_for) {
  write("n.toml",
        insonify::replaced(two_sides, "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 70 }\n", ""));
  succeed("survey n.toml -q -o nowhere");
  expect_refused("export nowhere --to xtf -o x.xtf", 2,
                 {"does not say where on the globe it is, which --to xtf needs", "--anchor"});
  succeed("ping bed.obj --sonar p900-45 --set sonar.beams=8 --pose=0,0,0,0,30,0 --range 2:9 --no-picture -q -o fan");
  expect_refused("export fan --to xtf --anchor 54,8 -o x.xtf", 3,
                 {"fan", "p900-45 has 8 beams; --to xtf is of side-scans and scanning heads"});
  expect_refused("export line --to xtf --keep-rejected -o x.xtf", 2, {"--to = xtf has no soundings of the bottom"});
  expect_refused("export line --to xtf --crs local -o x.xtf", 2, {"--crs goes with --to geotiff"});
  expect_refused("export line --to xtf --head none -o x.xtf", 2,
                 {"--head = 'none' must name a head of line: right, left"});
}
