// SPDX-License-Identifier: BSD-3-Clause
// ARIS recordings, written here byte by byte after the public layout.
#include "formats/aris_file.hpp"

#include "support/test.hpp"

namespace {

/// Returns a recording of `frames` frames of 48 beams x 6 samples; the sample of (frame, beam, sample) is their sum.
std::string made_recording(int frames) {
  const auto put = [](std::string& bytes, std::size_t at, auto number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
  };
  std::string file(1024, '\0');
  put(file, 0, std::uint32_t{0x05464444});
  for (int frame = 0; frame < frames; ++frame) {
    std::string head(1024, '\0');
    put(head, 4, std::uint64_t{1500000000250000});
    put(head, 12, std::uint32_t{0x05464444});
    put(head, 68, std::uint32_t{24});
    put(head, 224, 9.5F);
    put(head, 436, std::uint32_t{1});
    put(head, 444, std::uint32_t{12});
    put(head, 452, std::uint32_t{20});
    put(head, 464, 1500.0F);
    put(head, 468, std::uint32_t{6});
    put(head, 476, std::uint32_t{4000});
    put(head, 484, std::uint32_t{2});
    put(head, 516, std::uint32_t{1});
    file += head;
    for (int sample = 0; sample < 6; ++sample)
      for (int beam = 0; beam < 48; ++beam) file += static_cast<char>(frame + beam + sample);
  }
  return file;
}
std::string aris_refusal(const std::string& bytes, std::size_t number = 0) {
  return error_of_file([number](const std::string& path) { read_aris_frame(path, number); }, "r.aris", bytes);
}
std::string with_byte(std::string bytes, std::size_t at, char value) {
  bytes[at] = value;
  return bytes;
}

}  // namespace

TEST(ArisFile, gives_samples_and_where_they_are) {
  const ArisFrame f = read_aris_frame(own_file("r.aris", made_recording(3)), 2);
  EXPECT_EQ(f.frames, 3U);
  ASSERT_EQ(f.grey.rows(), 48);
  ASSERT_EQ(f.grey.cols(), 6);
  EXPECT_EQ(f.grey(10, 4), 16);
  EXPECT_EQ(f.gate.bins(), 6U);
  EXPECT_NEAR(f.gate.centre(0), 3, 1e-9);  // 4 ms of 1500 m/s, there and back
  EXPECT_NEAR(f.gate.bin_size, 0.015, 1e-9);
  EXPECT_NEAR(degrees(f.fan.azimuth.front()), -13.5735, 0.02);  // the SDK's table, starboard first
  EXPECT_NEAR(degrees(f.fan.azimuth[30]), 4.3823, 0.02);
  EXPECT_NEAR(degrees(f.fan.azimuth[24]), 0.3461, 0.01);
  EXPECT_EQ(f.model, "ARIS 1200");
  EXPECT_DOUBLE_EQ(f.time, 1500000000.25);
  EXPECT_EQ(f.temperature_c, 9.5);
  EXPECT_NEAR(f.pulse_length, 12e-6, 1e-15);
  EXPECT_EQ(f.receiver_gain_db, 24);
  EXPECT_NEAR(level_db(f)(10, 4), 16 * 80.0 / 255, 1e-5);
}

TEST(ArisFile, knows_the_beams_of_all_lenses) {
  // Outermost beams of the SDK's tables.
  const std::string whole = made_recording(1);
  std::string telephoto = with_byte(whole, 1024 + 480, 1);
  EXPECT_NEAR(degrees(read_aris_frame(own_file("t.aris", telephoto), 0).fan.azimuth.front()), -6.742, 0.02);
  std::string many = with_byte(with_byte(whole, 1024 + 436, 9), 1024 + 484, 1) + std::string(80 * 6, 'x');
  const ArisFrame f = read_aris_frame(own_file("m.aris", many), 0);
  EXPECT_EQ(f.fan.beams(), 128U);
  EXPECT_NEAR(degrees(f.fan.azimuth.front()), -14.705, 0.02);
  EXPECT_EQ(f.model, "ARIS 3000");
}

TEST(ArisFile, refuses_what_is_damaged) {
  const std::string whole = made_recording(2);
  EXPECT_THAT(aris_refusal(whole.substr(0, 500)), HasSubstr("content: r.aris: ends within its header"));
  EXPECT_THAT(aris_refusal(whole.substr(0, 1500)), HasSubstr("ends within the header of frame 0"));
  EXPECT_THAT(aris_refusal(whole.substr(0, whole.size() - 1)),
              HasSubstr("ends within frame 1 of 48 beams x 6 samples; the file is truncated"));
  std::string swapped = whole;
  std::reverse(swapped.begin(), swapped.begin() + 4);
  EXPECT_THAT(aris_refusal(swapped), HasSubstr("other byte order (big-endian)"));
  EXPECT_THAT(aris_refusal("RIFF" + whole.substr(4)), HasSubstr("it is no ARIS recording"));
  EXPECT_THAT(aris_refusal(with_byte(whole, 1024 + 436, 13)), HasSubstr("ping mode 13, must be 1 to 12"));
  EXPECT_THAT(aris_refusal(with_byte(whole, 1024 + 452, 0)),
              HasSubstr("has no geometry: sound speed 1500 m/s, sample period 0 s"));
  EXPECT_THAT(aris_refusal(with_byte(whole, 1024 + 455, 1)),  // samples of 12.6 km, so the first begins behind the head
              HasSubstr("its samples reach from -62"));
  EXPECT_THAT(aris_refusal(with_byte(whole, 1024 + 478, 21)),  // a delay of 1.4 s
              HasSubstr("must begin above 0 and end below 1000 m; the file is damaged"));
  EXPECT_THAT(aris_refusal(with_byte(whole, 1024 + 516, 0)), HasSubstr("are not in order"));
  EXPECT_THAT(aris_refusal(whole, 2), HasSubstr("argument: r.aris: frame 2, must be below the number of frames, 2"));
  EXPECT_THAT(error_with_kind([] { read_aris_frame("none.aris", 0); }), HasSubstr("file: none.aris"));
}
