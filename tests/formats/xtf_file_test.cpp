// SPDX-License-Identifier: BSD-3-Clause
// Side-scans as XTF: what is written is read by a decoder made from the specification, and by the reader, which also
// reads bytes put together here and a public record.
#include "formats/xtf_file.hpp"

#include "formats/put_bytes.hpp"
#include "formats/xtf_decoder.hpp"
#include "support/test.hpp"

namespace {

constexpr double speed_1487 = 1487.3;

XtfHeader two_sided_header(XtfSamples samples) {
  XtfHeader header;
  header.program = "insonify", header.version = "223", header.sonar = "klein-3000", header.note = "a note";
  header.channels = {{XtfSide::port, samples, "port", 5e5, radians(0.21), radians(40), radians(15)},
                     {XtfSide::starboard, samples, "starboard", 5e5, radians(0.21), radians(40), radians(15)}};
  header.notes = {"amplitude = value / 65535"};
  return header;
}

/// Returns a ping whose samples of channel c are 100 c + n, and a half more in odd pings.
XtfPing two_sided_ping(std::uint32_t number, std::size_t samples = 5) {
  XtfPing p;
  p.number = number, p.time = 1777624200.25 + 0.13 * number, p.sound_speed = speed_1487, p.period = 0.13;
  p.ship = {-68.828123456789, 48.445123456789}, p.sensor = {-68.828223456789, 48.445223456789};
  p.ship_heading = radians(70), p.heading = radians(71.5), p.pitch = radians(-2.25), p.roll = radians(3.5);
  p.yaw = radians(-4), p.speed = 2, p.depth = 12.5, p.altitude = 6.25;
  for (std::size_t c = 0; c < 2; ++c) {
    XtfTrace trace{c, 0.01, 30, 5e5, true, {}};
    for (std::size_t n = 0; n < samples; ++n)
      trace.samples.push_back(static_cast<float>(100 * c + n) + 0.25F * static_cast<float>(number % 2));
    p.traces.push_back(trace);
  }
  return p;
}

std::string written_xtf(const std::vector<XtfPing>& pings, XtfSamples samples = XtfSamples::integer_16) {
  XtfFile file(own_path("line.xtf"), two_sided_header(samples));
  for (const XtfPing& ping : pings) file.add(ping);
  file.finish();
  return own_path("line.xtf");
}

std::string xtf_refusal(const std::string& bytes) {
  return error_of_file([](const std::string& path) { read_xtf(path); }, "r.xtf", bytes);
}

/// Returns a recording of another program with one starboard channel: one ping of `samples`.
std::string foreign_recording(int format, int bytes_each, const std::string& samples) {
  std::string file(1024, '\0');
  file[0] = 123;
  put_at(file, 166, std::uint16_t{1});
  file[256] = 2;
  put_at(file, 256 + 6, static_cast<std::uint16_t>(bytes_each));
  file[256 + 74] = static_cast<char>(format);
  std::string packet(256 + 64, '\0');
  put_at(packet, 0, std::uint16_t{0xFACE});
  put_at(packet, 4, std::uint16_t{1});
  put_at(packet, 10, static_cast<std::uint32_t>(packet.size() + samples.size()));
  put_at(packet, 32, 750.0F);
  put_at(packet, 256 + 4, 75.0F);
  put_at(packet, 256 + 26, std::uint16_t{455});
  put_at(packet, 256 + 42, static_cast<std::uint32_t>(samples.size() / static_cast<std::size_t>(bytes_each)));
  return file + packet + samples;
}

std::vector<float> foreign_samples(int format, int bytes_each, const std::string& samples, int weight = 0) {
  std::string file = foreign_recording(format, bytes_each, samples);
  put_at(file, 1024 + 256 + 58, static_cast<std::int16_t>(weight));
  return read_xtf(own_file("foreign.xtf", file)).pings.at(0).traces.at(0).samples;
}

}  // namespace

TEST(XtfFile, holds_what_the_specification_says) {
  const decode::XtfContent read =
      decode::read_xtf_file(file_bytes(written_xtf({two_sided_ping(6), two_sided_ping(7)})));
  EXPECT_EQ(read.program, "insonify");
  EXPECT_EQ(read.version, "223");
  EXPECT_EQ(read.sonar, "klein-3000");
  EXPECT_EQ(read.note, "a note");
  EXPECT_EQ(read.file_name, "line.xtf");
  EXPECT_EQ(read.nav_units, 3);
  EXPECT_EQ(read.notes, std::vector<std::string>{"amplitude = value / 65535"});
  ASSERT_EQ(read.channels.size(), 2U);
  const decode::XtfChannelInfo& c = read.channels[1];
  EXPECT_EQ(read.channels[0].type, 1);
  EXPECT_EQ(c.type, 2);
  EXPECT_EQ(c.sub_channel, 1);
  EXPECT_EQ(c.correction, 1);
  EXPECT_EQ(c.unipolar, 1);
  EXPECT_EQ(c.bytes, 2);
  EXPECT_EQ(c.format, 3);
  EXPECT_EQ(c.old_samples, 1024U);
  EXPECT_EQ(c.name, "starboard");
  EXPECT_EQ(c.frequency, 500);  // kHz
  EXPECT_NEAR(c.beam_angle, 0.21, 1e-6);
  EXPECT_NEAR(c.beam_width, 40, 1e-5);
  EXPECT_NEAR(c.tilt, 15, 1e-5);

  ASSERT_EQ(read.pings.size(), 2U);
  const decode::XtfSonarPacket& p = read.pings[1];
  EXPECT_EQ(p.bytes, 448U);  // 256 + 2 (64 + 10), in steps of 64
  EXPECT_EQ(p.number, 7U);
  EXPECT_EQ(p.year, 2026);
  EXPECT_EQ(p.month, 5);
  EXPECT_EQ(p.day, 1);
  EXPECT_EQ(p.day_of_year, 121);
  const std::array<int, 4> clock{8, 30, 1, 16};  // 0.25 s and seven times 0.13 s later
  EXPECT_EQ((std::array{p.hour, p.minute, p.second, p.hundredth}), clock);
  EXPECT_EQ(p.fix, clock);
  EXPECT_EQ(p.clock, clock);
  EXPECT_EQ(p.fix_milliseconds, 30601160U);
  EXPECT_EQ(p.attitude_tag, 30601160U);
  EXPECT_NEAR(p.sound_speed, speed_1487 / 2, 1e-4);
  EXPECT_NEAR(p.computed_speed, speed_1487, 1e-4);
  EXPECT_NEAR(p.ship_y, 48.445123456789, 1e-12);
  EXPECT_NEAR(p.ship_x, -68.828123456789, 1e-12);
  EXPECT_NEAR(p.sensor_y, 48.445223456789, 1e-12);
  EXPECT_NEAR(p.sensor_x, -68.828223456789, 1e-12);
  EXPECT_NEAR(p.ship_gyro, 70, 1e-5);
  EXPECT_NEAR(p.heading, 71.5, 1e-5);
  EXPECT_NEAR(p.pitch, -2.25, 1e-6);
  EXPECT_NEAR(p.roll, 3.5, 1e-6);
  EXPECT_NEAR(p.yaw, -4, 1e-6);
  EXPECT_NEAR(p.ship_speed, 3.88769, 1e-4);  // knots
  EXPECT_NEAR(p.sensor_speed, 3.88769, 1e-4);
  EXPECT_EQ(p.depth, 12.5);
  EXPECT_EQ(p.altitude, 6.25);
}

TEST(XtfFile, has_the_samples_of_port_from_afar) {
  const decode::XtfContent read = decode::read_xtf_file(file_bytes(written_xtf({two_sided_ping(0)})));
  const auto& channels = read.pings.at(0).channels;
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0].samples, (std::vector<double>{4, 3, 2, 1, 0}));
  EXPECT_EQ(channels[1].samples, (std::vector<double>{100, 101, 102, 103, 104}));
  const decode::XtfChannelOfPing& t = channels[1];
  EXPECT_EQ(t.channel, 1);
  EXPECT_EQ(t.slant_range, 30);
  EXPECT_NEAR(t.ground_range, std::sqrt(900 - 6.25 * 6.25), 1e-5);
  EXPECT_NEAR(t.delay, 0.02 / speed_1487, 1e-9);
  EXPECT_NEAR(t.duration, 59.98 / speed_1487, 1e-7);
  EXPECT_NEAR(t.period, 0.13, 1e-7);
  EXPECT_EQ(t.flags, 4);  // time-varied gain
  EXPECT_EQ(t.frequency, 500);
  EXPECT_EQ(t.weight, 0);
}

TEST(XtfFile, is_read_as_it_was_written) {
  for (const XtfSamples samples : {XtfSamples::integer_16, XtfSamples::ieee_float}) {
    const std::vector<XtfPing> pings{two_sided_ping(3, 33), two_sided_ping(4, 33)};
    const XtfRecord read = read_xtf(written_xtf(pings, samples));
    EXPECT_EQ(read.other_packets, 0U);
    EXPECT_TRUE(read.header.in_degrees);
    EXPECT_EQ(read.header.notes, two_sided_header(samples).notes);
    ASSERT_EQ(read.header.channels.size(), 2U);
    EXPECT_EQ(read.header.channels[0].side, XtfSide::port);
    EXPECT_EQ(read.header.channels[0].samples, samples);
    EXPECT_NEAR(read.header.channels[0].frequency, 5e5, 1e-3);
    EXPECT_NEAR(read.header.channels[1].depression, radians(15), 1e-7);
    ASSERT_EQ(read.pings.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      const XtfPing &p = read.pings[k], &due = pings[k];
      EXPECT_EQ(p.number, due.number);
      EXPECT_NEAR(p.time, due.time, 0.005 + 1e-6);
      EXPECT_NEAR(p.sound_speed, due.sound_speed, 2e-4);
      EXPECT_LT((p.ship - due.ship).norm(), 1e-9);
      EXPECT_LT((p.sensor - due.sensor).norm(), 1e-9);
      EXPECT_NEAR(p.heading, due.heading, 1e-6);
      EXPECT_NEAR(p.ship_heading, due.ship_heading, 1e-6);
      EXPECT_NEAR(p.pitch, due.pitch, 1e-7);
      EXPECT_NEAR(p.roll, due.roll, 1e-7);
      EXPECT_NEAR(p.yaw, due.yaw, 1e-7);
      EXPECT_NEAR(p.speed, due.speed, 1e-6);
      EXPECT_EQ(p.depth, due.depth);
      EXPECT_EQ(p.altitude, due.altitude);
      ASSERT_EQ(p.traces.size(), 2U);
      for (std::size_t c = 0; c < 2; ++c) {
        const XtfTrace &t = p.traces[c], &sent = due.traces[c];
        EXPECT_EQ(t.channel, c);
        EXPECT_NEAR(t.begin, sent.begin, 1e-6);
        EXPECT_NEAR(t.end, sent.end, 1e-6);
        EXPECT_TRUE(t.with_gain);
        ASSERT_EQ(t.samples.size(), sent.samples.size());
        for (std::size_t n = 0; n < t.samples.size(); ++n)
          EXPECT_NEAR(t.samples[n], sent.samples[n], samples == XtfSamples::integer_16 ? 0.5 : 0) << c << " " << n;
      }
    }
  }
}

TEST(XtfFile, reads_samples_of_all_formats) {
  const std::string bytes{"\x01\xff\x80\x02", 4};
  EXPECT_EQ(foreign_samples(8, 1, bytes), (std::vector<float>{1, 255, 128, 2}));
  EXPECT_EQ(foreign_samples(0, 1, bytes), (std::vector<float>{1, 255, 128, 2}));
  EXPECT_EQ(foreign_samples(3, 2, bytes), (std::vector<float>{65281, 640}));
  EXPECT_EQ(foreign_samples(0, 2, bytes), (std::vector<float>{65281, 640}));
  EXPECT_EQ(foreign_samples(2, 4, std::string{"\x01\x00\x00\x80", 4}), (std::vector<float>{2147483648.0F}));
  EXPECT_EQ(foreign_samples(0, 4, std::string{"\x05\x00\x01\x00", 4}), (std::vector<float>{65541}));
  EXPECT_EQ(foreign_samples(5, 4, std::string{"\x00\x00\x20\x41", 4}), (std::vector<float>{10}));
  // -118.625 is C276A000 of IBM's, the example of its manuals; 1 is 41100000.
  EXPECT_EQ(foreign_samples(1, 4, std::string{"\x00\xA0\x76\xC2\x00\x00\x10\x41", 8}),
            (std::vector<float>{-118.625F, 1}));
  EXPECT_EQ(foreign_samples(3, 2, bytes, 3), (std::vector<float>{65281 / 8.0F, 80}));  // over 2 to the weight
}

TEST(XtfFile, reads_recordings_of_other_programs) {
  const std::string whole = foreign_recording(3, 2, std::string(8, '\x10'));
  const XtfPing p = read_xtf(own_file("w.xtf", whole)).pings.at(0);
  EXPECT_EQ(p.sound_speed, 1500);  // half of it is stored
  EXPECT_EQ(p.time, 0);            // no date
  EXPECT_EQ(p.traces[0].end, 75);
  EXPECT_EQ(p.traces[0].frequency, 455e3);  // of the ping, where the channel has none
  std::string metres = whole;
  EXPECT_FALSE(read_xtf(own_file("m.xtf", metres)).header.in_degrees);
  put_at(metres, 164, std::uint16_t{3});
  EXPECT_TRUE(read_xtf(own_file("m.xtf", metres)).header.in_degrees);

  // Packets of other kinds are passed over; seven channels more need a second kilobyte.
  std::string other(64, '\0');
  put_at(other, 0, std::uint16_t{0xFACE});
  other[2] = 3;
  put_at(other, 10, std::uint32_t{64});
  EXPECT_EQ(read_xtf(own_file("o.xtf", whole + other)).other_packets, 1U);
  std::string grown = whole;
  put_at(grown, 168, std::uint16_t{6});
  grown.insert(1024, 1024, '\0');
  EXPECT_EQ(read_xtf(own_file("g.xtf", grown)).pings.size(), 1U);
}

TEST(XtfFile, refuses_what_is_damaged) {
  const std::string whole = foreign_recording(3, 2, std::string(8, '\x10'));
  const auto spoilt = [&](std::size_t at, auto number) {
    std::string bytes = whole;
    put_at(bytes, at, number);
    return xtf_refusal(bytes);
  };
  EXPECT_THAT(spoilt(0, 'x'), HasSubstr("content: r.xtf: does not begin with 123, so it is no XTF recording"));
  EXPECT_THAT(spoilt(166, std::uint16_t{0}), HasSubstr("has no channel of a side-scan"));
  EXPECT_THAT(spoilt(256, std::uint8_t{9}), HasSubstr("channel 0 is of type 9, must be 0 (sub-bottom), 1 (port) or 2"));
  EXPECT_THAT(spoilt(256 + 6, std::uint16_t{3}), HasSubstr("samples of channel 0 are of format 3 and 3 bytes"));
  EXPECT_THAT(spoilt(1024, std::uint16_t{1}), HasSubstr("packet 0 at byte 1024 does not begin with 0xFACE"));
  EXPECT_THAT(spoilt(1034, std::uint32_t{13}), HasSubstr("packet 0 at byte 1024 has 13 bytes, must have at least 14"));
  EXPECT_THAT(spoilt(1034, std::uint32_t{99999}), HasSubstr("ends within packet 0: has 1352 bytes, must have 101023"));
  EXPECT_THAT(spoilt(1034, std::uint32_t{200}), HasSubstr("packet 0 at byte 1024 ends within its header"));
  EXPECT_THAT(spoilt(1028, std::uint16_t{2}), HasSubstr("ends within the header of channel 1"));
  EXPECT_THAT(spoilt(1024 + 256 + 42, std::uint32_t{5}),
              HasSubstr("has 5 samples of channel 0, must have at least 1 and at most 4, as many as its packet holds"));
  EXPECT_THAT(spoilt(1024 + 256 + 4, -1.0F), HasSubstr("reaches from 0 to -1 m, must reach farther"));
  EXPECT_THAT(spoilt(1024 + 14, std::uint16_t{2026}), HasSubstr("has the date 2026-0-0 0:0:0.0, which is none"));
  EXPECT_THAT(xtf_refusal(whole.substr(0, 1024)), HasSubstr("has no ping of a side-scan"));
  std::string nan = foreign_recording(5, 4, std::string{"\x00\x00\xc0\x7f", 4});
  EXPECT_THAT(xtf_refusal(nan), HasSubstr("sample 0 is not a finite number"));
  EXPECT_THAT(error_with_kind([] { read_xtf("none.xtf"); }), HasSubstr("file: none.xtf"));
}

// A file that ends between two packets is whole; at any other byte reader and decoder say that it is cut off.
TEST(XtfFile, cut_off_anywhere_within_a_packet_it_is_refused) {
  const std::string bytes = file_bytes(written_xtf({two_sided_ping(0), two_sided_ping(1)}));
  const std::size_t first = 1024 + 256 + 448;
  ASSERT_EQ(bytes.size(), first + 448);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    if (size == first) continue;
    const std::string refused = xtf_refusal(bytes.substr(0, size));
    EXPECT_THAT(refused, HasSubstr(size == 1024 || size == 1280 ? "has no ping" : "ends within")) << size;
    if (size == 1024 || size == 1280) continue;
    EXPECT_THROW(decode::read_xtf_file(bytes.substr(0, size)), std::runtime_error) << size;
  }
  EXPECT_EQ(read_xtf(own_file("one.xtf", bytes.substr(0, first))).pings.size(), 1U);
}

TEST(XtfFile, refuses_to_write_what_its_fields_cannot_hold) {
  const auto refusal = [](const std::function<void(XtfPing&)>& spoil) {
    XtfPing ping = two_sided_ping(12);
    spoil(ping);
    return error_of([&] { written_xtf({ping}); }, ErrorKind::content);
  };
  EXPECT_THAT(refusal([](XtfPing& p) { p.traces.clear(); }), HasSubstr("ping 12 has no channel"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.traces[1].channel = 2; }),
              HasSubstr("channel 2, must have some of a channel below 2"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.traces[0].samples[1] = 65536; }),
              HasSubstr("a sample of ping 12 is 65536, must be within 0 and 65535"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.traces[0].samples[1] = -1; }), HasSubstr("must be within 0 and 65535"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.time = -1; }), HasSubstr("time of ping 12 is -1 s since 1970"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.pitch = std::nan(""); }), HasSubstr("pitch of ping 12"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.sensor.y() = 91; }), HasSubstr("sonar of ping 12 is at latitude 91"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.traces[0].end = 0; }), HasSubstr("ping 12 reaches from 0.01 to 0 m"));
  EXPECT_THAT(refusal([](XtfPing& p) { p.sound_speed = 0; }), HasSubstr("sound speed of ping 12 is 0 m/s"));
  XtfHeader none = two_sided_header(XtfSamples::integer_16);
  none.channels.clear();
  EXPECT_THAT(error_of([&] { XtfFile(own_path("n.xtf"), none); }),
              HasSubstr("header has 0 channels, must be within 1 and 6"));
  EXPECT_THAT(error_of([&] { XtfFile(own_path("n.xtf"), two_sided_header(XtfSamples::integer_8)); }),
              HasSubstr("must be of 16 bits or IEEE floats"));
  EXPECT_FALSE(file_exists(own_path("line.xtf")));
}

// 115 of the 461 pings of a public record (data/records): its own header fields, and the order of its channels.
TEST(XtfFile, reads_a_public_record) {
  const XtfRecord read = read_xtf(INSONIFY_RECORDS "/sidescan_scotsman.xtf");
  EXPECT_EQ(read.header.program, "SEASCAN");
  ASSERT_EQ(read.pings.size(), 115U);
  ASSERT_EQ(read.header.channels.size(), 2U);
  EXPECT_EQ(read.header.channels[0].name, "PORT");
  EXPECT_EQ(read.header.channels[1].frequency, 600e3);
  EXPECT_EQ(read.header.channels[1].samples, XtfSamples::integer_16);
  for (const XtfPing& p : read.pings) {
    ASSERT_EQ(p.traces.size(), 2U);
    EXPECT_EQ(p.sound_speed, 1500);
    for (const XtfTrace& t : p.traces) {
      EXPECT_EQ(t.samples.size(), 1024U);
      EXPECT_NEAR(t.end, 29.98, 0.005);
      EXPECT_GT(t.samples[0], 30000);  // the transmission, at the near end of either side
      EXPECT_LT(t.samples[20], 3000);
    }
  }
  EXPECT_EQ(read.pings[0].number, 262U);
  EXPECT_NEAR(read.pings[0].altitude, 4.19, 0.5);
  EXPECT_NEAR(read.pings[0].sensor.y(), 48.4456, 1e-3);
  EXPECT_NEAR(read.pings[0].sensor.x(), -68.8281, 1e-3);
  EXPECT_GT(read.pings[0].time, 1378847588);  // 2013-09-10 21:13:08
}
