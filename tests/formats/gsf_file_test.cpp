#include "formats/gsf_file.hpp"

#include "formats/gsf_decoder.hpp"
#include "support/test.hpp"

namespace {

/// A beam to port and one to starboard, each unlike the other in everything, and one without a sounding.
GsfPing two_sided_ping() {
  GsfPing ping;
  ping.time = 1777624200.25, ping.place = {radians(54.1234567), radians(-7.7654321), 3};
  ping.heading = radians(301.25), ping.roll = radians(-2.5), ping.pitch = radians(1.75), ping.course = radians(-10);
  ping.speed = 2, ping.heave = -0.12, ping.number = 41, ping.surface_sound_speed = 1487.3, ping.range = 75;
  ping.beam_width_along = radians(1.5), ping.beam_width_across = radians(0.5);
  ping.beams = {{true, 20.1234, -31.0005, 0.5, 0.0493827, radians(57), radians(179), 101.4, 3.26, 0.0123, 0.0321},
                {},
                {true, 18.5, 7.25, -0.125, 0.02654321, radians(21.37), radians(-1.5), 133.6, 4.5, 0.002, 0.001}};
  return ping;
}

std::string gsf_bytes(const std::vector<GsfPing>& pings) {
  const std::string path = own_path("swath.gsf");
  GsfFile file(path, {{0, 12.5}, {1490.25, 1481}}, {0.9, 0.1, 0}, 1777624200,
               {"REFERENCE TIME=1970/001 00:00:00", "A=B"});
  for (const GsfPing& ping : pings) file.add(ping);
  file.finish();
  return file_bytes(path);
}

}  // namespace

TEST(GsfFile, holds_what_its_specification_says) {
  const decode::GsfContent read = decode::read_gsf(gsf_bytes({two_sided_ping(), two_sided_ping()}));
  EXPECT_EQ(read.version, std::string("GSF-v03.11\0\0", 12));
  EXPECT_EQ(read.parameters,
            (std::vector<std::string>{std::string("REFERENCE TIME=1970/001 00:00:00\0", 33), std::string("A=B\0", 4)}));
  ASSERT_EQ(read.profile.size(), 2U);
  EXPECT_NEAR(read.profile[1].first, 12.5, 1e-9);
  EXPECT_NEAR(read.profile[0].second, 1490.25, 1e-9);
  ASSERT_EQ(read.swaths.size(), 2U);  // the second without scale factors of its own
  for (const decode::GsfSwath& s : read.swaths) {
    EXPECT_NEAR(s.time, 1777624200.25, 1e-6);
    EXPECT_NEAR(s.latitude_deg, 54.1234567, 1e-9);
    EXPECT_NEAR(s.longitude_deg, -7.7654321, 1e-9);
    EXPECT_NEAR(s.heading_deg, 301.25, 1e-9);
    EXPECT_NEAR(s.roll_deg, -2.5, 1e-9);
    EXPECT_NEAR(s.pitch_deg, 1.75, 1e-9);
    EXPECT_NEAR(s.course_deg, 350, 1e-9);
    EXPECT_NEAR(s.speed_knots, 2 / 0.514444, 0.006);
    EXPECT_NEAR(s.heave, -0.12, 1e-9);
    EXPECT_EQ(s.ping_number, 41);
    EXPECT_EQ(s.sonar_range, 75);
    EXPECT_NEAR(s.surface_speed, 1487.3, 1e-9);
    EXPECT_NEAR(s.fore_aft_deg, 1.5, 1e-9);
    EXPECT_NEAR(s.athwart_deg, 0.5, 1e-9);
    EXPECT_EQ(s.flags, (std::vector<int>{0, 1, 0}));
    const auto near = [&](int id, double first, double third, double step) {
      EXPECT_NEAR(s.arrays.at(id)[0], first, step) << id;
      EXPECT_NEAR(s.arrays.at(id)[2], third, step) << id;
      EXPECT_EQ(s.arrays.at(id)[1], 0) << id;
    };
    near(1, 20.1234, 18.5, 5.1e-5);
    near(2, -31.0005, 7.25, 5.1e-5);
    near(3, 0.5, -0.125, 5.1e-5);
    near(4, 0.0493827, 0.02654321, 5.1e-9);
    near(5, 57, 21.37, 0.0051);
    near(18, 179, -1.5, 0.0051);
    near(7, 101.4, 133.6, 0.51);
    near(9, 3.26, 4.5, 0.011);
    near(19, 1.96 * 0.0123, 1.96 * 0.002, 5.2e-5);
    near(20, 1.96 * 0.0321, 1.96 * 0.001, 5.2e-5);
  }
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
  const std::string parameters("\0\0\0\x34\0\0\0\x04\x69\xf4\x64\x88\0\0\0\0\0\x02\0\x21REFERENCE TIME", 34);
  EXPECT_EQ(bytes.substr(20, 34), parameters);
}

TEST(GsfFile, cut_off_anywhere_within_a_record_it_is_refused_by_the_decoder) {
  const std::string bytes = gsf_bytes({two_sided_ping()});
  for (std::size_t size = 21; size < bytes.size(); ++size) {
    if (size == 20 + 8 + 0x34 || size == 20 + 8 + 0x34 + 8 + 44) continue;  // between records
    EXPECT_THROW(decode::read_gsf(bytes.substr(0, size)), std::runtime_error) << size;
  }
}

TEST(GsfFile, refuses_what_its_fields_cannot_hold) {
  const auto refusal = [](const std::function<void(GsfPing&)>& spoil) {
    GsfPing ping = two_sided_ping();
    spoil(ping);
    return error_of([&] { gsf_bytes({ping}); }, ErrorKind::content);
  };
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams.clear(); }), HasSubstr("ping 41 has 0 soundings"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams[0].depth = -10001; }),
              HasSubstr("depth below z = 0 of ping 41 is -10000"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams.resize(18001); }), HasSubstr("ping 41 has 18001 soundings"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.beams[0].across = std::nan(""); }), HasSubstr("across of ping 41"));
  EXPECT_THAT(refusal([](GsfPing& p) { p.time = -1; }), HasSubstr("must be within 1970 and 2106"));
  EXPECT_FALSE(file_exists(own_path("swath.gsf")));
}
