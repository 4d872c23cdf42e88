// SPDX-License-Identifier: BSD-3-Clause
#include "formats/gsf_file.hpp"

#include "formats/gsf_decoder.hpp"
#include "formats/gsf_field_rows.hpp"
#include "support/page.hpp"
#include "support/test.hpp"

namespace {

/// Returns a beam to port and one to starboard, each unlike the other in everything, and one without a sounding.
GsfPing two_sided_ping() {
  GsfPing ping;
  ping.time = 1777624200.25, ping.position = {radians(54.1234567), radians(-7.7654321), 3.0625};
  ping.heading = radians(301.25), ping.roll = radians(-2.5), ping.pitch = radians(1.75), ping.course = radians(-10);
  ping.speed = 2, ping.heave = -0.12, ping.head_depth = 1.57, ping.ship_depth = 1.25, ping.tide = -0.34;
  ping.separation = 44.125, ping.number = 70000, ping.period = 0.25, ping.surface_sound_speed = 1487.3, ping.range = 75;
  ping.sample_rate = 37182.5, ping.centre_frequency = 4e5, ping.bandwidth = 6e4, ping.source_level_db = 220.5;
  ping.absorption_db_per_m = 0.0961, ping.beam_width_along = radians(1.5), ping.beam_width_across = radians(0.5);
  ping.beams = {
      {true, 20.1234, -31.0005, 0.5, 0.0493827, radians(57), radians(179), 101.43, 3.26, 0.0123, 0.0321, true},
      {},
      {true, 18.5, 7.25, -0.125, 0.02654321, radians(21.37), radians(-1.5), 133.67, 4.5, 0.002, 0.001, false}};
  return ping;
}

GsfSurvey two_point_survey() {
  GsfSurvey survey;
  survey.profile = {{0, 12.5}, {1490.25, 1481}};
  survey.position = {radians(-33.1234567), radians(-71.5), 0}, survey.time = 1777624200.125;
  survey.comment = "sonar any, simulated by insonify 1";
  survey.history_command = "insonify export", survey.history_comment = "soundings found";
  return survey;
}

std::string gsf_bytes(const std::vector<GsfPing>& pings, const GsfSurvey& survey = two_point_survey()) {
  const std::string path = own_path("swath.gsf");
  GsfFile file(path, survey);
  for (const GsfPing& ping : pings) file.add(ping);
  file.finish();
  return file_bytes(path);
}

decode::GsfContent written(const std::vector<GsfPing>& pings, const GsfSurvey& survey = two_point_survey()) {
  return decode::read_gsf(gsf_bytes(pings, survey));
}

void expect_arrays(const decode::GsfSwath& s) {
  EXPECT_EQ(s.arrays.size(), 11U);
  const auto near = [&](int id, double first, double third, double step, double none = 0) {
    EXPECT_NEAR(s.arrays.at(id)[0], first, step) << id;
    EXPECT_NEAR(s.arrays.at(id)[2], third, step) << id;
    EXPECT_EQ(s.arrays.at(id)[1], none) << id;
  };
  near(1, 20.1234, 18.5, 5.1e-5);
  near(2, -31.0005, 7.25, 5.1e-5);
  near(3, 0.5, -0.125, 5.1e-5);
  near(4, 0.0493827, 0.02654321, 5.1e-9);
  near(5, 57, 21.37, 0.0028);
  near(18, 179, 358.5, 0.0028);  // 0 to 360
  near(6, 101.43, 133.67, 0.0051);
  near(9, 3.26, 4.5, 0.011);
  near(19, 1.96 * 0.0123, 1.96 * 0.002, 5.2e-5);
  near(20, 1.96 * 0.0321, 1.96 * 0.001, 5.2e-5);
  near(23, 1, 0, 0, 132);
  EXPECT_EQ(s.flags, (std::vector<int>{0, 1, 0}));
}

}  // namespace

TEST(GsfFile, holds_what_its_specification_says) {
  const decode::GsfContent read = written({two_sided_ping(), two_sided_ping()});
  EXPECT_EQ(read.version, std::string("GSF-v03.11\0\0", 12));
  EXPECT_EQ(read.records, (std::vector<int>{1, 9, 6, 7, 4, 3, 2, 2, 12}));
  ASSERT_EQ(read.swaths.size(), 2U);  // the second without scale factors of its own
  for (const decode::GsfSwath& s : read.swaths) {
    EXPECT_NEAR(s.time, 1777624200.25, 1e-6);
    EXPECT_NEAR(s.latitude_deg, 54.1234567, 1e-9);
    EXPECT_NEAR(s.longitude_deg, -7.7654321, 1e-9);
    EXPECT_NEAR(s.height, 3.0625, 5.1e-4);
    EXPECT_NEAR(s.separation, 44.125, 1e-9);
    EXPECT_EQ(s.beams, 3);
    EXPECT_EQ(s.centre_beam, 1);
    EXPECT_EQ(s.ping_flags, 0);
    EXPECT_NEAR(s.tide, -0.34, 1e-9);
    EXPECT_NEAR(s.gps_tide, 0, 1e-9);
    EXPECT_NEAR(s.depth_corrector, 1.57, 1e-9);
    EXPECT_NEAR(s.heading_deg, 301.25, 1e-9);
    EXPECT_NEAR(s.roll_deg, -2.5, 1e-9);
    EXPECT_NEAR(s.pitch_deg, 1.75, 1e-9);
    EXPECT_NEAR(s.course_deg, 350, 1e-9);
    EXPECT_NEAR(s.speed_knots, 2 / 0.514444, 0.006);
    EXPECT_NEAR(s.heave, -0.12, 1e-9);
    expect_arrays(s);
  }
}

TEST(GsfFile, another_profile_holds_for_the_pings_behind_it) {
  const std::string path = own_path("casts.gsf");
  GsfFile file(path, two_point_survey());
  file.add(two_sided_ping());
  file.add_profile({{0, 5, 12000}, {1500, 1499.5, 1499.25}}, {radians(-33.0), radians(-71.0), 0}, 1777624201.5);
  file.add(two_sided_ping());
  file.finish();
  const decode::GsfContent read = decode::read_gsf(file_bytes(path));
  ASSERT_EQ(read.swaths.size(), 2U);
  EXPECT_EQ(read.swaths[0].profile.size(), 2U);
  EXPECT_EQ(read.swaths[1].profile, (std::vector<std::pair<double, double>>{{0, 1500}, {5, 1499.5}, {12000, 1499.25}}));
  EXPECT_NEAR(read.profile_time, 1777624201.5, 1e-6);
  EXPECT_NEAR(read.profile_latitude_deg, -33, 1e-9);
}

// A rejected sounding has its numbers and the flag of one that a filter edited.
TEST(GsfFile, flags_rejected_soundings) {
  GsfPing ping = two_sided_ping();
  ping.beams[0].rejected = true;
  const decode::GsfSwath s = written({ping}).swaths.at(0);
  EXPECT_EQ(s.flags, (std::vector<int>{9, 1, 0}));
  EXPECT_NEAR(s.arrays.at(1)[0], 20.1234, 5.1e-5);
}

TEST(GsfFile, names_profile_comment_and_history) {
  const decode::GsfContent read = written({two_sided_ping()});
  ASSERT_EQ(read.profile.size(), 2U);
  EXPECT_NEAR(read.profile[1].first, 12.5, 1e-9);
  EXPECT_NEAR(read.profile[0].second, 1490.25, 1e-9);
  EXPECT_NEAR(read.profile_time, 1777624200.125, 1e-6);
  EXPECT_NEAR(read.profile_latitude_deg, -33.1234567, 1e-9);
  EXPECT_NEAR(read.profile_longitude_deg, -71.5, 1e-9);
  EXPECT_EQ(read.comments, std::vector<std::string>{"sonar any, simulated by insonify 1"});
  ASSERT_EQ(read.histories.size(), 1U);
  EXPECT_EQ(read.histories[0].machine + read.histories[0].operator_name, "");
  EXPECT_EQ(read.histories[0].command, "insonify export");
  EXPECT_EQ(read.histories[0].comment, "soundings found");
}

// gsfGetMBParams reads words, and numbers as +DD.DD.
TEST(GsfFile, has_the_parameters_of_processing) {
  GsfSurvey survey = two_point_survey();
  const auto unknown = written({two_sided_ping()}, survey).parameter;
  EXPECT_EQ(unknown.at("APPLIED_TRANSDUCER_OFFSET"), "UNKNWN,UNKNWN,UNKNWN");
  EXPECT_EQ(unknown.at("APPLIED_TRANSDUCER_PITCH_OFFSET"), "UNKNWN");
  EXPECT_EQ(unknown.at("TIDE_COMPENSATED"), "NO");
  EXPECT_EQ(unknown.at("TIDAL_DATUM"), "UNKNOWN");
  EXPECT_EQ(unknown.at("PLATFORM_TYPE"), "SURFACE_SHIP");
  survey.processing = {2.345, true, true, "MSL", GsfMounting{{0.5, -0.25, 12}, radians(-4), radians(3), radians(-0.5)}};
  const auto all = written({two_sided_ping()}, survey).parameter;
  const std::map<std::string, std::string> expected = {{"REFERENCE TIME", "1970/001 00:00:00"},
                                                       {"PLATFORM_TYPE", "AUV"},
                                                       {"ROLL_COMPENSATED", "YES"},
                                                       {"PITCH_COMPENSATED", "YES"},
                                                       {"HEAVE_COMPENSATED", "YES"},
                                                       {"TIDE_COMPENSATED", "YES"},
                                                       {"DEPTH_CALCULATION", "CORRECTED"},
                                                       {"RAY_TRACING", "YES"},
                                                       {"ROLL_REFERENCE", "ROTATED_PITCH_AXIS"},
                                                       {"DRAFT_TO_APPLY", "+00.00"},
                                                       {"TRANSDUCER_OFFSET_TO_APPLY", "+00.00,+00.00,+00.00"},
                                                       {"APPLIED_DRAFT", "+02.35"},
                                                       {"APPLIED_TRANSDUCER_OFFSET", "+00.50,-00.25,+12.00"},
                                                       {"APPLIED_TRANSDUCER_PITCH_OFFSET", "+03.00"},
                                                       {"APPLIED_TRANSDUCER_ROLL_OFFSET", "-00.50"},
                                                       {"APPLIED_TRANSDUCER_HEADING_OFFSET", "-04.00"},
                                                       {"GEOID", "WGS-84"},
                                                       {"TIDAL_DATUM", "MSL"}};
  for (const auto& [key, value] : expected) EXPECT_EQ(all.at(key), value) << key;
}

TEST(GsfFile, has_azimuths_of_a_whole_turn) {
  GsfPing ping = two_sided_ping();
  ping.beams.assign(3, ping.beams[0]);
  ping.beams[0].azimuth = radians(-90), ping.beams[1].azimuth = radians(359.9999), ping.beams[2].azimuth = -1e-9;
  const std::vector<double> azimuth = written({ping}).swaths.at(0).arrays.at(18);
  EXPECT_NEAR(azimuth[0], 270, 1e-9);
  EXPECT_EQ(azimuth[1], 0);
  EXPECT_EQ(azimuth[2], 0);
}

TEST(GsfFile, has_the_subrecord_of_its_sonar) {
  EXPECT_EQ(gsf_sensor_of("em2040"), GsfSensor::em2040);
  EXPECT_EQ(gsf_sensor_of("r2sonic-2024"), GsfSensor::r2sonic_2024);
  EXPECT_EQ(gsf_sensor_of("seabat-t50"), GsfSensor::seabat_ii);
  const auto fields_of = [](GsfSensor sensor) {
    GsfSurvey survey = two_point_survey();
    survey.sensor = sensor;
    const decode::GsfSwath s = written({two_sided_ping()}, survey).swaths.at(0);
    EXPECT_EQ(s.sensor, static_cast<int>(sensor));
    if (sensor == GsfSensor::r2sonic_2024) {
      EXPECT_EQ(s.sensor_model, std::string("2024\0\0\0\0\0\0\0\0", 12));
    }
    return s.of_sensor;
  };
  const auto expect = [](const std::map<std::string, double>& read, const std::map<std::string, double>& expected) {
    EXPECT_EQ(read.size(), expected.size());
    for (const auto& [name, value] : expected) EXPECT_NEAR(read.at(name), value, 1e-6 * (1 + value)) << name;
  };
  expect(fields_of(GsfSensor::seabat_ii), {{"ping_number", 70000 - 65536},
                                           {"surface_velocity", 1487.3},
                                           {"range", 75},
                                           {"fore_aft_deg", 1.5},
                                           {"athwart_deg", 0.5}});
  expect(fields_of(GsfSensor::em2040), {{"model_number", 2040},
                                        {"ping_counter", 70000 - 65536},
                                        {"surface_velocity", 1487.3},
                                        {"transducer_depth", 1.57},
                                        {"valid_detections", 2},
                                        {"sampling_frequency", 37182},
                                        {"sampling_fraction", 0.5},
                                        {"vehicle_depth", 1.25},
                                        {"transmit_sectors", 1},
                                        {"sector_frequency", 4e5},
                                        {"sector_absorption", 96.1},
                                        {"sector_bandwidth", 6e4},
                                        {"run_time_model", 2040},
                                        {"run_time_seconds", 1777624200},
                                        {"run_time_nanoseconds", 0.25},
                                        {"run_time_ping_counter", 70000 - 65536},
                                        {"run_time_absorption", 96.1},
                                        {"transmit_beam_width_deg", 1.5},
                                        {"receive_beam_width_deg", 0.5}});
  expect(fields_of(GsfSensor::r2sonic_2024), {{"seconds", 1777624200},
                                              {"nanoseconds", 0.25},
                                              {"ping_number", 70000},
                                              {"ping_period", 0.25},
                                              {"sound_speed", 1487.3},
                                              {"frequency", 4e5},
                                              {"tx_power", 220.5},
                                              {"fore_aft_deg", 1.5},
                                              {"athwart_deg", 0.5},
                                              {"rx_bandwidth", 6e4},
                                              {"rx_sample_rate", 37182.5},
                                              {"rx_range", 0.10085},
                                              {"rx_absorption", 96.1},
                                              {"num_beams", 3}});
}

// A record of attitudes has a minute at most, and begins anew where time goes back.
TEST(GsfFile, sums_up_attitudes_and_extent) {
  std::vector<GsfPing> pings(5, two_sided_ping());
  for (std::size_t p = 0; p < 5; ++p) {
    pings[p].time = std::vector<double>{1000.25, 1059.5, 1060.25, 1061, 1010}[p];
    pings[p].heading = radians(10.0 * static_cast<double>(p));
    pings[p].position.latitude = radians(-1.0 - static_cast<double>(p));
    pings[p].position.longitude = radians(-70.0 + static_cast<double>(p));
  }
  pings[3].beams[0].depth = -1.5;
  const decode::GsfContent read = written(pings);
  ASSERT_EQ(read.attitudes.size(), 3U);
  EXPECT_EQ(read.attitudes[0].size(), 2U);
  EXPECT_EQ(read.attitudes[1].size(), 2U);
  const decode::GsfAttitudeEntry& e = read.attitudes[1].at(1);
  EXPECT_NEAR(e.time, 1061, 1e-6);
  EXPECT_NEAR(e.pitch_deg, 1.75, 1e-9);
  EXPECT_NEAR(e.roll_deg, -2.5, 1e-9);
  EXPECT_NEAR(e.heave, -0.12, 1e-9);
  EXPECT_NEAR(e.heading_deg, 30, 1e-9);
  EXPECT_NEAR(read.attitudes[2].at(0).time, 1010, 1e-6);
  ASSERT_TRUE(read.summary.has_value());
  EXPECT_NEAR(read.summary->begin, 1000.25, 1e-6);
  EXPECT_NEAR(read.summary->end, 1061, 1e-6);
  EXPECT_NEAR(read.summary->south_deg, -5, 1e-9);
  EXPECT_NEAR(read.summary->north_deg, -1, 1e-9);
  EXPECT_NEAR(read.summary->west_deg, -70, 1e-9);
  EXPECT_NEAR(read.summary->east_deg, -66, 1e-9);
  EXPECT_NEAR(read.summary->least_depth, -1.5, 1e-9);
  EXPECT_NEAR(read.summary->greatest_depth, 20.12, 1e-9);
}

TEST(GsfFile, says_the_errors_of_its_positions_if_they_are_known) {
  GsfSurvey survey = two_point_survey();
  EXPECT_TRUE(written({two_sided_ping()}, survey).position_errors.empty());
  survey.position_deviation = 0.5;
  const auto errors = written({two_sided_ping()}, survey).position_errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].record, 2);
  EXPECT_NEAR(errors[0].horizontal, 0.707, 1e-9);  // of both coordinates
  EXPECT_NEAR(errors[0].vertical, 0.5, 1e-9);
  EXPECT_EQ(errors[0].type, "UNKN");
}

// Two bytes of centimetres hold a water level up to 327 m.
TEST(GsfFile, holds_the_water_level_of_a_mountain_lake) {
  GsfPing ping = two_sided_ping();
  ping.tide = -395.25;
  const decode::GsfSwath s = written({ping}).swaths.at(0);
  EXPECT_EQ(s.tide, 0);
  EXPECT_NEAR(s.gps_tide, -395.25, 1e-9);
}

// Heights above z = 0 are negative depths, which an unsigned field holds by its offset.
TEST(GsfFile, holds_heights_and_as_many_soundings_as_a_record_has_room_for) {
  GsfPing ping = two_sided_ping();
  ping.beams[0].depth = -12.3456;
  const decode::GsfSwath s = decode::read_gsf(gsf_bytes({ping})).swaths.at(0);
  EXPECT_NEAR(s.arrays.at(1)[0], -12.3456, 5.1e-5);
  EXPECT_EQ(s.arrays.at(1)[1], 0);
  EXPECT_NEAR(s.arrays.at(1)[2], 18.5, 5.1e-5);
  ping.beams.resize(18000, ping.beams[2]);
  const std::string bytes = gsf_bytes({ping});
  EXPECT_LT(bytes.size(), 524288U);
  EXPECT_EQ(decode::read_gsf(bytes).swaths.at(0).arrays.at(2).size(), 18000U);
}

// The first records, byte by byte: sizes and ids big-endian, sizes without the eight bytes of the head.
TEST(GsfFile, begins_with_the_bytes_of_the_specification) {
  const std::string bytes = gsf_bytes({});
  const std::string header("\0\0\0\x0c\0\0\0\x01GSF-v03.11\0\0", 20);
  EXPECT_EQ(bytes.substr(0, 20), header);
  const std::string summary("\0\0\0\x28\0\0\0\x09", 8);
  EXPECT_EQ(bytes.substr(20, 8), summary);
  EXPECT_EQ(bytes.substr(28, 40), std::string(40, '\0'));  // without pings
  const std::string comment("\0\0\0\x30\0\0\0\x06\x69\xf4\x64\x88\x07\x73\x59\x40\0\0\0\x23sonar any", 29);
  EXPECT_EQ(bytes.substr(68, 29), comment);
}

TEST(GsfFile, cut_off_anywhere_within_a_record_it_is_refused_by_the_decoder) {
  const std::string bytes = gsf_bytes({two_sided_ping()});
  std::set<std::size_t> between;  // records: each says its size
  for (std::size_t at = 0; at < bytes.size();) {
    decode::Cursor size(bytes, at);
    between.insert(at += 8 + static_cast<std::size_t>(size.unsigned_big(4)));
  }
  EXPECT_EQ(*between.rbegin(), bytes.size());
  for (std::size_t size = 21; size < bytes.size(); ++size) {
    if (between.contains(size)) continue;
    EXPECT_THROW(decode::read_gsf(bytes.substr(0, size)), std::runtime_error) << size;
  }
}

TEST(GsfFile, refuses_what_its_fields_cannot_hold) {
  const auto refusal = [](const std::function<void(GsfPing&)>& spoil) {
    GsfPing ping = two_sided_ping();
    spoil(ping);
    return error_of([&] { gsf_bytes({ping}); }, ErrorKind::content);
  };
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams.clear(); }), HasSubstr("ping 70000 has 0 soundings"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams[0].depth = -10001; }), HasSubstr("DEPTH of ping 70000 is -10000"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams.resize(18001); }), HasSubstr("ping 70000 has 18001 soundings"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams[0].across = std::nan(""); }), HasSubstr("ACROSS_TRACK of ping 70000"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.time = -1; }), HasSubstr("must be within 1970 and 2106"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.speed = 400; }), HasSubstr("SPEED of ping 70000"));
  GsfSurvey survey = two_point_survey();
  survey.time = -1;
  EXPECT_THAT(error_of([&] { gsf_bytes({}, survey); }, ErrorKind::content), HasSubstr("give --start-utc"));
  EXPECT_FALSE(file_exists(own_path("swath.gsf")));
}

TEST(GsfFile, fields_are_those_of_the_page_of_fields) {
  std::string page =
      "# Fields of GSF files\n\n[gsf.md](../gsf.md) explains records, axes and signs. A value is the stored number "
      "times the step.\n\n| record | field | type | step | meaning |\n|---|---|---|---|---|\n";
  for (const GsfFieldRow& f : gsf_field_rows())
    page += "|" + table_cell(f.record) + table_cell("`" + f.name + "`") + table_cell(f.type) + table_cell(f.step) +
            table_cell(f.meaning) + "\n";
  expect_reference_page("gsf.md", page);
}
