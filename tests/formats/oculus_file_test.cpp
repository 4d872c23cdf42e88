// SPDX-License-Identifier: BSD-3-Clause
// Logs of Oculus sonars, written here byte by byte after the public layout, and a public record.
#include "formats/oculus_file.hpp"

#include "formats/put_bytes.hpp"
#include "returns/ping.hpp"
#include "support/test.hpp"

namespace {

/// Parameters of a made message.
struct MadeMessage {
  int version = 1, code = 0;  ///< code: size of samples
  std::uint8_t gamma = 255;
  bool gain = false;
  int ranges = 4;
};

/// Returns a ping of 3 beams at -10, 1 and 10 degrees. The sample of (beam, range) is 10 beam + range, for 16 bits 1000
/// more.
std::string made_message(const MadeMessage& how, std::uint32_t number) {
  const bool second = how.version == 2;
  const std::size_t begin = second ? 202 : 122, image = begin + 3 * 2 + 10;
  std::string m(image, '\0');
  put_at(m, 0, std::uint16_t{0x4f53});
  put_at(m, 6, std::uint16_t{0x23});
  put_at(m, 8, static_cast<std::uint16_t>(how.version));
  m[16] = 2;
  m[19] = static_cast<char>(how.gamma);
  m[20] = static_cast<char>(0x19 | (how.gain ? 4 : 0));
  put_at(m, 29, 50.0);
  put_at(m, second ? 89 : 53, number);
  put_at(m, second ? 97 : 61, 2.1e6);
  if (second) {
    put_at(m, 121, 45.0), put_at(m, 129, -3.0), put_at(m, 137, 2.0);
    put_at(m, 153, 12.75);
  }
  put_at(m, second ? 145 : 85, 1490.5);
  m[second ? 161 : 97] = static_cast<char>(how.code);
  put_at(m, second ? 162 : 98, 0.25);
  put_at(m, second ? 170 : 106, static_cast<std::uint16_t>(how.ranges));
  put_at(m, second ? 172 : 108, std::uint16_t{3});
  put_at(m, begin, std::int16_t{-1000}), put_at(m, begin + 2, std::int16_t{100}),
      put_at(m, begin + 4, std::int16_t{1000});
  std::string samples;
  for (int range = 0; range < how.ranges; ++range) {
    if (how.gain) {
      samples.append(4, '\0');
      put_at(samples, samples.size() - 4, static_cast<float>(range));
    }
    for (int beam = 0; beam < 3; ++beam) {
      const std::uint32_t value = static_cast<std::uint32_t>(10 * beam + range) + (how.code == 1 ? 1000U : 0U);
      const std::size_t bytes = how.code == 0 ? 1 : how.code == 1 ? 2 : 4;
      for (std::size_t k = 0; k < bytes; ++k) samples += static_cast<char>(value >> 8 * k);
    }
  }
  put_at(m, second ? 190 : 110, static_cast<std::uint32_t>(image));
  put_at(m, second ? 194 : 114, static_cast<std::uint32_t>(samples.size()));
  m += samples;
  put_at(m, second ? 198 : 118, static_cast<std::uint32_t>(m.size()));
  put_at(m, 10, static_cast<std::uint32_t>(m.size() - 16));
  return m;
}

/// Returns a message of another kind: a status.
std::string other_message() {
  std::string m(40, '\0');
  put_at(m, 0, std::uint16_t{0x4f53});
  put_at(m, 6, std::uint16_t{0x80});
  put_at(m, 10, std::uint32_t{24});
  return m;
}

/// Returns an item of a log of the maker's viewer.
std::string log_item(const std::string& payload, std::uint16_t type = 10, std::uint16_t compression = 0) {
  std::string item(40, '\0');
  put_at(item, 0, std::uint32_t{0xaabbccdd});
  put_at(item, 4, std::uint32_t{40});
  put_at(item, 8, type);
  put_at(item, 24, compression);
  put_at(item, 32, static_cast<std::uint32_t>(payload.size()));
  return item + payload;
}

std::string log_header() {
  std::string head(48, '\0');
  put_at(head, 0, std::uint32_t{0x11223344});
  put_at(head, 4, std::uint32_t{48});
  return head;
}

std::string oculus_refusal(const std::string& bytes, std::size_t number = 0) {
  return error_of_file([number](const std::string& path) { read_oculus_ping(path, number); }, "r.raw", bytes);
}

}  // namespace

TEST(OculusFile, gives_samples_and_where_they_are) {
  const std::string log = made_message({}, 70) + other_message() + made_message({}, 71);
  const OculusPing p = read_oculus_ping(own_file("r.raw", log), 1);
  EXPECT_EQ(p.pings, 2U);
  EXPECT_EQ(p.number, 71U);
  ASSERT_EQ(p.value.rows(), 3);
  ASSERT_EQ(p.value.cols(), 4);
  EXPECT_EQ(p.value(2, 3), 23U);
  EXPECT_EQ(p.bits, 8);
  EXPECT_EQ(p.gate.bins(), 4U);
  EXPECT_NEAR(p.gate.centre(0), 0.125, 1e-12);
  EXPECT_NEAR(degrees(p.fan.azimuth[0]), 10, 1e-9);  // bearings are positive to starboard, azimuths to port
  EXPECT_NEAR(degrees(p.fan.azimuth[1]), -1, 1e-9);
  EXPECT_NEAR(degrees(p.fan.beam_width), 10, 1e-9);
  EXPECT_NEAR(degrees(p.fan.elevation_width), 12, 1e-9);
  EXPECT_TRUE(p.high_frequency);
  EXPECT_EQ(p.frequency, 2.1e6);
  EXPECT_EQ(p.sound_speed, 1490.5);
  EXPECT_EQ(p.gain_percent, 50);
  EXPECT_EQ(p.gamma, 1);
  EXPECT_NEAR(level_db(p)(2, 3), 20 * std::log10(23.0 / 255), 1e-4);
  EXPECT_EQ(level_db(p)(0, 0), static_cast<float>(silence_db));
}

TEST(OculusFile, reads_both_versions_all_sizes_and_gains_by_their_size) {
  for (const int version : {1, 2})
    for (const int code : {0, 1, 3})
      for (const int kind : {0, 1, 2, 3}) {
        const bool gain = kind % 2 == 1;
        std::string message = made_message({version, code, 127, gain}, 5);
        if (kind >= 2) message[20] = static_cast<char>(message[20] ^ 4);  // the flag is wrong, the size is right
        const OculusPing p = read_oculus_ping(own_file("v.raw", message), 0);
        EXPECT_EQ(p.bits, code == 0 ? 8 : code == 1 ? 16 : 32);
        EXPECT_EQ(p.value(1, 2), code == 1 ? 1012U : 12U) << version << code << gain;
        EXPECT_EQ(p.number, 5U);
        EXPECT_EQ(p.gains, gain ? (std::vector<float>{0, 1, 2, 3}) : std::vector<float>{});
        EXPECT_EQ(p.gamma, 0.5);
        EXPECT_EQ(p.time, version == 2 ? 12.75 : 0);
        EXPECT_NEAR(degrees(p.heading), version == 2 ? 45 : 0, 1e-9);
        EXPECT_NEAR(degrees(p.pitch), version == 2 ? -3 : 0, 1e-9);
        const double scale = std::pow(2, p.bits) - 1;
        EXPECT_NEAR(level_db(p)(1, 2), 40 * std::log10((code == 1 ? 1012 : 12) / scale), 1e-3);  // over the gamma
      }
}

TEST(OculusFile, reads_logs_of_the_makers_viewer) {
  const std::string log = log_header() + log_item("settings", 1) + log_item(made_message({}, 1)) +
                          log_item(made_message({2}, 2)) + log_item(other_message());
  EXPECT_EQ(read_oculus_ping(own_file("l.oculus", log), 0).pings, 2U);
  EXPECT_EQ(read_oculus_ping(own_file("l.oculus", log), 1).number, 2U);
  EXPECT_THAT(oculus_refusal(log_header() + log_item(made_message({}, 1), 10, 1)),
              HasSubstr("content: r.raw: the item at byte 48 is compressed; record without compression"));
  EXPECT_THAT(oculus_refusal(log + "rubbish"), HasSubstr("ends within the header of an item"));
  std::string spoilt = log;
  spoilt[48] = 'x';
  EXPECT_THAT(oculus_refusal(spoilt), HasSubstr("the item at byte 48 does not begin as one"));
  // A file cut between two items is whole, if a ping came before.
  const std::size_t first = log_header().size() + log_item("settings", 1).size() + log_item(made_message({}, 1)).size();
  const std::set<std::size_t> whole{first, first + log_item(made_message({2}, 2)).size()};
  for (std::size_t size = 0; size < log.size(); ++size)
    if (!whole.contains(size)) {
      EXPECT_THAT(oculus_refusal(log.substr(0, size)),
                  HasSubstr(size == 48 || size == 48 + 48 ? "has no ping" : "ends within"))
          << size;
    }
}

TEST(OculusFile, refuses_what_is_damaged) {
  const std::string whole = made_message({}, 1);
  const auto spoilt = [&](std::size_t at, auto number) {
    std::string bytes = whole;
    put_at(bytes, at, number);
    return oculus_refusal(bytes);
  };
  EXPECT_THAT(spoilt(0, 'x'),
              HasSubstr("the message at byte 0 does not begin with the mark of Oculus, 0x4f53, so it is no log"));
  EXPECT_THAT(oculus_refusal(whole + std::string(16, 'x')), HasSubstr("the file is damaged, copy it again"));
  EXPECT_THAT(spoilt(97, std::uint8_t{2}), HasSubstr("the ping at byte 0 has samples of type 2, must be 0 (8 bits)"));
  EXPECT_THAT(spoilt(106, std::uint16_t{5}),
              HasSubstr("has an image of 12 bytes from 138 on, must have 15, or 35 with gains, behind its bearings"));
  EXPECT_THAT(spoilt(110, std::uint32_t{100}), HasSubstr("from 100 on, must have 12"));
  EXPECT_THAT(spoilt(110, std::uint32_t{0xffffffff}), HasSubstr("from 4294967295 on"));
  EXPECT_THAT(spoilt(85, 99.0), HasSubstr("has no geometry: 3 beams, 4 ranges of 0.25 m, sound speed 99 m/s"));
  EXPECT_THAT(spoilt(98, std::nan("")), HasSubstr("has no geometry"));
  EXPECT_THAT(spoilt(122, std::int16_t{-9001}), HasSubstr("has a beam at -90.01 degrees, must be within -90 and 90"));
  EXPECT_THAT(oculus_refusal(other_message()), HasSubstr("has no ping of an Oculus sonar"));
  EXPECT_THAT(oculus_refusal(whole, 1), HasSubstr("argument: r.raw: ping 1, must be below the number of pings, 1"));
  EXPECT_THAT(error_with_kind([] { read_oculus_ping("none.raw", 0); }), HasSubstr("file: none.raw"));
}

TEST(OculusFile, cut_off_anywhere_within_a_message_it_is_refused) {
  const std::string first = made_message({}, 1), log = first + made_message({2, 1}, 2);
  for (std::size_t size = 0; size < log.size(); ++size)
    if (size != first.size()) {
      EXPECT_THAT(oculus_refusal(log.substr(0, size)), HasSubstr("content: r.raw: ends within")) << size;
    }
}

// Three pings of a real sonar (data/records).
TEST(OculusFile, reads_a_public_record) {
  for (std::size_t number = 0; number < 3; ++number) {
    const OculusPing p = read_oculus_ping(INSONIFY_RECORDS "/oculus_three_pings_8bit.raw", number);
    EXPECT_EQ(p.pings, 3U);
    EXPECT_EQ(p.number, 415323U + number);
    ASSERT_EQ(p.value.rows(), 256);
    ASSERT_EQ(p.value.cols(), 703);
    EXPECT_EQ(p.gate.bins(), 703U);
    EXPECT_NEAR(p.gate.bin_size, 2.842e-3, 1e-6);
    EXPECT_NEAR(p.sound_speed, 1490.66, 0.005);
    EXPECT_NEAR(p.frequency, 2.099e6, 1e3);
    EXPECT_EQ(p.bits, 8);
    EXPECT_EQ(p.gamma, 0.5);
    EXPECT_TRUE(std::is_sorted(p.fan.azimuth.rbegin(), p.fan.azimuth.rend()));
    const double least = p.fan.azimuth[127] - p.fan.azimuth[128], most = p.fan.azimuth[0] - p.fan.azimuth[1];
    EXPECT_GT(most, 1.1 * least);  // farther apart at the edges
  }
}
