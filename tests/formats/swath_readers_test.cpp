// SPDX-License-Identifier: BSD-3-Clause
// Swaths of an independent writer, write_swaths.py, and GSF files of our own against an independent decoder.
#include <Eigen/Geometry>

#include "core/error.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/gsf_file.hpp"
#include "formats/gsf_record.hpp"
#include "formats/kmall_record.hpp"
#include "formats/r2sonic_record.hpp"
#include "support/page.hpp"
#include "support/test.hpp"

namespace {

using Numbers = std::vector<double>;

class WrittenSwaths : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = own_path("swaths");
    std::filesystem::create_directories(folder_);
    if (std::system(("/usr/bin/python3 " INSONIFY_WRITE_SWATHS " " + folder_).c_str()) != 0)
      GTEST_SKIP() << "/usr/bin/python3 is not there";
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

const Numbers& array_of(const GsfRecordedPing& ping, int id) { return *ping.array(static_cast<GsfArrayId>(id)); }

/// Returns a ping of two soundings and a beam without one, with fractions that the format rounds.
GsfPing swath_to_read_back() {
  GsfPing ping;
  ping.time = 1777624200.25, ping.position = {radians(54.1234567), radians(-7.7654321), 3.0625};
  ping.heading = radians(301.25), ping.roll = radians(-2.5), ping.pitch = radians(1.75), ping.head_depth = 1.57;
  ping.tide = -0.34, ping.surface_sound_speed = 1487.3, ping.range = 75;
  ping.beams = {
      {true, 20.12345, -31.00054, 0.5, 0.0493827, radians(57), radians(179), 101.43, 3.26, 0.0123, 0.0321, true},
      {},
      {true, 18.5, 7.25, -0.125, 0.02654321, radians(21.37), radians(-1.5), 133.67, 4.5, 0.002, 0.001, false, true}};
  return ping;
}

}  // namespace

TEST(SwathReaders, own_gsf_reads_as_an_independent_decoder_reads_it) {
  const std::string path = own_path("own.gsf");
  GsfSurvey survey;
  survey.profile = {{0, 12.5}, {1490.25, 1481}}, survey.time = 1777624200;
  GsfFile file(path, survey);
  file.add(swath_to_read_back());
  file.finish();
  const decode::GsfSwath other = decode::read_gsf(file_bytes(path)).swaths.at(0);
  const GsfRecordedPing ping = read_gsf(path).pings.at(0);
  for (const auto& [id, values] : other.arrays) EXPECT_EQ(array_of(ping, id), values) << id;
  EXPECT_EQ(ping.arrays.size(), other.arrays.size() + 1);  // and the flags
  EXPECT_EQ(ping.header.at("LATITUDE"), other.latitude_deg);
  EXPECT_EQ(ping.header.at("LONGITUDE"), other.longitude_deg);
  EXPECT_EQ(ping.header.at("DEPTH_CORRECTOR"), other.depth_corrector);
  EXPECT_EQ(ping.header.at("HEADING"), other.heading_deg);
  EXPECT_EQ(ping.header.at("ROLL"), other.roll_deg);
  EXPECT_EQ(ping.header.at("HEIGHT"), other.height);
  const SwathPing swath = read_swath(path).pings.at(0);
  ASSERT_EQ(swath.soundings.size(), 2U);
  EXPECT_TRUE(swath.soundings[1].rejected);
  EXPECT_NEAR(swath.soundings[0].vertical_deviation, 0.0123, 5e-5);
}

TEST_F(WrittenSwaths, gsf_gives_all_arrays_as_raw_over_multiplier_less_offset) {
  const GsfRecord record = read_gsf(path("arrays.gsf"));
  EXPECT_EQ(record.version, "3.08");
  ASSERT_EQ(record.pings.size(), 2U);
  const GsfRecordedPing& ping = record.pings[0];
  EXPECT_EQ(array_of(ping, 1), (Numbers{100.0 + 3890, 200.0 + 3890, 300.0 + 3890, 400.0 + 3890, 655.35 + 3890}));
  EXPECT_EQ(array_of(ping, 2), (Numbers{-400, -0.001, 0, 0.001, 400}));
  EXPECT_EQ(array_of(ping, 3), (Numbers{-1.0 - 7, -0.5 - 7, -7, 0.5 - 7, 1.0 - 7}));
  EXPECT_EQ(array_of(ping, 4), (Numbers{5, 4, 3, 4, 5}));
  EXPECT_EQ(array_of(ping, 5), (Numbers{-50, -25, 0, 25, 50}));
  EXPECT_EQ(array_of(ping, 6), (Numbers{-30, -29.9, -29.8, -29.7, 100}));
  EXPECT_EQ(array_of(ping, 10), (Numbers{-1.28, -0.01, 0, 0.01, 1.27}));
  EXPECT_EQ(array_of(ping, 14), (Numbers{5, 15, 25, 35, 429496729.5 - 5}));
  EXPECT_EQ(array_of(ping, 15), (Numbers{0, 1, 2, 3, 2}));
  EXPECT_EQ(array_of(ping, 16), (Numbers{0, 1, 2, 4, 8}));
  EXPECT_EQ(array_of(ping, 17), (Numbers{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(array_of(ping, 18), (Numbers{180, 180, 90, 0, 0}));
  EXPECT_EQ(array_of(ping, 19), (Numbers{1.96, 0.98, 0, 0.98, 1.96}));
  EXPECT_EQ(array_of(ping, 20), (Numbers{3.92, 1.96, 0, 1.96, 3.92}));
  EXPECT_EQ(array_of(ping, 31), (Numbers{1, 2, 3, 4, 5}));
  EXPECT_EQ(ping.arrays.size(), 15U);  // without the series of intensities
  EXPECT_EQ(ping.header.at("GPS_TIDE_CORRECTOR"), 5.5);
  // Scales hold until others are stated.
  EXPECT_EQ(array_of(record.pings[1], 1), (Numbers{0.005, 0.01, 0.015, 0.02, 0.025}));
  EXPECT_EQ(array_of(record.pings[1], 2), (Numbers{1, 2, 3, 4, 5}));
}

TEST_F(WrittenSwaths, gsf_keeps_profiles_attitudes_and_comments_and_counts_what_it_skips) {
  const GsfRecord record = read_gsf(path("arrays.gsf"));
  ASSERT_EQ(record.profiles.size(), 1U);
  EXPECT_EQ(record.profiles[0].time, 1500000000.5);
  EXPECT_EQ(record.profiles[0].depth, (Numbers{0, 12.5}));
  EXPECT_EQ(record.profiles[0].sound_speed, (Numbers{1490.25, 1481}));
  ASSERT_EQ(record.attitudes.size(), 2U);
  EXPECT_EQ(record.attitudes[1].time, 1500000000.5);
  EXPECT_DOUBLE_EQ(record.attitudes[1].pitch, radians(1));
  EXPECT_DOUBLE_EQ(record.attitudes[1].roll, radians(-2));
  EXPECT_DOUBLE_EQ(record.attitudes[1].heading, radians(359.99));
  EXPECT_EQ(record.attitudes[1].heave, -0.05);
  EXPECT_EQ(record.comments, std::vector<std::string>{"made"});
  EXPECT_EQ(record.records.at("swath"), 2U);
  EXPECT_EQ(record.records.at("single-beam ping"), 1U);
  const SwathRecord swath = swath_of(record);
  ASSERT_EQ(swath.pings[0].soundings.size(), 5U);
  EXPECT_EQ(swath.unit, "dB re 1 uPa");
  EXPECT_NEAR(swath.pings[0].soundings[0].vertical_deviation, 1, 1e-3);
  EXPECT_NEAR(swath.pings[0].soundings[0].horizontal_deviation, 2, 1e-3);
  EXPECT_TRUE(std::isnan(swath.pings[0].soundings[2].vertical_deviation));  // 0 is not stated
  EXPECT_TRUE(swath.pings[0].soundings[1].rejected);
  EXPECT_FALSE(swath.pings[0].soundings[2].rejected);
  EXPECT_NEAR(swath.pings[0].head_depth, 1.57 - 0.34 + 5.5, 1e-9);
  EXPECT_NEAR(swath.pings[0].soundings[0].angle, std::atan2(-400, 3990 - 6.73), 1e-12);
}

TEST_F(WrittenSwaths, gsf_of_version_2_has_shorter_pings) {
  const GsfRecord record = read_gsf(path("old.gsf"));
  EXPECT_EQ(record.version, "2.09");
  EXPECT_EQ(record.records.at("other"), 1U);
  EXPECT_FALSE(record.pings[0].header.contains("HEIGHT"));
  EXPECT_EQ(record.pings[0].header.at("SPEED"), 3.89);
  const SwathRecord swath = swath_of(record);
  EXPECT_EQ(swath.unit, "dB re unknown");
  ASSERT_EQ(swath.pings[0].soundings.size(), 2U);  // a beam of zeros has no sounding
  EXPECT_EQ(swath.pings[0].soundings[1].beam, 2U);
  EXPECT_EQ(swath.pings[0].soundings[1].depth, 18.5);
  EXPECT_EQ(swath.pings[0].soundings[1].across, 30);
  EXPECT_EQ(swath.pings[0].soundings[1].level_db, 127.5);
  EXPECT_TRUE(swath.pings[0].soundings[1].rejected);  // flag 5
  EXPECT_FALSE(swath.pings[0].soundings[0].rejected);
}

TEST_F(WrittenSwaths, r2sonic_packets_give_times_angles_levels_and_gates) {
  const std::string bytes = file_bytes(path("angles.xtf"));
  const R2SonicPacket packet = read_r2sonic_packet(bytes.substr(1024 + 64 + 256), "packet");
  EXPECT_EQ(packet.model, "2024");
  EXPECT_EQ(packet.serial_number, "100017");
  EXPECT_EQ(packet.number, 70000U);
  EXPECT_EQ(packet.time, 1500000000.25);
  EXPECT_EQ(packet.frequency, 4e5);
  EXPECT_EQ(packet.bandwidth, 6e4);
  EXPECT_EQ(packet.range, 75);
  EXPECT_EQ(packet.tilt, 0.5);
  const double step = static_cast<double>(2e-6F), gate = static_cast<double>(1e-4F);
  EXPECT_EQ(packet.travel_time, (Numbers{20000 * step, 15000 * step, 10000 * step, 15000 * step, 0}));
  EXPECT_EQ(packet.angle, (Numbers{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(packet.intensity, (Numbers{1000, 2000, 4000, 0, 1}));
  EXPECT_EQ(packet.gates.earliest_of_points, (Numbers{gate, 2 * gate, 3 * gate, 4 * gate, 5 * gate}));
  EXPECT_EQ(packet.gates.latest_of_points, (Numbers{6 * gate, 7 * gate, 8 * gate, 9 * gate, 10 * gate}));
  const std::string two = file_bytes(path("steps.xtf"));
  const R2SonicPacket steps = read_r2sonic_packet(two.substr(1024 + 64 + 512 + 256), "packet");
  const double scale = static_cast<double>(1e-4F);
  EXPECT_EQ(steps.angle, (Numbers{-0.75, -0.75 + 7500 * scale, -0.75 + 15000 * scale}));
  EXPECT_EQ(steps.flags, (std::vector<std::uint8_t>{11, 7, 1}));
  EXPECT_EQ(steps.gates.latest, static_cast<double>(0.05F));
  EXPECT_EQ(steps.gates.slope, static_cast<double>(0.1F));
}

// E211: a ray of the array, turned by roll (starboard down) and pitch (bow up) of the vessel.
TEST_F(WrittenSwaths, r2sonic_soundings_lie_on_straight_rays_from_the_attitude) {
  const SwathRecord record = read_r2sonic_xtf(path("steps.xtf"));
  EXPECT_EQ(record.format, "R2Sonic XTF by writer");
  EXPECT_EQ(record.sonar, "R2Sonic 2024");
  EXPECT_EQ(record.records.at("type 65"), 2U);
  EXPECT_EQ(record.records.at("type 107"), 1U);
  ASSERT_EQ(record.attitudes.size(), 1U);
  EXPECT_EQ(record.attitudes[0].time, 1500000001.5);
  EXPECT_DOUBLE_EQ(record.attitudes[0].roll, radians(-3));
  ASSERT_EQ(record.pings.size(), 2U);
  EXPECT_EQ(record.pings[0].soundings.size(), 4U);  // a point without a time has no sounding
  EXPECT_NEAR(record.pings[0].soundings[2].level_db, 20 * std::log10(4000), 1e-12);
  EXPECT_TRUE(std::isnan(record.pings[0].soundings[3].level_db));
  const SwathPing& ping = record.pings[1];
  EXPECT_DOUBLE_EQ(ping.position.latitude, radians(54.125));
  EXPECT_DOUBLE_EQ(ping.heading, radians(40));
  const double angle = -0.75, range = 750 * 20000 * static_cast<double>(2e-6F);
  // Axes ahead, to starboard, down: positive angles about them turn starboard down and the bow up.
  const Eigen::Vector3d ray = Eigen::AngleAxisd(radians(3), Eigen::Vector3d::UnitY()) *
                              Eigen::AngleAxisd(radians(-5), Eigen::Vector3d::UnitX()) *
                              Eigen::Vector3d(0, std::sin(angle), std::cos(angle)) * range;
  EXPECT_NEAR(ping.soundings[0].along, ray.x(), 1e-9);
  EXPECT_NEAR(ping.soundings[0].across, ray.y(), 1e-9);
  EXPECT_NEAR(ping.soundings[0].depth, 1.5 - 0.25 + ray.z(), 1e-9);
  EXPECT_FALSE(ping.soundings[0].rejected);
  EXPECT_TRUE(ping.soundings[2].rejected);
}

TEST_F(WrittenSwaths, kmall_keeps_to_the_lengths_that_parts_state) {
  const SwathRecord record = read_kmall(path("swath.kmall"));
  EXPECT_EQ(record.sonar, "EM 2040");
  EXPECT_EQ(record.records.at("#SPO"), 1U);
  EXPECT_EQ(record.records.at("#IIP"), 1U);
  ASSERT_EQ(record.profiles.size(), 1U);
  EXPECT_EQ(record.profiles[0].depth, (Numbers{0, 12.5}));
  EXPECT_EQ(record.profiles[0].sound_speed, (Numbers{1490.25, 1481}));
  ASSERT_EQ(record.attitudes.size(), 2U);
  EXPECT_EQ(record.attitudes[1].time, 1500000000.5);
  EXPECT_DOUBLE_EQ(record.attitudes[1].roll, radians(3.5));
  EXPECT_EQ(record.attitudes[1].heave, -0.125);
  ASSERT_EQ(record.pings.size(), 2U);
  for (const SwathPing& ping : record.pings) {
    EXPECT_EQ(ping.beams, 4U);
    ASSERT_EQ(ping.soundings.size(), 3U);  // the third has no valid detection
    EXPECT_EQ(ping.frequency, 3e5);
    EXPECT_EQ(ping.sound_speed, 1487.5);
    EXPECT_DOUBLE_EQ(ping.position.latitude, radians(54.1234567));
    EXPECT_DOUBLE_EQ(ping.heading, radians(static_cast<double>(123.45F)));
    EXPECT_DOUBLE_EQ(ping.roll, radians(3.5));
    const SwathSounding &first = ping.soundings[0], &last = ping.soundings[2];
    EXPECT_EQ(first.depth, 20.75);  // 20.25 below the reference point, which is 0.5 below the water level
    EXPECT_EQ(first.across, -15.5);
    EXPECT_EQ(first.level_db, -25.5);
    EXPECT_EQ(first.travel_time, 0.03125);
    EXPECT_EQ(first.vertical_deviation, 0.0625);
    EXPECT_EQ(first.horizontal_deviation, 0.125);
    EXPECT_EQ(last.beam, 3U);
    EXPECT_EQ(last.along, 2.25);
    EXPECT_EQ(last.across, 14.5);
    EXPECT_NEAR(last.angle, std::atan2(14.5, 23.75 - 1.75), 1e-12);
    EXPECT_TRUE(ping.soundings[1].rejected);
    EXPECT_FALSE(last.rejected);
  }
  EXPECT_EQ(record.pings[1].number, 78U);
}

// Each file cut short anywhere, and with any of its bytes changed, is read or refused by its content, nothing else.
TEST_F(WrittenSwaths, damaged_files_are_refused_by_their_content) {
  for (const char* name : {"old.gsf", "arrays.gsf", "angles.xtf", "steps.xtf", "swath.kmall"}) {
    const std::string bytes = file_bytes(path(name)),
                      damaged = path(std::string("damaged") + std::filesystem::path(name).extension().string());
    const auto read_one = [&](const std::string& content) {
      std::ofstream(damaged, std::ios::binary) << content;
      try {
        read_swath(damaged);
        return true;
      } catch (const Error& error) {
        EXPECT_TRUE(error.kind() == ErrorKind::content) << name << ": " << error.what();
        EXPECT_THAT(error.what(), HasSubstr("damaged"));
        return false;
      }
    };
    std::size_t refused = 0;
    for (std::size_t length = 0; length < bytes.size(); length += 7)
      refused += read_one(bytes.substr(0, length)) ? 0 : 1;
    EXPECT_GT(refused, 0U) << name;
    for (std::size_t at = 0; at < bytes.size(); at += 2) {
      std::string changed = bytes;
      changed[at] = std::array{'\0', '\x7f', '\xff'}[at % 3];
      read_one(changed);
    }
  }
}

TEST_F(WrittenSwaths, refusals_name_the_file_and_the_rule) {
  const auto refused = [](const auto& read, const std::string& name, const std::string& bytes, const char* part) {
    expect_error(ErrorKind::content, {name, part}, [&] { read(own_file(name, bytes)); });
  };
  std::string bytes = file_bytes(path("arrays.gsf"));
  bytes[bytes.find("made")] = 'M';
  refused(read_gsf, "sum.gsf", bytes, "the file is damaged");
  refused(read_gsf, "text.gsf", "a text that is no swath at all", "does not begin with the header of a GSF file");
  refused(read_kmall, "text.kmall", "a text that is no swath at all", "does not begin as one of a .kmall file");
  expect_error(ErrorKind::argument, {"those end with .gsf, .kmall or .xtf"}, [&] { read_swath(path("x.las")); });
  EXPECT_TRUE(is_swath(path("angles.xtf")));
  EXPECT_FALSE(is_swath(INSONIFY_RECORDS "/sidescan_scotsman.xtf"));
}
